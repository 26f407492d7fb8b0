// SPDX-License-Identifier: Apache-2.0
#include "lightwell/light/grid_sum.h"

#include "lightwell/base/assert.h"

namespace lightwell {

void add_light(LightGrid& sum, const LightGrid& more) {
  LW_ASSERT(sum.shape == more.shape && sum.valid == more.valid && sum.bricks.size() == more.bricks.size());
  for (size_t node = 0; node < sum.moments.size(); node++) sum.moments[node] += more.moments[node];
  for (size_t brick = 0; brick < sum.bricks.size(); brick++)
    for (size_t point = 0; point < Brick::points; point++)
      sum.bricks[brick][point].moments += more.bricks[brick][point].moments;
}

void scale_light(LightGrid& grid, const Vec3f& factor) {
  const auto scale = [&](Moments& moments) {
    for (Vec3f& moment : moments.m) moment = moment * factor;
  };
  for (Moments& node : grid.moments) scale(node);
  for (BrickPoints& points : grid.bricks)
    for (BrickPoint& point : points) scale(point.moments);
}

}  // namespace lightwell
