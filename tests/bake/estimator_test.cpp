// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/estimator.h"

#include <gtest/gtest.h>

#include <cstring>
#include <set>
#include <string>

#include "lightwell/base/random.h"
#include "tests/trace/scenes.h"

namespace lightwell {
namespace {

bool same_bits(const NodeLight& a, const NodeLight& b) {
  return a.moments.size() == b.moments.size() && a.insides == b.insides && a.noise == b.noise && a.rays == b.rays &&
         std::memcmp(a.moments.data(), b.moments.data(), a.moments.size() * sizeof(Moments)) == 0;
}

TEST(Estimators, HaveNamesOfTheirOwn) {
  std::set<std::string> names;
  for (const EstimatorKind& kind : estimators()) EXPECT_TRUE(names.insert(kind.name).second);
  EXPECT_FALSE(names.empty());
}

// However the samples are divided among threads, runs and machines, and in whatever order their sums are added.
TEST(Estimators, SumsOfPartsAddUpToTheSameBits) {
  Scene scene = scene_of(room({{0, 0, 0}}, {{2, 1, 3}}), lambertian({{0.7f, 0.5f, 0.2f}}));
  scene.lamps = {point_lamp({{1, 0.5f, 1}}, {{300, 1e-3f, 7}})};
  const auto world = world_of(scene);
  const GridShape shape = GridShape::over(world->lights().region(), 7);
  Progress silent;
  const FreeSpace space = FreeSpace::survey(*world, {}, silent).value();
  const std::vector<Vec3f> middle{{{1, 0.5f, 1.5f}}};
  const SurfaceCache cache =
      SurfaceCache::build(*world, middle, {.region = world->surfaces().bounds(), .cell = 0.2f}, silent).value();
  const BakeScene known{*world, space, cache, world->surfaces().bounds()};
  EstimatorOptions options;
  options.photons = 3001;
  for (const EstimatorKind& kind : estimators()) {
    const auto estimator = kind.make(known, shape, options);
    const auto whole = estimator->nothing();
    estimator->add(0, estimator->samples(), *whole);
    const NodeLight expected = estimator->finish(*whole);
    EXPECT_GT(expected.moments[0].m[0][0], 0) << kind.name;
    for (uint64_t seed = 0; seed < 5; seed++) {
      Random random(seed, 0);
      std::vector<std::unique_ptr<PartialLight>> parts;
      for (uint64_t begin = 0; begin < estimator->samples();) {
        const uint64_t end = std::min<uint64_t>(
            estimator->samples(), begin + random.below(1 + static_cast<uint32_t>(estimator->samples() / 4)));
        parts.push_back(estimator->nothing());
        estimator->add(begin, end, *parts.back());
        begin = end;
      }
      while (parts.size() > 1) {
        const size_t into = random.below(static_cast<uint32_t>(parts.size() - 1));
        parts[into]->add(*parts.back());
        parts.pop_back();
      }
      EXPECT_TRUE(same_bits(estimator->finish(*parts.front()), expected)) << kind.name << " " << seed;
    }
  }
}

}  // namespace
}  // namespace lightwell
