// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/contained.h"

#include <gtest/gtest.h>

#include "tests/trace/scenes.h"

namespace lightwell {
namespace {

/// The JSON of a pack whose client has these lamps.
Json pack_with(const Json& lamps, const Json& contains) {
  return {{"extensions",
           {{"LIGHTWELL_lamps", {{"lamps", lamps}}},
            {"LIGHTWELL_light_grids", {{"grids", Json::array({{{"contains", contains}}})}}}}}};
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
  const Json panel = {{"kind", "rectangle"}, {"center", {3.6, 3, 0.4}}, {"node", 4}};
  const Json point = {{"kind", "point"}, {"center", {1, 1, 1}}, {"node", 7}};
  const Json other = {{"kind", "point"}, {"node", 9}};
  const auto contained = [&](const Json& lamps, const Json& contains) {
    return contained_luminaires(pack_with(lamps, contains), *world);
  };
  EXPECT_EQ(contained(Json::array({panel}), {"indirect", "lamps"}), luminaires({1, 1, 0, 1, 0}));
  EXPECT_EQ(contained(Json::array({panel, point}), {"indirect", "environment"}), luminaires({0, 1, 0, 1, 1}));
  // Two lamps at one place are two luminaires; one of another node is none of these.
  EXPECT_EQ(contained(Json::array({panel, panel}), Json::array({"indirect"})), luminaires({1, 1, 0, 0, 0}));
  EXPECT_EQ(contained(Json::array({other}), Json::array({"indirect"})), luminaires({1, 1, 1, 1, 0}));
}

TEST(ContainedLuminaires, SurviveAnyJson) {
  const Scene scene = scene_of_lamps();
  const auto world = world_of(scene);
  for (const Json& nonsense : {Json(), Json("x"), Json(3), Json{{"kind", 5}, {"center", "here"}, {"node", -2}},
                               Json{{"kind", "sphere"}, {"center", {Json(), "a"}}, {"node", 4}}})
    EXPECT_FALSE(contained_luminaires(pack_with(Json::array({nonsense}), nonsense), *world).contains(4));
}

}  // namespace
}  // namespace lightwell
