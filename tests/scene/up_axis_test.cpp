// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/up_axis.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lightwell/scene/builtin.h"
#include "lightwell/scene/import_gltf.h"
#include "lightwell/scene/scene_builder.h"

namespace lightwell {
namespace {

Scene scene_of(Document document) {
  Report report;
  return scene_from_document(std::move(document), "test", report).value();
}

/// The same scene turned from y up to z up.
Scene turned(Document document) {
  Json root = {{"matrix", {1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1}},
               {"children", std::move(document.json["scenes"][0]["nodes"])}};
  document.json["nodes"].push_back(std::move(root));
  document.json["scenes"][0]["nodes"] = {document.json["nodes"].size() - 1};
  return scene_of(std::move(document));
}

void add_quad(Mesh& mesh, const Vec3f& corner, const Vec3f& u, const Vec3f& v) {
  const auto first = static_cast<uint32_t>(mesh.positions.size());
  for (const Vec3f& p : {corner, corner + u, corner + u + v, corner + v}) mesh.positions.push_back(p);
  mesh.faces.push_back({first, first + 1, first + 2});
  mesh.faces.push_back({first, first + 2, first + 3});
}

/// A flat of 8 x 6 m with walls of 2.5 m and no ceiling, y up, and with a lamp over it that shines down.
Document flat(bool walls, bool lamp) {
  SceneBuilder builder;
  Mesh rooms, panel;
  add_quad(rooms, {}, {{0, 0, 6}}, {{8, 0, 0}});
  if (walls) {
    add_quad(rooms, {}, {{8, 0, 0}}, {{0, 2.5f, 0}});
    add_quad(rooms, {{4, 0, 0}}, {{0, 0, 6}}, {{0, 2.5f, 0}});
    add_quad(rooms, {{0, 0, 6}}, {{8, 0, 0}}, {{0, 2.5f, 0}});
  }
  add_quad(panel, {{3, 2.4f, 3}}, {{1, 0, 0}}, {{0, 0, 1}});
  const int wall = builder.material(Lambertian{.name = "wall"});
  const int light = builder.material(Lambertian{.name = "lamp", .emission = Vec3f::filled(lamp ? 10.0f : 0.0f)});
  builder.object("flat", {{rooms, wall}, {panel, light}});
  return builder.release();
}

/// Hills of 2 km, y up.
Document hills() {
  constexpr int side = 20;
  Mesh mesh;
  for (int i = 0; i < side; i++)
    for (int k = 0; k < side; k++)
      add_quad(mesh, {{100.0f * float(i), 50 * std::sin(float(i)), 100.0f * float(k)}}, {{0, 20, 100}}, {{100, 10, 0}});
  SceneBuilder builder;
  builder.object("hills", {{mesh, builder.material(Lambertian{})}});
  return builder.release();
}

TEST(UpAxis, IsToldByWallsLampsAndHills) {
  for (const Document& document : {flat(true, false), flat(true, true), flat(false, true), hills()}) {
    EXPECT_FALSE(seems_z_up(scene_of(document)));
    EXPECT_TRUE(seems_z_up(turned(document)));
  }
  EXPECT_FALSE(seems_z_up(turned(flat(false, false)))) << "a plate may stand";
}

TEST(UpAxis, IsToldByCameras) {
  const Document room = find_builtin_scene("box-small")->make(1);
  ASSERT_FALSE(scene_of(room).cameras.empty());
  EXPECT_FALSE(seems_z_up(scene_of(room)));
  EXPECT_TRUE(seems_z_up(turned(room)));
}

}  // namespace
}  // namespace lightwell
