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

bool hides(CoincidentFaces& faces, const std::array<Vec3f, 3>& corners, const FaceLayer& layer) {
  return faces.add({}, corners, layer).hidden;
}

TEST(CoincidentFaces, HidesTheSameFaceOnly) {
  CoincidentFaces faces;
  EXPECT_FALSE(hides(faces, face, {}));
  EXPECT_FALSE(hides(faces, turned_round, {}));
  EXPECT_FALSE(hides(faces, elsewhere, {}));
  EXPECT_FALSE(hides(faces, face, {.shines = true}));
  EXPECT_TRUE(hides(faces, face, {}));
  EXPECT_TRUE(hides(faces, begun_elsewhere, {}));
  EXPECT_TRUE(hides(faces, turned_round, {.mirrored = true}));
  EXPECT_TRUE(hides(faces, face, {.opaque = false})) << "what is behind a wall";
}

TEST(CoincidentFaces, WhatLetsLightPassHidesNothingUntilItIsMany) {
  CoincidentFaces faces;
  for (int i = 0; i < CoincidentFaces::most_layers; i++) EXPECT_FALSE(hides(faces, face, {.opaque = false})) << i;
  EXPECT_TRUE(hides(faces, face, {.opaque = false}));
}

TEST(CoincidentFaces, AWallBehindGlassIsStillThere) {
  CoincidentFaces faces;
  EXPECT_FALSE(hides(faces, face, {.opaque = false}));
  EXPECT_FALSE(hides(faces, face, {}));
  EXPECT_TRUE(hides(faces, face, {}));
}

TEST(CoincidentFaces, TellsOfOneThatIsTurnedRound) {
  CoincidentFaces faces;
  EXPECT_FALSE(faces.add({0, 1}, face, {}).turned);
  const auto found = faces.add({2, 3}, turned_round, {});
  EXPECT_FALSE(found.hidden);
  ASSERT_TRUE(found.turned);
  EXPECT_EQ(found.turned->instance, 0u);
  EXPECT_EQ(found.turned->face, 1u);
  EXPECT_TRUE(faces.add({4, 5}, begun_elsewhere, {}).hidden);
  EXPECT_FALSE(faces.add({6, 7}, elsewhere, {}).turned);
  EXPECT_TRUE(faces.add({8, 9}, elsewhere, {.mirrored = true}).turned);
}

TEST(CoincidentFaces, PanesAreNoSheet) {
  CoincidentFaces faces;
  for (int i = 0; i < CoincidentFaces::most_layers; i++) faces.add({0, 1}, face, {.opaque = false});
  EXPECT_FALSE(faces.add({2, 3}, turned_round, {}).turned);
  EXPECT_FALSE(faces.add({4, 5}, turned_round, {.opaque = false}).turned);
}

// A sheet made of two faces, its back in another colour: each ray meets the side that it comes from, and where on it.
TEST(CoincidentFaces, ASheetOfTwoFacesShowsEachSide) {
  const auto sheet = [](bool turned) {
    Mesh mesh;
    mesh.positions = {{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}};
    mesh.faces = {turned ? Face{1, 0, 2} : Face{0, 1, 2}};
    return mesh;
  };
  Scene scene = scene_of(sheet(false), lambertian(0.5f));
  add(scene, sheet(true), lambertian(0.25f));
  const auto trace = traced(scene);
  Random random(1, 0);
  for (int i = 0; i < 1000; i++) {
    const Vec3f at{{0.5f * random.uniform(), 0.5f * random.uniform(), 0}};
    for (const float side : {1.0f, -1.0f}) {
      Hit hit;
      ASSERT_TRUE(trace->intersect({at + Vec3f{{0, 0, side}}, {{0, 0, -side}}}, random, hit));
      EXPECT_TRUE(hit.front);
      EXPECT_EQ(hit.normal, (Vec3f{{0, 0, side}}));
      EXPECT_EQ(trace->surface(hit).bsdf.diffuse[0], side > 0 ? 0.5f : 0.25f);
      const std::array<Vec3f, 3> corners = trace->corners(hit.instance, hit.face);
      const Vec3f found = corners[0] * (1 - hit.u - hit.v) + corners[1] * hit.u + corners[2] * hit.v;
      EXPECT_LT(length(found - at), 1e-5f) << "rounding";
    }
  }
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
