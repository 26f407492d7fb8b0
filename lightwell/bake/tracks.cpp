// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/tracks.h"

#include "lightwell/base/assert.h"

namespace lightwell {
namespace {

/// Integer steps per weight * length / unit_: a flight through a whole box is accurate to 1.2e-7, and no deposit of a
/// weight up to max_weight overflows 32 bits.
constexpr float resolution = 0x1p22f;
constexpr float max_weight = 256;

/// Rounds to the nearest integer, halves away from 0; unlike lrint, it compiles to vector instructions.
int32_t rounded(float x) { return static_cast<int32_t>(x + std::copysign(0.5f, x)); }

/// The sign, 0 for 0: light exactly in the plane between two half-spaces, as a sun's may be, belongs to neither.
float sign(float x) { return static_cast<float>((x > 0) - (x < 0)); }

/// The nine moments of a unit of light that arrives from the unit direction w (docs/light.md section 1).
std::array<float, 9> moments_of_direction(const Vec3f& w) {
  std::array<float, 9> m{};
  for (int a = 0; a < 3; a++) m[static_cast<size_t>(2 * a + (w[a] < 0 ? 1 : 0))] = std::abs(w[a]);
  constexpr int pairs[3][2] = {{0, 1}, {0, 2}, {1, 2}};
  for (size_t i = 0; i < 3; i++) {
    const float a = w[pairs[i][0]], b = w[pairs[i][1]];
    m[6 + i] = (sign(a) * b + sign(b) * a) / 2;
  }
  return m;
}

/// A walk along a ray from node box to node box (Amanatides and Woo 1987), in units of cells; box i of an axis is [i, i
/// + 1).
class BoxWalk {
 public:
  BoxWalk(const GridShape& shape, const Vec3f& origin, const Vec3f& direction, float length)
      : nodes_(shape.nodes), end_(length) {
    const Vec3f start = (origin - shape.lo) / shape.cell + Vec3f::filled(0.5f);
    const Vec3f speed = direction / shape.cell;
    clip(start, speed);
    if (empty()) return;
    size_t stride = 1;
    for (int a = 0; a < 3; a++) {
      const float entry = start[a] + speed[a] * begin_;
      const int box = std::clamp(static_cast<int>(entry), 0, nodes_[a] - 1);
      left_[a] = speed[a] < 0 ? box : nodes_[a] - 1 - box;
      node_ += stride * static_cast<size_t>(box);
      step_[a] = speed[a] < 0 ? -static_cast<ptrdiff_t>(stride) : static_cast<ptrdiff_t>(stride);
      const bool moves = speed[a] != 0;
      const float face = static_cast<float>(speed[a] < 0 ? box : box + 1);
      cross_[a] = moves ? (face - start[a]) / speed[a] : std::numeric_limits<float>::infinity();
      between_[a] = moves ? 1 / std::abs(speed[a]) : std::numeric_limits<float>::infinity();
      stride *= static_cast<size_t>(nodes_[a]);
    }
  }

  bool empty() const { return !(begin_ < end_); }
  size_t node() const { return node_; }

  /// Goes to the next box; returns the length in the previous one. The walk is over when empty().
  float advance() {
    const int axis = cross_[0] < cross_[1] ? (cross_[0] < cross_[2] ? 0 : 2) : (cross_[1] < cross_[2] ? 1 : 2);
    const float leave = std::clamp(cross_[axis], begin_, end_);
    const float length = leave - begin_;
    begin_ = left_[axis] > 0 ? leave : end_;
    if (left_[axis]-- > 0) node_ += static_cast<size_t>(step_[axis]);
    cross_[axis] += between_[axis];
    return length;
  }

 private:
  /// Clips the ray to the grid, whose outermost boxes are half as wide.
  void clip(const Vec3f& start, const Vec3f& speed) {
    for (int a = 0; a < 3; a++) {
      const float lo = 0.5f, hi = static_cast<float>(nodes_[a]) - 0.5f;
      if (speed[a] == 0) {
        if (start[a] < lo || start[a] > hi) end_ = begin_;
        continue;
      }
      const float t0 = (lo - start[a]) / speed[a], t1 = (hi - start[a]) / speed[a];
      begin_ = std::max(begin_, std::min(t0, t1));
      end_ = std::min(end_, std::max(t0, t1));
    }
  }

  Vec3i nodes_;
  float begin_ = 0, end_;
  size_t node_ = 0;
  Vec3i left_{};                     // boxes ahead on each axis
  std::array<ptrdiff_t, 3> step_{};  // to the next node of each axis
  Vec3f cross_{};                    // where the next face of each axis is crossed
  Vec3f between_{};                  // distance between faces of each axis
};

}  // namespace

TrackSums::TrackSums(const GridShape& shape)
    : shape_(shape), unit_(max_component(shape.cell)), sums_(shape.count() * lanes) {}

void TrackSums::deposit(const Vec3f& origin, const Vec3f& direction, float length, const Vec3f& weight) {
  if (max_component(weight) > max_weight) {
    deposit(origin, direction, length, weight / 2);
    deposit(origin, direction, length, weight / 2);
    return;
  }
  const std::array<float, 9> moments = moments_of_direction(-direction);
  std::array<float, lanes> per_length{};
  for (size_t i = 0; i < used_lanes; i++) per_length[i] = moments[i / 3] * weight.e[i % 3] * (resolution / unit_);
  for (BoxWalk walk(shape_, origin, direction, length); !walk.empty();) {
    int64_t* sums = &sums_[walk.node() * lanes];
    const float length_in_box = walk.advance();
    __builtin_prefetch(&sums_[walk.node() * lanes], 1);
    __builtin_prefetch(&sums_[walk.node() * lanes + lanes / 2], 1);
    for (size_t i = 0; i < lanes; i++) sums[i] += rounded(per_length[i] * length_in_box);
  }
}

TrackSums& TrackSums::operator+=(const TrackSums& other) {
  LW_ASSERT(sums_.size() == other.sums_.size());
  for (size_t i = 0; i < sums_.size(); i++) sums_[i] += other.sums_[i];
  return *this;
}

std::vector<Moments> TrackSums::moments(float flux, std::span<const float> free_share) const {
  std::vector<Moments> result(shape_.count());
  for (size_t node = 0; node < result.size(); node++) {
    if (free_share[node] <= 0) continue;
    const Vec3d size = node_box(shape_, node).size().cast<double>();
    const double volume = size[0] * size[1] * size[2] * static_cast<double>(free_share[node]);
    const double scale = static_cast<double>(flux) * static_cast<double>(unit_ / resolution) / volume;
    for (size_t i = 0; i < used_lanes; i++) {
      const double sum = static_cast<double>(sums_[node * lanes + i]);
      result[node].m[i / 3].e[i % 3] = static_cast<float>(sum * scale);
    }
  }
  return result;
}

Box3f node_box(const GridShape& shape, size_t node) {
  const Vec3f center = shape.position(shape.node(node));
  const Vec3f half = shape.cell * 0.5f;
  return {max(center - half, shape.lo), min(center + half, shape.hi())};
}

}  // namespace lightwell
