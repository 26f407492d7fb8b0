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
constexpr float most_insides = 0.25f, most_buried = 0.5f;
/// One that sees next to nothing but backs is outside of what the scene is about: under a floor that is a sheet.
constexpr float most_behind = 0.9f;

/// Of the mean of all places: what is darker on the whole is a room that no light enters, and its errors are not seen.
constexpr double least_share = 0.01;

/// As often the points' rays are taken as their noise asks for.
constexpr int most_passes = 16;

float brightness(const Vec3f& light) { return light[0] + light[1] + light[2]; }

}  // namespace

/// What is gathered at a point, in two halves whose difference tells their noise.
class TestPoints::Estimate {
 public:
  void place(const Box3f& box, const SurfaceSampler& surfaces, bool on_surface, Random& random) {
    on_surface_ = on_surface;
    if (on_surface) {
      const SurfacePoint sampled = surfaces.sample(random);
      position_ = sampled.position;
      normal_ = sampled.normal;
      return;
    }
    const Vec3f share{{random.uniform(), random.uniform(), random.uniform()}};
    position_ = box.lo + box.size() * share;
    normal_ = sample_sphere(random);
  }

  /// What is shown beside a grid's light: of that a few rays are enough, since it is no part of any difference.
  void add_beside(const GatheredLight& light, Random& random) {
    constexpr int rays = 64;
    beside_ = brightness(on_surface_ ? light.received(position_, normal_, rays, random).irradiance
                                     : light.around(position_, random, rays).moments.irradiance(normal_));
  }

  void add(const GatheredLight& light, const TestPointOptions& options, Random& random) {
    passes_++;
    for (Vec3f& half : halves_) {
      if (on_surface_) {
        const Received found = light.received(position_, normal_, options.rays / 2, random, options.near);
        half += found.irradiance;
        insides_ += found.insides / 2;
      } else {
        const NodeSurroundings found = light.around(position_, random, options.rays / 2);
        half += found.moments.irradiance(normal_);
        insides_ += found.insides / 2;
        behind_ += found.behind / 2;
      }
    }
  }

  /// Whether or not it is seen, summed over the colours.
  float all_light() const {
    return brightness((halves_[0] + halves_[1]) / (2.0f * static_cast<float>(passes_))) + beside_;
  }

  /// Dark where nobody sees it.
  Point point() const {
    const float passes = static_cast<float>(passes_);
    const bool hidden = on_surface_ ? insides_ > most_buried * passes
                                    : insides_ > most_insides * passes || behind_ > most_behind * passes;
    Point point{.position = position_, .normal = normal_, .on_surface = on_surface_, .irradiance = {}, .variance = {}};
    if (hidden) return point;
    point.set(halves_[0] / passes, halves_[1] / passes);
    point.beside = beside_;
    return point;
  }

 private:
  bool on_surface_ = false;
  Vec3f position_{}, normal_{};
  std::array<Vec3f, 2> halves_{};
  float beside_ = 0;
  float insides_ = 0, behind_ = 0;
  int passes_ = 0;
};

Result<TestPoints> TestPoints::gather(const GatheredLight& light, const TestPointOptions& options, Progress& progress) {
  TestPoints test;
  const SurfaceSampler surfaces(light.world().surfaces(), light.box());
  if (surfaces.empty()) return test;
  const size_t count = options.surface_points + options.free_points;
  progress.stage("estimating the error", static_cast<double>(count), "points");
  std::vector<Estimate> estimates(count);
  std::vector<Point>& points = test.points_;
  for (int pass = 0; pass < most_passes; pass++) {
    parallel_for(
        count, 4, options.threads,
        [&](size_t begin, size_t end, int) {
          for (size_t i = begin; i < end; i++) {
            Random place(options.seed, i);
            Estimate& estimate = estimates[i];
            if (pass == 0) estimate.place(light.box(), surfaces, i < options.surface_points, place);
            Random more(options.seed + static_cast<uint64_t>(pass), ~i);
            estimate.add(light, options, pass == 0 ? place : more);
            if (pass == 0 && options.beside != nullptr) estimate.add_beside(*options.beside, place);
          }
        },
        [&] { return progress.cancelled(); });
    if (progress.cancelled()) return fail(ErrorKind::cancelled, "light", "cancelled");
    points.clear();
    double sum = 0;
    for (const Estimate& estimate : estimates) {
      points.push_back(estimate.point());
      sum += static_cast<double>(estimate.all_light());
    }
    test.all_ = sum / (3 * static_cast<double>(count));
    keep_lit(points);
    if (test.noise() <= options.most_noise || std::chrono::steady_clock::now() >= options.deadline) break;
  }
  return test;
}

/// Leaves out what is too dark to be seen.
void TestPoints::keep_lit(std::vector<Point>& points) {
  const auto light = [](const Point& point) { return brightness(point.irradiance) + point.beside; };
  std::ranges::sort(points, {}, light);
  const float least = least_lit * light(points[points.size() * 9 / 10]);
  if (least > 0) std::erase_if(points, [&](const Point& point) { return !(light(point) > least); });
}

float TestPoints::noise() const {
  if (points_.empty()) return 0;
  double variance = 0;
  for (const Point& point : points_) variance += static_cast<double>(brightness(point.variance));
  return static_cast<float>(std::sqrt(variance / (3 * static_cast<double>(points_.size()))) / size());
}

double TestPoints::square(const LightGrid& grid, const Point& point) {
  const Vec3f difference = grid.irradiance(point.position, point.normal) - point.irradiance;
  return static_cast<double>(dot(difference, difference) - brightness(point.variance));
}

double TestPoints::mean() const {
  if (points_.empty()) return 0;
  double sum = 0;
  for (const Point& point : points_) sum += static_cast<double>(brightness(point.irradiance) + point.beside);
  return sum / (3 * static_cast<double>(points_.size()));
}

bool TestPoints::dark() const { return mean() < least_share * all_; }

double TestPoints::size() const {
  const double size = dark() ? all_ : mean();
  return size > 0 ? size : 1;
}

template <typename Chosen>
float TestPoints::error_of(const LightGrid& grid, const Chosen& chosen) const {
  double squares = 0, variance = 0, count = 0;
  for (const Point& point : points_) {
    if (!chosen(point)) continue;
    squares += square(grid, point);
    variance += static_cast<double>(brightness(point.variance));
    count++;
  }
  if (count == 0) return 0;
  // What is left of the squares without the noise scatters by the noise's variance times the root of 2 / count, for
  // errors that are normally distributed: less than that cannot be told from nothing.
  const double hidden = variance * std::sqrt(2 / count);
  return static_cast<float>(std::sqrt(std::max(squares, hidden) / (3 * count)) / size());
}

float TestPoints::error(const LightGrid& grid) const {
  return error_of(grid, [](const Point&) { return true; });
}

ErrorEstimate TestPoints::errors(const LightGrid& grid) const {
  return {.surface = error_of(grid, [](const Point& point) { return point.on_surface; }),
          .free = error_of(grid, [](const Point& point) { return !point.on_surface; })};
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
  if (points_.empty()) return 0;
  double differences = 0;
  for (const Excess& point : excess(grid)) differences += static_cast<double>(point.error);
  return static_cast<float>(differences / (3 * static_cast<double>(points_.size())) / size());
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
