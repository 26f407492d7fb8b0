// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/focus.h"

#include <gtest/gtest.h>

#include "tests/trace/scenes.h"

namespace lightwell {
namespace {

/// A room of 4 x 3 x 4 m around a place on the ground, with a block in it.
Scene small_room(const Vec3f& at = {}) {
  Scene scene = scene_of(room(at + Vec3f{{-2, 0, -2}}, at + Vec3f{{2, 3, 2}}), lambertian(0.7f));
  add(scene, block(at + Vec3f{{0.3f, 0, 0.2f}}, at + Vec3f{{1, 0.8f, 0.9f}}), lambertian(0.5f, 1));
  return scene;
}

Mesh ground(float half, int parts) {
  Mesh mesh;
  const float side = 2 * half / static_cast<float>(parts);
  for (int i = 0; i < parts * parts; i++) {
    const Vec3f corner{
        {side * static_cast<float>(i % parts) - half, -0.01f, side * static_cast<float>(i / parts) - half}};
    append(mesh, quad(corner, {{0, 0, side}}, {{side, 0, 0}}));
  }
  return mesh;
}

Box3f focus(const Scene& scene) { return traced(scene)->focus(); }
Box3f whole(const Scene& scene) { return traced(scene)->bounds(); }

const Box3f room_box{{{-2, 0, -2}}, {{2, 3, 2}}};

TEST(Focus, IsAllOfAnOrdinaryScene) {
  for (const Scene& scene : {small_room(), scene_of(sphere(1, 4), lambertian(0.5f)),
                             scene_of(quad({}, {{1, 0, 0}}, {{0, 1, 0}}), lambertian(1))})
    EXPECT_EQ(focus(scene), whole(scene));
}

TEST(Focus, LeavesOutAGroundOfKilometres) {
  Scene scene = small_room();
  add(scene, ground(1000, 1), lambertian(0.7f));
  EXPECT_EQ(focus(scene), room_box);
}

// Most faces are the ground's, and a lamp says which part is meant.
TEST(Focus, FollowsLamps) {
  Scene scene = small_room();
  scene.lamps = {point_lamp({{0, 2, 0}}, {{1, 1, 1}})};
  add(scene, ground(1000, 12), lambertian(0.7f));
  EXPECT_EQ(focus(scene), room_box);
  scene.lamps.push_back(point_lamp({{-20, 5, 0}}, {{1, 1, 1}}));
  EXPECT_EQ(focus(scene), (Box3f{{{-20, 0, -2}}, {{2, 5, 2}}}));
  scene.lamps.push_back(point_lamp({{400, 5, 0}}, {{1, 1, 1}}));
  EXPECT_EQ(focus(scene), whole(scene));
}

TEST(Focus, LeavesOutASkyDomeAndAStray) {
  Scene scene = small_room();
  add(scene, sphere(500, 0), lambertian(0, 1));
  EXPECT_EQ(focus(scene), room_box);
  scene = small_room();
  Mesh splinter;
  splinter.positions = {{{900, 0, 0}}, {{901, 0, 0}}, {{900, 1, 0}}};
  splinter.faces = {{0, 1, 2}};
  add(scene, splinter, lambertian(0.5f));
  EXPECT_EQ(focus(scene), room_box);
}

// The mesh right round a lamp is no statue.
TEST(Focus, IsNotABulb) {
  Scene scene = scene_of(room({{-2, 0, -2}}, {{2, 3, 2}}), lambertian(0.7f));
  add(scene, turned(sphere(0.05f, 4)), lambertian(0.9f), {.t = {{0, 2, 0}}});
  EXPECT_LT(length(focus(scene).size()), 1);
  scene.lamps = {point_lamp({{0, 2, 0}}, {{5, 5, 5}})};
  EXPECT_EQ(focus(scene), room_box);
}

// A statue of many faces in a hall of few: the hall's camera stands in it.
TEST(Focus, KeepsAHallAroundASmallScan) {
  Scene scene = scene_of(room({{-10, 0, -10}}, {{10, 6, 10}}), lambertian(0.7f));
  add(scene, sphere(0.1f, 4), lambertian(0.5f), {.t = {{0, 1, 0}}});
  EXPECT_LT(length(focus(scene).size()), 1);  // nothing says that the hall matters
  Camera camera;
  camera.to_scene.t = {{-8, 2, 8}};
  scene.cameras = {camera};
  EXPECT_EQ(focus(scene), whole(scene));
}

TEST(Focus, TellsTwoEqualPartsNotApart) {
  Scene scene = small_room();
  for (const Scene& other : {small_room({{300, 0, 0}})})
    for (const Primitive& primitive : other.primitives) add(scene, primitive.mesh, lambertian(0.7f));
  EXPECT_EQ(focus(scene), whole(scene));
}

}  // namespace
}  // namespace lightwell
