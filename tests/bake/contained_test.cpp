// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/contained.h"

#include <gtest/gtest.h>

#include "tests/trace/scenes.h"

namespace lightwell {
namespace {

ClientLamp lamp_of(const LuminaireId& id) {
  ClientLamp lamp;
  lamp.luminaire = id;
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

// Luminaires are counted lamps first, then surfaces, then the environment.
TEST(ContainedLuminaires, AreAllButTheClientsLamps) {
  using Kind = LuminaireId::Kind;
  const Scene scene = scene_of_lamps();
  const auto world = world_of(scene);
  const ClientLamp panel = lamp_of({Kind::surface, 4, 0, -1, 4});
  const ClientLamp point = lamp_of({Kind::lamp, 7});
  const auto contained = [&](const std::vector<ClientLamp>& lamps, bool environment) {
    return contained_luminaires(lamps, {.environment = environment}, *world);
  };
  EXPECT_EQ(contained({panel}, false), luminaires({1, 1, 0, 1, 0}));
  EXPECT_EQ(contained({panel, point}, true), luminaires({0, 1, 0, 1, 1}));
  // What differs in any part of its id is another luminaire.
  for (const LuminaireId& other : {LuminaireId{Kind::lamp, 9}, LuminaireId{Kind::surface, 4, 1, -1, 4},
                                   LuminaireId{Kind::surface, 4, 0, 0, 4}, LuminaireId{Kind::surface, 4, 0, -1, 5}})
    EXPECT_EQ(contained({lamp_of(other)}, false), luminaires({1, 1, 1, 1, 0}));
}

}  // namespace
}  // namespace lightwell
