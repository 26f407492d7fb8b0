// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/faces.h"

#include <algorithm>
#include <cmath>

#include "lightwell/base/assert.h"

namespace lightwell {
namespace {

/// Integer steps per weight: a photon is accurate to 2^-24 of the reference.
constexpr double resolution = 0x1p24;
/// Photons nearly in a face's plane count as if they were not: the mixed moments' variance grows without bound there.
constexpr float least_cosine = 1e-3f;
/// The outermost faces stand so many cells inside of the walls that the grid ends at: flights begin and end on these.
constexpr float inset = 0.01f;
/// Of a photon's weight, far beyond what any photon has: 2^24 of the largest still fit into 64 bits.
constexpr float most_weight = 0x1p14f;

}  // namespace

FaceSums::FaceSums(const GridShape& shape, bool as_printed)
    : shape_(shape), as_printed_(as_printed), unit_(max_component(shape.cell)), sums_(shape.count() * lanes) {}

void FaceSums::deposit(const Vec3f& origin, const Vec3f& direction, float length, const Vec3f& weight) {
  const Vec3f start = (origin - shape_.lo) / shape_.cell, speed = direction / shape_.cell;
  const Vec3f last = shape_.cells().cast<float>();
  for (int axis = 0; axis < 3; axis++) {
    if (std::abs(direction[axis]) < least_cosine) continue;
    const float begin = std::clamp(start[axis], -1.0f, last[axis] + 1);
    const float end = std::clamp(start[axis] + speed[axis] * length, -1.0f, last[axis] + 1);
    const int first = std::max(static_cast<int>(std::floor(std::min(begin, end))), 0);
    const int stop = std::min(static_cast<int>(std::ceil(std::max(begin, end))), shape_.nodes[axis] - 1);
    for (int node_plane = first; node_plane <= stop; node_plane++) {
      const float plane = std::clamp(static_cast<float>(node_plane), inset, last[axis] - inset);
      if ((begin < plane) == (end < plane)) continue;
      const Vec3f at = start + speed * ((plane - start[axis]) / speed[axis]);
      Vec3i node;
      bool inside = true;
      for (int a = 0; a < 3; a++) {
        inside = inside && (a == axis || (at[a] >= 0 && at[a] <= last[a]));
        node[a] = a == axis ? node_plane : static_cast<int>(std::floor(std::clamp(at[a], 0.0f, last[a]) + 0.5f));
      }
      if (inside) cross(axis, node, -direction, weight);
    }
  }
}

void FaceSums::cross(int axis, const Vec3i& node, const Vec3f& w, const Vec3f& weight) {
  // Half a cell to each side of the node, clipped to the grid; in units of the largest cell's.
  float area = 1;
  for (int a = 0; a < 3; a++)
    if (a != axis) area *= shape_.cell[a] / unit_ * (node[a] == 0 || node[a] == shape_.cells()[a] ? 0.5f : 1.0f);
  int64_t* sums = &sums_[shape_.index(node) * lanes];
  const auto add = [&](size_t moment, float share) {
    for (int c = 0; c < 3; c++) {
      const double value = static_cast<double>(std::min(weight[c], most_weight) * share / area);
      sums[3 * moment + static_cast<size_t>(c)] += std::llround(value * resolution);
    }
  };
  const float cosine = std::abs(w[axis]), share = as_printed_ ? cosine : 1;
  add(static_cast<size_t>(2 * axis + (w[axis] < 0)), share);
  // S for xy, xz, yz: the pairs of this axis with the two others.
  for (int b = 0; b < 3; b++)
    if (b != axis) add(static_cast<size_t>(5 + axis + b), share * w[b] / (2 * w[axis]));
}

FaceSums& FaceSums::operator+=(const FaceSums& other) {
  LW_ASSERT(sums_.size() == other.sums_.size());
  for (size_t i = 0; i < sums_.size(); i++) sums_[i] += other.sums_[i];
  return *this;
}

std::vector<Moments> FaceSums::moments(float flux, std::span<const float> free_share) const {
  std::vector<Moments> result(shape_.count());
  const double face = static_cast<double>(unit_) * static_cast<double>(unit_);
  for (size_t node = 0; node < result.size(); node++) {
    if (free_share[node] <= 0) continue;
    const double scale = static_cast<double>(flux) / (resolution * face * static_cast<double>(free_share[node]));
    for (size_t i = 0; i < lanes; i++) {
      const double sum = static_cast<double>(sums_[node * lanes + i]);
      result[node].m[i / 3].e[i % 3] = static_cast<float>(sum * scale);
    }
  }
  return result;
}

}  // namespace lightwell
