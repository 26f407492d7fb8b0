// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/light_error.h"

#include <algorithm>

#include "lightwell/bake/surface_sampler.h"
#include "lightwell/base/parallel.h"
#include "lightwell/trace/sampling.h"

namespace lightwell {
namespace {

/// Of what a tenth of all points have at least: places that are darker lie in gaps that nobody sees.
constexpr float least_lit = 0.03f;
/// A place that sees a greater share of insides is no free space, and a surface there is buried in a solid.
constexpr float most_insides = 0.25f, most_buried = 0.9f;
/// One that sees next to nothing but backs is outside of what the scene is about: under a floor that is a sheet.
constexpr float most_behind = 0.9f;

float brightness(const Vec3f& light) { return light[0] + light[1] + light[2]; }

}  // namespace

Result<TestPoints> TestPoints::gather(const GatheredLight& light, const TestPointOptions& options, Progress& progress) {
  TestPoints test;
  const Box3f& box = light.box();
  const SurfaceSampler surfaces(light.world().surfaces(), box);
  if (surfaces.empty()) return test;
  const size_t count = options.surface_points + options.free_points;
  test.points_.resize(count);
  progress.stage("estimating the error", static_cast<double>(count), "points");
  // Two sets of rays a point: their difference tells their noise.
  const auto on_surface = [&](Point& point, Random& random) {
    const SurfacePoint sampled = surfaces.sample(random);
    point.position = sampled.position;
    point.normal = sampled.normal;
    const auto received = [&] {
      return light.received(point.position, point.normal, options.rays / 2, random, options.near);
    };
    const Received a = received(), b = received();
    if (a.insides + b.insides <= 2 * most_buried) point.set(a.irradiance, b.irradiance);
  };
  const auto in_free_space = [&](Point& point, Random& random) {
    const Vec3f share{{random.uniform(), random.uniform(), random.uniform()}};
    point.position = box.lo + box.size() * share;
    point.normal = sample_sphere(random);
    const auto a = light.around(point.position, random, options.rays / 2);
    const auto b = light.around(point.position, random, options.rays / 2);
    if (a.insides + b.insides <= 2 * most_insides && a.behind + b.behind <= 2 * most_behind)
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
