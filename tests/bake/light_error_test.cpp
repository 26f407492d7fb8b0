// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/light_error.h"

#include <gtest/gtest.h>

#include "tests/trace/chi_square.h"
#include "tests/trace/scenes.h"

namespace lightwell {
namespace {

/// A furnace: its indirect irradiance is the same everywhere, pi Le rho / (1 - rho).
struct Furnace {
  Scene scene = scene_of(room({{0, 0, 0}}, {{2, 1.5f, 3}}), lambertian(0.5f, 2));
  std::unique_ptr<const World> world = world_of(scene);
  Progress silent;
  FreeSpace space = FreeSpace::survey(*world, {}, silent).value();
  std::vector<Vec3f> middle{{{1, 0.7f, 1.5f}}};
  SurfaceCache cache =
      SurfaceCache::build(*world, middle, {.region = world->surfaces().bounds(), .cell = 0.2f, .samples = 256}, silent)
          .value();
  GatheredLight light{{*world, space, cache, world->surfaces().bounds()}, {}};
  float irradiance = 2 * pi;

  /// A grid of so many times the right light, on its half of x < 1 and on the other.
  LightGrid grid(float left, float right) const {
    LightGrid grid;
    grid.shape = GridShape::over(world->surfaces().bounds(), 31);
    for (size_t i = 0; i < grid.shape.count(); i++) {
      Moments moments;
      const bool is_left = grid.shape.position(grid.shape.node(i))[0] < 1;
      for (size_t k = 0; k < 6; k++) moments.m[k] = Vec3f::filled(irradiance * (is_left ? left : right));
      grid.moments.push_back(moments);
    }
    grid.valid.assign(grid.shape.count(), 1);
    return grid;
  }
};

/// A furnace around a small bright block, which few rays find.
struct BrightBlock {
  Furnace furnace;
  Progress silent;
  std::unique_ptr<const World> world = [this] {
    add(furnace.scene, block({{0.9f, 0.6f, 1.4f}}, {{1.1f, 0.8f, 1.6f}}), lambertian(0.5f, 400));
    return world_of(furnace.scene);
  }();
  Box3f box = world->surfaces().bounds();
  SurfaceCache cache = SurfaceCache::build(*world, furnace.middle, {.region = box, .cell = 0.2f}, silent).value();
  GatheredLight light{{*world, furnace.space, cache, box}, {}};
  TestPointOptions few{.surface_points = 100, .rays = 32, .near = 8};
};

// The cells' noise, some 1.5 %, is what is left of a grid that is right.
TEST(TestPoints, TellTheErrorOfAGrid) {
  Furnace furnace;
  const TestPoints test = TestPoints::gather(furnace.light, {}, furnace.silent).value();
  EXPECT_LT(test.error(furnace.grid(1, 1)), 0.02f);
  EXPECT_NEAR(test.error(furnace.grid(1.3f, 1.3f)), 0.3f, 0.02f);
  // Half of the area errs by 40 %, the other half not at all.
  EXPECT_NEAR(test.error(furnace.grid(1, 0.6f)), 0.4f * std::sqrt(0.5f), 0.03f);
}

// Those in free space are spread over the box evenly: where the grid is twice too bright each of them says where it is,
// in 8 x 8 x 8 parts. Those on surfaces are SurfaceSampler's.
TEST(TestPoints, InFreeSpaceLieAnywhere) {
  Furnace furnace;
  const TestPointOptions free{.surface_points = 0, .free_points = 20000, .rays = 16};
  const TestPoints test = TestPoints::gather(furnace.light, free, furnace.silent).value();
  const std::vector<TestPoints::Excess> found = test.excess(furnace.grid(2, 2));
  EXPECT_GT(found.size(), free.free_points - 20) << "a point or two lie within the noise of their few rays";
  const Box3f box = furnace.world->surfaces().bounds();
  std::vector<int> counts(512);
  for (const TestPoints::Excess& excess : found) {
    size_t bin = 0;
    for (int a = 0; a < 3; a++) {
      const float share = (excess.position[a] - box.lo[a]) / box.size()[a];
      bin = 8 * bin + static_cast<size_t>(std::clamp(share, 0.0f, 0.999999f) * 8);
    }
    counts[bin]++;
  }
  EXPECT_GT(chi_square_of_equal_bins(counts), least_probability);
}

// With few rays noise is larger than the errors that are looked for; a grid's error must not drown in it.
TEST(TestPoints, TakeRaysUntilTheirNoiseIsSmall) {
  BrightBlock lit;
  TestPointOptions enough = lit.few;
  enough.most_noise = 0.2f;
  EXPECT_GT(TestPoints::gather(lit.light, lit.few, lit.silent).value().noise(), 0.2f);
  EXPECT_LE(TestPoints::gather(lit.light, enough, lit.silent).value().noise(), 0.2f);
}

// By chance what is left without the noise can be less than nothing: that is no reason to state an error of 0.
TEST(TestPoints, NeverTellOfNoError) {
  BrightBlock lit;
  for (uint64_t seed = 1; seed <= 20; seed++) {
    TestPointOptions few = lit.few;
    few.seed = seed;
    few.free_points = 20;
    const TestPoints test = TestPoints::gather(lit.light, few, lit.silent).value();
    for (const float share : {1.0f, 2.0f, 3.0f, 5.0f}) {
      const LightGrid grid = lit.furnace.grid(share, share);
      EXPECT_GT(test.error(grid), 0) << seed << ' ' << share;
      EXPECT_GT(test.errors(grid).surface, 0) << seed << ' ' << share;
      EXPECT_GT(test.errors(grid).free, 0) << seed << ' ' << share;
    }
  }
}

// A closed room under a sky: its fronts are black, and the light outside, which nobody sees, is what little errors are
// held against.
TEST(TestPoints, KnowARoomThatNoLightEnters) {
  Scene scene = scene_of(room({{0, 0, 0}}, {{2, 1.5f, 3}}), lambertian(0.5f));
  scene.environment.radiance = Vec3f::filled(1);
  const auto world = world_of(scene);
  Progress silent;
  const FreeSpace space = FreeSpace::survey(*world, {}, silent).value();
  const Box3f bounds = world->surfaces().bounds();
  const Box3f box{bounds.lo - Vec3f::filled(1), bounds.hi + Vec3f::filled(1)};
  const std::vector<Vec3f> middle{box.center()};
  const SurfaceCache cache = SurfaceCache::build(*world, middle, {.region = box, .cell = 0.2f}, silent).value();
  const GatheredLight light({*world, space, cache, box}, {});
  const TestPoints test = TestPoints::gather(light, {.surface_points = 200, .free_points = 200}, silent).value();
  EXPECT_TRUE(test.dark());
  Furnace furnace;
  LightGrid grid = furnace.grid(1e-6f, 1e-6f);
  EXPECT_LT(test.error(grid), 0.01f) << "a millionth of the light outside";
  EXPECT_GT(test.error(furnace.grid(1, 1)), 1) << "a leak of all of it";
  EXPECT_FALSE(TestPoints::gather(furnace.light, {}, furnace.silent).value().dark());
}

TEST(TestPoints, AreTheSameForAnyNumberOfThreads) {
  Furnace furnace;
  const LightGrid grid = furnace.grid(1, 0.9f);
  const auto error = [&](int threads) {
    return TestPoints::gather(furnace.light, {.threads = threads}, furnace.silent).value().error(grid);
  };
  const float one = error(1);
  EXPECT_EQ(error(2), one);
  EXPECT_EQ(error(5), one);
}

TEST(TestPoints, StopWhenAsked) {
  struct Impatient : Progress {
    bool cancelled() const override { return true; }
  } impatient;
  Furnace furnace;
  const auto test = TestPoints::gather(furnace.light, {}, impatient);
  ASSERT_FALSE(test);
  EXPECT_EQ(test.error().kind, ErrorKind::cancelled);
}

}  // namespace
}  // namespace lightwell
