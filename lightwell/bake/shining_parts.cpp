// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/shining_parts.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lightwell {
namespace {

using Vec2d = Vec<double, 2>;

/// Cells along each side of the raster on which a surface is looked at.
constexpr int cells = 128;
/// Points of the surface that are looked at for each cell, on average.
constexpr int points_per_cell = 4;
/// Of the squared radiance: what may be left of its variance. Lookups between texels, which blur the edges of what
/// shines, leave 1 to 4 %.
constexpr double small_variance = 0.05;
/// At each side of a part, what is darker than half of it is left out, up to this share of its power: the same blur.
constexpr double dim_share = 0.03;

/// Sums over the surface inside a part of the raster.
struct Sums {
  double area = 0;     // m2
  Vec3d radiance{};    // times area
  double squares = 0;  // of the channels' mean radiance, times area

  Sums& operator+=(const Sums& other) {
    area += other.area;
    radiance += other.radiance;
    squares += other.squares;
    return *this;
  }
  friend Sums operator-(Sums a, const Sums& b) {
    a.area -= b.area;
    a.radiance -= b.radiance;
    a.squares -= b.squares;
    return a;
  }
  /// The integral of the squared difference to the mean.
  double variance() const { return area > 0 ? std::max(0.0, squares - sum() * sum() / area) : 0; }
  /// The mean radiance, weighted by itself: of what shines.
  double typical() const { return sum() > 0 ? squares / sum() : 0; }
  double sum() const { return (radiance[0] + radiance[1] + radiance[2]) / 3; }
};

/// The cells `lo` to `hi`, exclusive, on two axes.
struct Part {
  std::array<int, 2> lo{}, hi{};
};

/// A surface's radiance, summed over every rectangle of cells whose corner is the first one.
class Raster {
 public:
  Raster(const TraceScene& scene, const Luminaire& luminaire, const Vec3f& u, const Vec3f& v)
      : middle_(luminaire.center.cast<double>()), axes_{u.cast<double>(), v.cast<double>()} {
    const auto instance = static_cast<uint32_t>(luminaire.index);
    lo_ = Vec2d::filled(std::numeric_limits<double>::infinity());
    Vec2d hi = -lo_;
    for (const uint32_t face : luminaire.faces)
      for (const Vec3f& corner : scene.corners(instance, face)) {
        const Vec2d place = on_axes(corner);
        lo_ = min(lo_, place);
        hi = max(hi, place);
      }
    cell_ = max((hi - lo_) / cells, Vec2d::filled(1e-30));
    sums_.resize(static_cast<size_t>((cells + 1) * (cells + 1)));
    for (const uint32_t face : luminaire.faces) add_face(scene, instance, face, luminaire.area);
    for (int y = 1; y <= cells; y++)
      for (int x = 1; x <= cells; x++) {
        Sums& sum = at(x, y);
        sum += at(x - 1, y);
        sum += at(x, y - 1) - at(x - 1, y - 1);
      }
  }

  Sums sums(const Part& part) const {
    return (at(part.hi[0], part.hi[1]) - at(part.lo[0], part.hi[1])) -
           (at(part.hi[0], part.lo[1]) - at(part.lo[0], part.lo[1]));
  }

  /// The rectangle of the area and the mean radiance of a part, round the part's middle.
  ShiningPart describe(const Part& part) const {
    const Sums sums = this->sums(part);
    const Vec2d first{{part.lo[0] * cell_[0], part.lo[1] * cell_[1]}},
        last{{part.hi[0] * cell_[0], part.hi[1] * cell_[1]}};
    const Vec2d size = last - first, middle = lo_ + (first + last) / 2.0;
    const double shrink = std::sqrt(std::min(1.0, sums.area / (size[0] * size[1])));
    return {.center = (middle_ + axes_[0] * middle[0] + axes_[1] * middle[1]).cast<float>(),
            .half_size = (size * (shrink / 2)).cast<float>(),
            .radiance = (sums.radiance / (shrink * shrink * size[0] * size[1])).cast<float>()};
  }

 private:
  Vec2d on_axes(const Vec3f& place) const {
    const Vec3d way = place.cast<double>() - middle_;
    return {{dot(way, axes_[0]), dot(way, axes_[1])}};
  }

  /// Looks at points that divide the face evenly, and counts each for its share of the area.
  void add_face(const TraceScene& scene, uint32_t instance, uint32_t face, double whole) {
    const std::array<Vec3f, 3> corners = scene.corners(instance, face);
    const Vec3d edge_u = (corners[1] - corners[0]).cast<double>(), edge_v = (corners[2] - corners[0]).cast<double>();
    const double area = length(cross(edge_u, edge_v)) / 2;
    if (!(area > 0)) return;
    const int steps = std::max(1, static_cast<int>(std::ceil(cells * std::sqrt(points_per_cell * area / whole))));
    const double size = area / (steps * steps);
    for (int i = 0; i < steps; i++)
      for (int j = 0; i + j < steps; j++) {
        add_point(scene, instance, face, (i + 1.0 / 3) / steps, (j + 1.0 / 3) / steps, size);
        if (i + j < steps - 1) add_point(scene, instance, face, (i + 2.0 / 3) / steps, (j + 2.0 / 3) / steps, size);
      }
  }

  void add_point(const TraceScene& scene, uint32_t instance, uint32_t face, double u, double v, double area) {
    const Surface surface = scene.surface(instance, face, static_cast<float>(u), static_cast<float>(v));
    const std::array<Vec3f, 3> corners = scene.corners(instance, face);
    const Vec2d place = on_axes(corners[0] + (corners[1] - corners[0]) * static_cast<float>(u) +
                                (corners[2] - corners[0]) * static_cast<float>(v));
    const int x = std::clamp(static_cast<int>((place[0] - lo_[0]) / cell_[0]), 0, cells - 1);
    const int y = std::clamp(static_cast<int>((place[1] - lo_[1]) / cell_[1]), 0, cells - 1);
    const Vec3d radiance = (surface.emission * surface.coverage).cast<double>();
    const double mean = (radiance[0] + radiance[1] + radiance[2]) / 3;
    at(x + 1, y + 1) += {.area = area, .radiance = radiance * area, .squares = mean * mean * area};
  }

  Sums& at(int x, int y) { return sums_[static_cast<size_t>(y * (cells + 1) + x)]; }
  const Sums& at(int x, int y) const { return sums_[static_cast<size_t>(y * (cells + 1) + x)]; }

  Vec3d middle_;
  std::array<Vec3d, 2> axes_;
  Vec2d lo_{}, cell_{};
  std::vector<Sums> sums_;
};

/// A part without the strips at its sides that `dispensable` says of: it is given the sums of the strip and of all that
/// would be left out at that side.
template <typename Dispensable>
Part without_strips(const Raster& raster, Part part, Dispensable dispensable) {
  for (size_t axis = 0; axis < 2; axis++)
    for (const bool last : {false, true}) {
      Sums left_out;
      while (part.lo[axis] < part.hi[axis]) {
        Part strip = part;
        (last ? strip.lo : strip.hi)[axis] = last ? part.hi[axis] - 1 : part.lo[axis] + 1;
        const Sums sums = raster.sums(strip);
        left_out += sums;
        if (!dispensable(sums, left_out)) break;
        last ? part.hi[axis]-- : part.lo[axis]++;
      }
    }
  return part;
}

/// Of no cells when all of it is black.
Part without_black(const Raster& raster, const Part& part) {
  const double nothing = 1e-9 * raster.sums(part).sum();
  return without_strips(raster, part, [&](const Sums& strip, const Sums&) { return !(strip.sum() > nothing); });
}

Part without_blur(const Raster& raster, const Part& part) {
  const Sums all = raster.sums(part);
  return without_strips(raster, part, [&](const Sums& strip, const Sums& left_out) {
    return strip.typical() < all.typical() / 2 && left_out.sum() < dim_share * all.sum();
  });
}

bool empty(const Part& part) { return part.lo[0] >= part.hi[0] || part.lo[1] >= part.hi[1]; }

/// The two sides, without what is black, of the straight cut that leaves the least variance; the second is empty where
/// none helps.
std::array<Part, 2> cut(const Raster& raster, const Part& part) {
  std::array<Part, 2> best{part, Part{}};
  double least = raster.sums(part).variance();
  for (size_t axis = 0; axis < 2; axis++)
    for (int line = part.lo[axis] + 1; line < part.hi[axis]; line++) {
      Part below = part, above = part;
      below.hi[axis] = above.lo[axis] = line;
      const double left = raster.sums(below).variance() + raster.sums(above).variance();
      if (left >= least) continue;
      least = left;
      best = {below, above};
    }
  return {without_black(raster, best[0]), without_black(raster, best[1])};
}

}  // namespace

std::vector<ShiningPart> shining_parts(const TraceScene& scene, const Luminaire& luminaire, const Vec3f& u,
                                       const Vec3f& v, size_t most) {
  const Raster raster(scene, luminaire, u, v);
  const Part whole{{0, 0}, {cells, cells}};
  const Sums all = raster.sums(whole);
  std::vector<Part> parts{without_black(raster, whole)};
  if (empty(parts[0])) return {};
  const auto variance = [&](const Part& part) { return raster.sums(without_blur(raster, part)).variance(); };
  while (parts.size() < most) {
    double left = 0;
    for (const Part& part : parts) left += variance(part);
    if (left <= small_variance * all.squares) break;
    const auto worst = std::max_element(parts.begin(), parts.end(),
                                        [&](const Part& a, const Part& b) { return variance(a) < variance(b); });
    const std::array<Part, 2> halves = cut(raster, *worst);
    *worst = halves[0];
    if (empty(halves[1])) break;
    parts.push_back(halves[1]);
  }
  std::erase_if(parts, empty);
  for (Part& part : parts) part = without_blur(raster, part);
  Vec3d kept{};
  for (const Part& part : parts) kept += raster.sums(part).radiance;
  // What was left out shines with the rest, so that no power is lost.
  std::vector<ShiningPart> found;
  for (const Part& part : parts) {
    found.push_back(raster.describe(part));
    for (size_t c = 0; c < 3; c++)
      if (kept[c] > 0) found.back().radiance[c] *= static_cast<float>(all.radiance[c] / kept[c]);
  }
  return found;
}

}  // namespace lightwell
