// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/enclosure.h"

#include <gtest/gtest.h>

#include "lightwell/trace/photons.h"
#include "tests/trace/scenes.h"

namespace lightwell {
namespace {

const Vec3f lamp_place{{0, 2, 0}};

Scene lit_room(float bulb) {
  Scene scene = scene_of(room({{-2, 0, -2}}, {{2, 3, 2}}), lambertian(0.0f));
  if (bulb > 0)
    add(scene, turned(sphere(bulb, 2)), lambertian(0.0f), Transform::translation(lamp_place.cast<double>()));
  add(scene, block({{-1.5f, 0, -1.5f}}, {{-0.5f, 0.8f, -0.5f}}), lambertian(0.0f));
  scene.lamps = {point_lamp(lamp_place, {{5, 5, 5}})};
  return scene;
}

TEST(Enclosure, IsKnownFromItsInside) {
  const Scene scene = lit_room(0.1f);
  const auto surfaces = traced(scene);
  const auto around = enclosure_of(*surfaces, lamp_place);
  ASSERT_TRUE(around);
  EXPECT_EQ(around->instance, 1u);
  EXPECT_NEAR(around->reach, 0.1f, 0.005f);
  EXPECT_FALSE(enclosure_of(*surfaces, {{1, 1, 1}}));  // a room shows its fronts
  EXPECT_FALSE(enclosure_of(*surfaces, {{0, 9, 0}}));
}

TEST(Enclosure, OfALampIsABulbWhenItIsSmall) {
  EXPECT_EQ(bulb_radius(*traced(lit_room(0)), lit_room(0).lamps[0]), 0);
  for (const float radius : {0.07f, 0.2f}) {
    const Scene scene = lit_room(radius);
    EXPECT_NEAR(bulb_radius(*traced(scene), scene.lamps[0]), radius * 1.05f, 0.05f * radius);
  }
  const Scene large = lit_room(0.5f);
  EXPECT_EQ(bulb_radius(*traced(large), large.lamps[0]), 0);
}

// Light comes out of a bulb, by samples of the lamp and by photons, as if there were none; the bulb itself stops none.
TEST(Enclosure, OfABulbLetsItsLightOut) {
  for (const float radius : {0.0f, 0.1f, 0.5f}) {
    const Scene scene = lit_room(radius);
    const auto world = world_of(scene);
    Random random(1, 0);
    const Vec3f floor{{0.5f, 0, 0}}, up{{0, 1, 0}};
    const Arrival arrival = world->lights().sample(floor, random);
    const bool seen = visibility(world->surfaces(), floor, up, arrival, random) == Vec3f::filled(1);
    EXPECT_EQ(seen, radius < 0.3f) << radius;
    int at_walls = 0;
    for (uint64_t i = 0; i < 200; i++) {
      Flight flight;
      PhotonWalk walk(*world, 1, i);
      ASSERT_TRUE(walk.next(flight));
      at_walls += walk.end() && walk.end()->distance > 0.6f;
    }
    EXPECT_EQ(at_walls, radius < 0.3f ? 200 : 0) << radius;
  }
}

}  // namespace
}  // namespace lightwell
