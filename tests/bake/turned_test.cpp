// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/turned.h"

#include <gtest/gtest.h>

#include "lightwell/bake/free_space.h"
#include "tests/trace/scenes.h"

namespace lightwell {
namespace {

struct Ready {
  std::unique_ptr<const World> world;
  std::vector<std::string> warnings;
};

Ready ready(Scene& scene) {
  Progress silent;
  Report report;
  auto world = world_facing_light(scene, 2, silent, report);
  LW_ASSERT(world.has_value());
  return {std::move(*world), report.warnings};
}

const Vec3f lo{{-2, 0, -2}}, hi{{2, 3, 2}};

Mesh lamp() { return quad({{-0.5f, 2.9f, -0.5f}}, {{1, 0, 0}}, {{0, 0, 1}}); }
Mesh table() { return block({{0.3f, 0, 0.2f}}, {{1, 0.8f, 0.9f}}); }

/// The faces of the first primitive, sorted corners first: the winding is what is compared.
std::vector<Face> faces(const Scene& scene) { return scene.primitives[0].mesh.faces; }

TEST(Turned, IsARoomWhoseFacesLookOutwards) {
  Scene scene = scene_of(block(lo, hi), lambertian(0.7f));
  const std::vector<Vec3f> outwards = smooth_normals(scene.primitives[0].mesh);
  scene.primitives[0].mesh.normals = outwards;
  add(scene, table(), lambertian(0.5f));
  add(scene, lamp(), lambertian(0, 10));
  const std::vector<Face> table_faces = scene.primitives[1].mesh.faces;
  const Ready turned = ready(scene);
  EXPECT_EQ(faces(scene), faces(scene_of(room(lo, hi), {})));
  EXPECT_EQ(scene.primitives[0].mesh.normals[0], -outwards[0]);
  EXPECT_EQ(scene.primitives[1].mesh.faces, table_faces);
  ASSERT_EQ(turned.warnings.size(), 1u);
  EXPECT_NE(turned.warnings[0].find("look away from the light"), std::string::npos);
  // Once is enough.
  EXPECT_TRUE(ready(scene).warnings.empty());
  Progress silent;
  const FreeSpace space = FreeSpace::survey(*turned.world, {}, silent).value();
  Hit hit;
  Random random(1, 0);
  ASSERT_TRUE(turned.world->surfaces().intersect({{{0, 1, 0}}, {{1, 0, 0}}}, random, hit));
  EXPECT_FALSE(space.from_inside(hit));
}

// Walls of their own, each a sheet; with a punctual lamp and nothing else.
TEST(Turned, AreSeparateWalls) {
  Scene scene;
  const Mesh all = block(lo, hi);
  for (size_t side = 0; side < 6; side++) {
    Mesh wall = all;
    wall.faces = {all.faces[2 * side], all.faces[2 * side + 1]};
    add(scene, wall, lambertian(0.7f));
  }
  scene.lamps = {point_lamp({{0, 2, 0}}, {{5, 5, 5}})};
  EXPECT_EQ(ready(scene).warnings.size(), 1u);
  for (size_t side = 0; side < 6; side++)
    EXPECT_EQ(scene.primitives[side].mesh.faces[0][1], all.faces[2 * side][2]) << side;
}

TEST(Turned, IsNothingThatIsRight) {
  Scene lit = scene_of(room(lo, hi), lambertian(0.7f));
  add(lit, table(), lambertian(0.5f));
  add(lit, lamp(), lambertian(0, 10));
  // Dark inside, a sky outside; a sheet under a sky that faces the ground; a ball; a bulb around a lamp.
  Scene dark = scene_of(room(lo, hi), lambertian(0.7f));
  dark.environment.radiance = {{1, 1, 1}};
  Scene sheet = scene_of(quad(lo, {{4, 0, 0}}, {{0, 0, 4}}), lambertian(0.7f));
  add(sheet, quad({{-2, -2, -2}}, {{0, 0, 4}}, {{4, 0, 0}}), lambertian(0.7f));
  sheet.environment.radiance = {{1, 1, 1}};
  Scene ball = scene_of(turned(sphere(1, 3)), lambertian(0.7f));
  ball.environment.radiance = {{1, 1, 1}};
  Scene bulb = scene_of(room(lo, hi), lambertian(0.7f));
  add(bulb, turned(sphere(0.1f, 3)), lambertian(0.9f), Transform::translation({{0, 2, 0}}));
  bulb.lamps = {point_lamp({{0, 2, 0}}, {{5, 5, 5}})};
  for (Scene* scene : {&lit, &dark, &sheet, &ball, &bulb}) {
    const Scene before = *scene;
    EXPECT_TRUE(ready(*scene).warnings.empty());
    for (size_t i = 0; i < before.primitives.size(); i++)
      EXPECT_EQ(scene->primitives[i].mesh.faces, before.primitives[i].mesh.faces);
    EXPECT_EQ(scene->materials.size(), before.materials.size());
  }
}

// A house of one outward shell: the sky lights its walls from outside, a lamp from inside.
TEST(Turned, ShellLitFromBothSidesGetsTwo) {
  Scene scene = scene_of(block(lo, hi), lambertian(0.7f));
  add(scene, table(), lambertian(0.5f));
  add(scene, lamp(), lambertian(0, 10));
  scene.environment.radiance = {{1, 1, 1}};
  EXPECT_EQ(ready(scene).warnings.size(), 1u);
  EXPECT_EQ(faces(scene), faces(scene_of(block(lo, hi), {})));
  EXPECT_TRUE(scene.material_of(scene.primitives[0]).double_sided);
  EXPECT_FALSE(scene.material_of(scene.primitives[1]).double_sided);
}

/// Turns every face with a probability.
void mix(Mesh& mesh, float share, uint64_t seed) {
  Random random(seed, 0);
  for (Face& face : mesh.faces)
    if (random.uniform() < share) std::swap(face[1], face[2]);
}

// A ball, and the room round it, of mixed winding: with one side or two, in a closed room or under a sky.
TEST(Turned, AreFacesWoundAgainstTheRest) {
  for (const bool double_sided : {false, true})
    for (const bool sky : {false, true}) {
      const Mesh ball = turned(sphere(0.8f, 3));
      Scene scene = scene_of(ball, lambertian(0.6f));
      for (Vec3f& position : scene.primitives[0].mesh.positions) position[1] += 1.2f;
      scene.materials[0].double_sided = double_sided;
      mix(scene.primitives[0].mesh, 0.3f, 11);
      if (sky) {
        scene.environment.radiance = Vec3f::filled(1);
        add(scene, quad({{-4, 0, -4}}, {{0, 0, 8}}, {{8, 0, 0}}), lambertian(0.5f));
      } else {
        add(scene, room(lo, hi), lambertian(0.7f));
        mix(scene.primitives[1].mesh, 0.3f, 5);
        add(scene, lamp(), lambertian(0, 10));
      }
      const Ready made = ready(scene);
      EXPECT_EQ(scene.primitives[0].mesh.faces, ball.faces) << double_sided << sky;
      EXPECT_TRUE(sky || scene.primitives[1].mesh.faces == room(lo, hi).faces) << double_sided;
      ASSERT_EQ(made.warnings.size(), 1u);
      EXPECT_NE(made.warnings[0].find("wound against those beside them"), std::string::npos);
      EXPECT_TRUE(ready(scene).warnings.empty());
    }
}

/// Of all vertices: how many normals point where the faces round them do.
size_t normals_at_the_front(const Mesh& mesh) {
  const std::vector<Vec3f> fronts = smooth_normals(mesh);
  size_t count = 0;
  for (size_t i = 0; i < fronts.size(); i++) count += dot(mesh.normals[i], fronts[i]) > 0;
  return count;
}

// A ball in a lit room and under a sky: wound inwards or not, and with normals that point inwards or not.
TEST(Turned, NormalsPointWhereTheFacesDo) {
  for (const bool sky : {false, true})
    for (const bool faces_wrong : {false, true})
      for (const bool normals_wrong : {false, true}) {
        const Mesh right = turned(sphere(0.8f, 3));
        Scene scene = scene_of(right, lambertian(0.6f));
        Mesh& ball = scene.primitives[0].mesh;
        ball.normals = smooth_normals(right);
        if (faces_wrong) ball = turned(ball);
        for (size_t i = 0; i < ball.normals.size(); i++)
          ball.normals[i] = smooth_normals(right)[i] * (normals_wrong ? -1.0f : 1.0f);
        for (Vec3f& position : ball.positions) position[1] += 1.2f;
        if (sky) {
          scene.environment.radiance = Vec3f::filled(1);
        } else {
          add(scene, room(lo, hi), lambertian(0.7f));
          add(scene, lamp(), lambertian(0, 10));
        }
        const Ready made = ready(scene);
        const Mesh& found = scene.primitives[0].mesh;
        EXPECT_EQ(normals_at_the_front(found), found.positions.size()) << sky << faces_wrong << normals_wrong;
        // Under a sky a shell that looks inwards is a wall without a back.
        EXPECT_TRUE(sky || found.faces == right.faces) << faces_wrong << normals_wrong;
        EXPECT_EQ(made.warnings.empty(), sky ? faces_wrong == normals_wrong : !faces_wrong && !normals_wrong);
        EXPECT_TRUE(ready(scene).warnings.empty());
      }
}

// A scan of which a program has left some faces the wrong way round; every corner still knows where the front is.
TEST(Turned, AreFacesWoundAgainstTheirNormals) {
  const Mesh right = turned(sphere(0.8f, 4));
  Scene scene = scene_of(right, lambertian(0.6f));
  Mesh& scan = scene.primitives[0].mesh;
  scan.normals = smooth_normals(right);
  mix(scan, 0.03f, 21);
  ASSERT_NE(scan.faces, right.faces);
  scene.environment.radiance = Vec3f::filled(1);
  const Ready made = ready(scene);
  EXPECT_EQ(scene.primitives[0].mesh.faces, right.faces);
  ASSERT_EQ(made.warnings.size(), 1u);
  EXPECT_NE(made.warnings[0].find("wound against the normals of their corners"), std::string::npos);
}

// Leaves whose normals are those of the crown: half of them point to a card's back, on purpose.
TEST(Turned, NormalsOfACrownStay) {
  Scene scene;
  scene.environment.radiance = Vec3f::filled(1);
  Mesh leaves;
  Random random(3, 0);
  for (uint32_t i = 0; i < 40; i++) {
    const Vec3f place = sample_sphere(random);
    const Vec3f u = sample_sphere(random) * 0.1f, v = sample_sphere(random) * 0.1f;
    for (const Vec3f& corner : {place, place + u, place + v}) {
      leaves.positions.push_back(corner);
      leaves.normals.push_back(place);
    }
    leaves.faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  add(scene, leaves, lambertian(0.5f));
  scene.materials.back().double_sided = true;
  EXPECT_TRUE(ready(scene).warnings.empty());
  EXPECT_EQ(scene.primitives[0].mesh.normals, leaves.normals);
}

}  // namespace
}  // namespace lightwell
