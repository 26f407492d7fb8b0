// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/contained.h"

#include <gtest/gtest.h>

#include "tests/trace/scenes.h"

namespace lightwell {
namespace {

ClientLamp lamp_of(ClientLamp::Kind kind, const Vec3f& center, int node) {
  ClientLamp lamp;
  lamp.kind = kind;
  lamp.center = center;
  lamp.node = node;
  return lamp;
}

/// Three lit panels of one node, a point lamp of another, and a sky.
Scene scene_of_lamps() {
  Mesh panels = quad({{0, 3, 0}}, {{1, 0, 0}}, {{0, 0, 1}});
  append(panels, quad({{3, 3, 0}}, {{1, 0, 0}}, {{0, 0, 1}}));
  append(panels, quad({{6, 3, 0}}, {{1, 0, 0}}, {{0, 0, 1}}));
  Scene scene = scene_of(panels, lambertian(0, 1));
  scene.instances[0].node = 4;
  scene.lamps = {point_lamp({{1, 1, 1}}, Vec3f::filled(1))};
  scene.lamps[0].node = 7;
  scene.environment.radiance = Vec3f::filled(1);
  return scene;
}

// Luminaires are counted lamps first, then surfaces, then the environment. The panel's centre is that of a finer level.
TEST(ContainedLuminaires, AreAllButTheClientsLamps) {
  const Scene scene = scene_of_lamps();
  const auto world = world_of(scene);
  const ClientLamp panel = lamp_of(ClientLamp::Kind::rectangle, {{3.6f, 3, 0.4f}}, 4);
  const ClientLamp point = lamp_of(ClientLamp::Kind::point, {{1, 1, 1}}, 7);
  const ClientLamp other = lamp_of(ClientLamp::Kind::point, {}, 9);
  const auto contained = [&](const std::vector<ClientLamp>& lamps, bool environment) {
    return contained_luminaires(lamps, {.environment = environment}, *world);
  };
  EXPECT_EQ(contained({panel}, false), luminaires({1, 1, 0, 1, 0}));
  EXPECT_EQ(contained({panel, point}, true), luminaires({0, 1, 0, 1, 1}));
  // Two lamps at one place are two luminaires; one of another node is none of these.
  EXPECT_EQ(contained({panel, panel}, false), luminaires({1, 1, 0, 0, 0}));
  EXPECT_EQ(contained({other}, false), luminaires({1, 1, 1, 1, 0}));
}

}  // namespace
}  // namespace lightwell
