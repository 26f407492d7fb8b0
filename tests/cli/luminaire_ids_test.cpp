// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <set>

#include "lightwell/bake/contained.h"
#include "lightwell/bake/lamps.h"
#include "lightwell/packing/opened_pack.h"
#include "lightwell/packing/pack_scene.h"
#include "lightwell/packing/unpack.h"
#include "lightwell/scene/import_gltf.h"
#include "lightwell/scene/scene_builder.h"
#include "tests/trace/scenes.h"

namespace lightwell {
namespace {

LightGrid dark_grid() {
  LightGrid grid;
  grid.moments.resize(8);
  grid.valid.assign(8, 1);
  return grid;
}

OpenedPack pack_of(const Scene& scene, const std::vector<ClientLamp>& lamps) {
  const LightGrid grid = dark_grid();
  PackLight light;
  light.grids = {{&grid}};
  light.lamps = lamps;
  Progress silent;
  Report report;
  PackStatistics statistics;
  auto file = make_pack(scene, light, {}, silent, report, statistics);
  LW_ASSERT(file.has_value());
  auto shared = std::make_shared<std::vector<uint8_t>>(std::move(*file));
  auto reader = PackReader::open(
      [shared](uint64_t first, uint64_t length) -> Result<std::vector<uint8_t>> {
        return std::vector<uint8_t>(shared->begin() + static_cast<ptrdiff_t>(first),
                                    shared->begin() + static_cast<ptrdiff_t>(first + length));
      },
      shared->size());
  LW_ASSERT(reader.has_value());
  auto pack = OpenedPack::open(std::move(*reader));
  LW_ASSERT(pack.has_value());
  return std::move(*pack);
}

/// How many of the lamps that a pack names are luminaires of its own scene at a level.
size_t found_at(const OpenedPack& pack, float share) {
  Report report;
  auto document = unpack_document(pack, {.share = share}, report);
  LW_ASSERT(document.has_value());
  auto scene = scene_from_document(std::move(*document), "", report);
  LW_ASSERT(scene.has_value());
  const auto world = world_of(*scene);
  std::set<LuminaireId> named;
  for (const ClientLamp& lamp : pack.lamps()) named.insert(lamp.luminaire);
  EXPECT_EQ(named.size(), pack.lamps().size());
  size_t found = 0;
  for (const Luminaire& luminaire : world->lights().luminaires()) found += named.contains(luminaire.id);
  return found;
}

// Twelve spheres of one mesh, so many triangles that they are streamed, each a luminaire, and a panel that is not:
// whatever level the mesh is at, the pack's names say which is which.
TEST(LuminaireIds, OfAPackNameTheSamePiecesAtEveryLevel) {
  Mesh spheres;
  for (int i = 0; i < 12; i++) {
    Mesh one = turned(sphere(0.3f, 4));
    for (Vec3f& p : one.positions) p += Vec3f{{static_cast<float>(i % 4), static_cast<float>(i / 4), 1}};
    append(spheres, one);
  }
  SceneBuilder builder;
  const int wall = builder.material({.name = "wall", .color = Vec3f::filled(0.5f)});
  const int lamp = builder.material({.name = "lamp", .emission = Vec3f::filled(3)});
  const Mesh walls = room({{-2, -2, -2}}, {{6, 6, 6}});
  const Mesh panel = quad({{0, 5.5f, 0}}, {{2, 0, 0}}, {{0, 0, 1}});
  builder.object("room", {{walls, wall}, {spheres, lamp}});
  builder.object("panel", {{panel, lamp}});
  Report report;
  auto scene = scene_from_document(builder.release(), "spheres", report);
  ASSERT_TRUE(scene);
  const auto world = world_of(*scene);
  const LampPlan plan = plan_lamps(*world);
  ASSERT_EQ(plan.client.size(), 13u);
  const OpenedPack pack = pack_of(*scene, plan.client);
  for (const float level : {1.0f, 0.5f, 0.2f, 0.05f, 0.0f}) EXPECT_EQ(found_at(pack, level), 13u) << level;
}

// The pack of every room: the lamps that it names are there when it is opened again, at its final level.
TEST(LuminaireIds, OfRealRoomsAreFoundAgain) {
  for (const std::string room : {"many-lights", "living-room", "cornell-box-bevy"}) {
    const std::string path = LIGHTWELL_SHARED "/data/rooms/" + room + ".glb";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "left out: " << path << " is not here";
    Report report;
    auto scene = load_scene(path, {}, report);
    ASSERT_TRUE(scene) << room;
    const auto world = world_of(*scene);
    const LampPlan plan = plan_lamps(*world);
    ASSERT_FALSE(plan.client.empty()) << room;
    const OpenedPack pack = pack_of(*scene, plan.client);
    for (const float level : {1.0f, 0.1f, 0.0f})
      EXPECT_EQ(found_at(pack, level), plan.client.size()) << room << " " << level;
  }
}

}  // namespace
}  // namespace lightwell
