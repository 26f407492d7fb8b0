// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/bake/gathered_light.h"
#include "lightwell/base/progress.h"
#include "lightwell/light/grid.h"

namespace lightwell {

/// The light of random points of the fronts of surfaces, evenly spread over their area, gathered apart from any grid:
/// what a grid is measured by.
class TestPoints {
 public:
  /// The same for any number of threads. Fails when `progress` asks to stop.
  static Result<TestPoints> gather(const World& world, const GatheredLight& light, uint64_t seed, int threads,
                                   Progress& progress);

  /// The root mean square difference of a grid at the points, without the noise of the gathered light, as a share of
  /// the mean irradiance. Points that next to no light reaches, below 3 % of what a tenth of all points have at
  /// least, say nothing of what is seen, and are left out. Where no point is lit it is
  /// the difference itself, W/m2.
  float error(const LightGrid& grid) const;
  /// Of a few normal offsets the one with which the grid errs least: small where nodes stand well, larger where walls
  /// are thinner than a cell.
  float best_offset(LightGrid grid) const;

 private:
  struct Point {
    Vec3f position{}, normal{};
    Vec3f irradiance{};  // W/m2
    Vec3f variance{};
  };
  std::vector<Point> points_;
};

}  // namespace lightwell
