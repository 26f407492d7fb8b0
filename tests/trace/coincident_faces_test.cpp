// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/coincident_faces.h"

#include <gtest/gtest.h>

#include <ctime>

#include "lightwell/trace/sampling.h"
#include "tests/trace/scenes.h"

namespace lightwell {
namespace {

constexpr std::array<Vec3f, 3> face{{{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}}};
constexpr std::array<Vec3f, 3> begun_elsewhere{{{{1, 0, 0}}, {{0, 1, 0}}, {{-0.f, 0, 0}}}};
constexpr std::array<Vec3f, 3> turned_round{{{{0, 0, 0}}, {{0, 1, 0}}, {{1, 0, 0}}}};
constexpr std::array<Vec3f, 3> elsewhere{{{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 1e-7f}}}};

TEST(CoincidentFaces, HidesTheSameFaceOnly) {
  CoincidentFaces faces;
  EXPECT_FALSE(faces.hides(face, {}));
  EXPECT_FALSE(faces.hides(turned_round, {}));
  EXPECT_FALSE(faces.hides(elsewhere, {}));
  EXPECT_FALSE(faces.hides(face, {.shines = true}));
  EXPECT_TRUE(faces.hides(face, {}));
  EXPECT_TRUE(faces.hides(begun_elsewhere, {}));
  EXPECT_TRUE(faces.hides(turned_round, {.mirrored = true}));
  EXPECT_TRUE(faces.hides(face, {.opaque = false})) << "what is behind a wall";
}

TEST(CoincidentFaces, WhatLetsLightPassHidesNothingUntilItIsMany) {
  CoincidentFaces faces;
  for (int i = 0; i < CoincidentFaces::most_layers; i++) EXPECT_FALSE(faces.hides(face, {.opaque = false})) << i;
  EXPECT_TRUE(faces.hides(face, {.opaque = false}));
}

TEST(CoincidentFaces, AWallBehindGlassIsStillThere) {
  CoincidentFaces faces;
  EXPECT_FALSE(faces.hides(face, {.opaque = false}));
  EXPECT_FALSE(faces.hides(face, {}));
  EXPECT_TRUE(faces.hides(face, {}));
}

// Ten thousand blocks in one place are one block for rays. The processor time of the same rays tells: were all faces
// traced, it would be thousands of times as long.
TEST(CoincidentFaces, ManyBlocksInOnePlaceCostWhatOneDoes) {
  const auto seconds_of = [](size_t blocks, float& farthest) {
    const Mesh mesh = block({{-1, -1, -1}}, {{1, 1, 1}});
    Scene scene = scene_of(mesh, lambertian(0.5f));
    for (size_t i = 1; i < blocks; i++) add(scene, mesh, lambertian(0.5f));
    const auto trace = traced(scene);
    Random random(1, 0);
    farthest = 0;
    const std::clock_t begin = std::clock();
    for (int i = 0; i < 20000; i++) {
      const Vec3f direction = sample_sphere(random);
      Hit hit;
      EXPECT_TRUE(trace->intersect({direction * 5, -direction}, random, hit));
      EXPECT_TRUE(hit.front);
      farthest = std::max(farthest, hit.distance);
    }
    return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  };
  float one_farthest, many_farthest;
  const double one = seconds_of(1, one_farthest), many = seconds_of(10000, many_farthest);
  EXPECT_EQ(one_farthest, many_farthest);
  EXPECT_LT(many, 20 * one + 0.1) << "a busy machine's caches and clock";
}

}  // namespace
}  // namespace lightwell
