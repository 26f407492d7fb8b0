// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cmath>
#include <limits>
#include <vector>

#include "lightwell/bake/gathered_light.h"
#include "lightwell/base/progress.h"
#include "lightwell/light/error_estimate.h"
#include "lightwell/light/grid.h"

namespace lightwell {

struct TestPointOptions {
  size_t surface_points = 500;
  size_t free_points = 0;
  int rays = 1024;  ///< of a point, and as many again, up to 15 times, until their noise is small enough
  float most_noise = std::numeric_limits<float>::infinity();  ///< see noise()
  /// When no more are taken, however noisy they are.
  std::chrono::steady_clock::time_point deadline = std::chrono::steady_clock::time_point::max();
  float near = 1;  ///< cells of the surface cache within which the rays of surface points do not end in it
  /// Light that is shown beside that of grids, if any: errors are shares of both.
  const GatheredLight* beside = nullptr;
  uint64_t seed = 1;
  int threads = 0;  ///< 0: all processors
};

/// The light of random points of the fronts of surfaces, evenly spread over their area, and of free space, in the box
/// of what is baked, gathered apart from any grid: what a grid is measured by.
class TestPoints {
 public:
  /// The same for any number of threads. Fails when `progress` asks to stop.
  static Result<TestPoints> gather(const GatheredLight& light, const TestPointOptions& options, Progress& progress);

  /// How much the grid errs at a point, W/m2 summed over the colours, beyond what the noise of the gathered light may
  /// make of it; at least 0.
  struct Excess {
    Vec3f position{};
    float error = 0;
  };
  std::vector<Excess> excess(const LightGrid& grid) const;

  /// The root mean square difference of a grid at the points, without the noise of the gathered light, as a share of
  /// the mean irradiance. Points that next to no light reaches, below 3 % of what a tenth of all points have at
  /// least, say nothing of what is seen, and are left out. Where they are dark() it is a share of the light of all
  /// places, seen or not, and where there is none the difference itself, W/m2. Never less than what the noise hides,
  /// which is 0 only where there is none.
  float error(const LightGrid& grid) const;
  /// The same of each kind of points alone, as a share of the mean irradiance of all; 0 where there are none.
  ErrorEstimate errors(const LightGrid& grid) const;
  /// The mean difference, of any sign, as a share of the mean irradiance: the few points of narrow gaps, which a root
  /// mean square is made of, do not rule it.
  float mean_error(const LightGrid& grid) const;
  /// By what a grid is chosen: the geometric mean of both.
  float badness(const LightGrid& grid) const { return std::sqrt(mean_error(grid) * error(grid)); }
  /// The root mean square noise of the gathered light, as a share of the mean irradiance.
  float noise() const;
  /// Whether next to no light reaches what is seen: less than a hundredth of what there is in the mean of all places,
  /// those that nobody sees among them, such as the outside of a room without an opening.
  bool dark() const;
  /// Of a few normal offsets, in cells of each level, the one with which the grid errs least: small where nodes stand
  /// well, larger where walls are thinner than a cell.
  float best_offset(LightGrid grid) const;

 private:
  class Estimate;
  struct Point {
    Vec3f position{};
    Vec3f normal{};  // of the surface; in free space that of one that might be there
    bool on_surface = true;
    Vec3f irradiance{};  // W/m2
    Vec3f variance{};
    float beside = 0;  // W/m2, summed over the colours: TestPointOptions::beside

    /// Of two independent estimates.
    void set(const Vec3f& a, const Vec3f& b) {
      irradiance = (a + b) / 2.0f;
      variance = (a - b) * (a - b) / 4.0f;
    }
  };
  template <typename Chosen>
  float error_of(const LightGrid& grid, const Chosen& chosen) const;
  static void keep_lit(std::vector<Point>& points);
  /// The squared difference of a grid at a point beyond the noise of the gathered light, summed over the colours.
  static double square(const LightGrid& grid, const Point& point);
  /// The mean irradiance of a colour, with that beside, W/m2.
  double mean() const;
  /// What errors are shares of, W/m2.
  double size() const;
  std::vector<Point> points_;
  double all_ = 0;  ///< the same of all places, seen or not
};

}  // namespace lightwell
