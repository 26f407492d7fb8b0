// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/enclosed_lamps.h"

#include <gtest/gtest.h>

#include "tests/trace/scenes.h"

namespace lightwell {
namespace {

TEST(EnclosedLamps, AreNamedWithWhatHoldsThem) {
  Scene scene = scene_of(room({{-2, 0, -2}}, {{2, 3, 2}}), lambertian(0.5f));
  add(scene, block({{-1, 0.01f, -1}}, {{1, 1, 1}}), lambertian(0.5f));
  add(scene, turned(sphere(0.05f, 2)), lambertian(0.5f), Transform::translation({{0, 2, 0}}));
  scene.document.json["meshes"] = {{{"name", "room"}}, {{"name", "table"}}};
  scene.primitives[1].source_mesh = 1;
  scene.lamps = {point_lamp({{0, 2, 0}}, {{1, 1, 1}}), point_lamp({{0, 0.5f, 0}}, {{1, 1, 1}}),
                 point_lamp({{1.5f, 2, 0}}, {{1, 1, 1}}), sun_lamp({{0, -1, 0}}, 1)};
  scene.lamps[1].name = "lost";
  Report report;
  warn_of_enclosed_lamps(*world_of(scene), report);
  EXPECT_EQ(report.warnings,
            std::vector<std::string>{"lamp \"lost\" stands inside of \"table\", which lets none of its light out"});
}

}  // namespace
}  // namespace lightwell
