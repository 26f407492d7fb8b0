// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/light_error.h"

#include <algorithm>
#include <tuple>

#include "lightwell/base/parallel.h"
#include "lightwell/trace/sampling.h"

namespace lightwell {
namespace {

/// Of the scene's diagonal: how far off the surface points are looked up.
constexpr float off_surface = 2e-4f;
/// Of what a tenth of all points have at least: places that are darker lie in gaps that nobody sees.
constexpr float least_lit = 0.03f;
/// A place that sees a greater share of insides is no free space.
constexpr float most_insides = 0.25f;

/// The corners of what lies in a box of a triangle (Sutherland and Hodgman, Reentrant polygon clipping, CACM 1974).
std::vector<Vec3f> part_within(const std::array<Vec3f, 3>& triangle, const Box3f& box) {
  std::vector<Vec3f> corners(triangle.begin(), triangle.end());
  for (int side = 0; side < 6 && !corners.empty(); side++) {
    const int axis = side / 2;
    // How far inside of the side a corner lies.
    const auto depth = [&](const Vec3f& p) { return side % 2 == 0 ? p[axis] - box.lo[axis] : box.hi[axis] - p[axis]; };
    std::vector<Vec3f> kept;
    for (size_t i = 0; i < corners.size(); i++) {
      const Vec3f &from = corners[i], &to = corners[(i + 1) % corners.size()];
      const float before = depth(from), after = depth(to);
      if (before >= 0) kept.push_back(from);
      if ((before < 0) != (after < 0)) kept.push_back(from + (to - from) * (before / (before - after)));
    }
    corners = std::move(kept);
  }
  return corners;
}

/// What lies in a box of all faces that are traced, chosen by area.
class Surfaces {
 public:
  Surfaces(const TraceScene& scene, const Box3f& box) : scene_(scene), box_(box) {
    std::vector<float> areas;
    for (uint32_t i = 0; i < scene.scene().instances.size(); i++) {
      first_.push_back(areas.size());
      if (!scene.traced(i)) continue;
      for (uint32_t face = 0; face < scene.mesh(i).faces.size(); face++) {
        float area = 0;
        for (const auto& [a, b, c] : within(scene.corners(i, face))) area += length(cross(b - a, c - a));
        areas.push_back(area);
      }
    }
    chosen_ = Distribution(areas);
  }

  bool empty() const { return chosen_.total() <= 0; }

  /// A point and its normal.
  std::pair<Vec3f, Vec3f> sample(Random& random) const {
    const size_t number = chosen_.sample(random);
    const auto after = std::upper_bound(first_.begin(), first_.end(), number);
    const auto instance = static_cast<uint32_t>(after - first_.begin() - 1);
    const auto face = static_cast<uint32_t>(number - first_[instance]);
    const auto corners = scene_.corners(instance, face);
    const Vec2f uv = sample_triangle(random);
    const Vec3f normal = scene_.face_normal(instance, corners);
    std::vector<float> areas;
    const auto triangles = within(corners);
    for (const auto& [a, b, c] : triangles) areas.push_back(length(cross(b - a, c - a)));
    const auto& [a, b, c] = triangles[Distribution(areas).sample(random)];
    const Vec3f point = a + (b - a) * uv[0] + (c - a) * uv[1];
    return {point + normal * (off_surface * length(box_.size())), normal};
  }

 private:
  using Triangle = std::array<Vec3f, 3>;

  /// Triangles that make up what lies in the box of a face.
  std::vector<Triangle> within(const Triangle& face) const {
    Box3f box;
    for (const Vec3f& corner : face) box.extend(corner);
    if (max(box_.lo, box.lo) == box.lo && min(box_.hi, box.hi) == box.hi) return {face};
    const std::vector<Vec3f> part = part_within(face, box_);
    std::vector<Triangle> triangles;
    for (size_t i = 2; i < part.size(); i++) triangles.push_back({part[0], part[i - 1], part[i]});
    return triangles;
  }

  const TraceScene& scene_;
  const Box3f box_;
  std::vector<size_t> first_;  // face of each instance
  Distribution chosen_;
};

float brightness(const Vec3f& light) { return light[0] + light[1] + light[2]; }

}  // namespace

Result<TestPoints> TestPoints::gather(const GatheredLight& light, const TestPointOptions& options, Progress& progress) {
  TestPoints test;
  const Box3f& box = light.box();
  const Surfaces surfaces(light.world().surfaces(), box);
  if (surfaces.empty()) return test;
  const size_t count = options.surface_points + options.free_points;
  test.points_.resize(count);
  progress.stage("estimating the error", static_cast<double>(count), "points");
  // Two sets of rays a point: their difference tells their noise.
  const auto on_surface = [&](Point& point, Random& random) {
    std::tie(point.position, point.normal) = surfaces.sample(random);
    const auto irradiance = [&] {
      return light.irradiance(point.position, point.normal, options.rays / 2, random, options.near);
    };
    const Vec3f a = irradiance();
    point.set(a, irradiance());
  };
  const auto in_free_space = [&](Point& point, Random& random) {
    const Vec3f share{{random.uniform(), random.uniform(), random.uniform()}};
    point.position = box.lo + box.size() * share;
    point.normal = sample_sphere(random);
    const auto a = light.around(point.position, random, options.rays / 2);
    const auto b = light.around(point.position, random, options.rays / 2);
    if (a.insides + b.insides <= 2 * most_insides)
      point.set(a.moments.irradiance(point.normal), b.moments.irradiance(point.normal));
  };
  parallel_for(
      count, 4, options.threads,
      [&](size_t begin, size_t end, int) {
        for (size_t i = begin; i < end; i++) {
          Random random(options.seed, i);
          i < options.surface_points ? on_surface(test.points_[i], random) : in_free_space(test.points_[i], random);
        }
      },
      [&] { return progress.cancelled(); });
  if (progress.cancelled()) return fail(ErrorKind::cancelled, "light", "cancelled");
  std::vector<Point>& points = test.points_;
  std::sort(points.begin(), points.end(),
            [](const Point& a, const Point& b) { return brightness(a.irradiance) < brightness(b.irradiance); });
  const float least = least_lit * brightness(points[points.size() * 9 / 10].irradiance);
  if (least > 0) std::erase_if(points, [&](const Point& point) { return !(brightness(point.irradiance) > least); });
  return test;
}

float TestPoints::error(const LightGrid& grid) const {
  double squares = 0, sum = 0;
  for (const Point& point : points_) {
    const Vec3f difference = grid.irradiance(point.position, point.normal) - point.irradiance;
    squares += static_cast<double>(dot(difference, difference) - brightness(point.variance));
    sum += static_cast<double>(brightness(point.irradiance));
  }
  const double count = 3 * static_cast<double>(points_.size());
  if (points_.empty()) return 0;
  const double size = sum > 0 ? sum / count : 1;
  return static_cast<float>(std::sqrt(std::max(squares, 0.0) / count) / size);
}

std::vector<TestPoints::Excess> TestPoints::excess(const LightGrid& grid) const {
  std::vector<Excess> found;
  for (const Point& point : points_) {
    const Vec3f difference = grid.irradiance(point.position, point.normal) - point.irradiance;
    float error = 0;
    for (int c = 0; c < 3; c++) error += std::max(std::abs(difference[c]) - std::sqrt(point.variance[c]), 0.0f);
    found.push_back({point.position, error});
  }
  return found;
}

float TestPoints::mean_error(const LightGrid& grid) const {
  double differences = 0, sum = 0;
  for (const Excess& point : excess(grid)) differences += static_cast<double>(point.error);
  for (const Point& point : points_) sum += static_cast<double>(brightness(point.irradiance));
  return static_cast<float>(sum > 0 ? differences / sum : differences);
}

float TestPoints::best_offset(LightGrid grid) const {
  float best = 0, least = std::numeric_limits<float>::infinity();
  for (int level = 0; level <= grid.tree.levels(); level++) {
    for (const float cells : {0.25f, 0.15f, 0.35f, 0.5f}) {
      grid.normal_offset = std::ldexp(cells, -level);
      const float found = mean_error(grid);
      if (!(found < least)) continue;
      least = found;
      best = grid.normal_offset;
    }
  }
  return best;
}

}  // namespace lightwell
