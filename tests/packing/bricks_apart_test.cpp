// SPDX-License-Identifier: Apache-2.0
//
// Packs of light grids so large that their bricks have streams of their own.
#include <gtest/gtest.h>

#include "lightwell/packing/unpack.h"
#include "lightwell/packing/verify.h"
#include "lightwell/transport/fetch.h"
#include "tests/light/brick_fields.h"
#include "tests/packing/sample_scenes.h"

namespace lightwell {
namespace {

/// Of 20,000 nodes.
LightGrid large_grid(const Box3f& bounds) {
  GridShape shape = GridShape::over(bounds, 9);
  shape.nodes = Vec3i::filled(9);
  BrickTree tree(shape.cells());
  for (int i = 0; i < 64; i++) tree.add({.level = 1, .at = {{i % 4, i / 4 % 4, i / 16}}});
  for (int i = 0; i < 256; i++) tree.add({.level = 2, .at = {{i % 8, i / 8 % 8, i / 64}}});
  const Vec3f size = shape.hi() - shape.lo;
  return grid_of_field(shape, tree, [&](const Vec3f& p) {
    const Vec3f share = (p - shape.lo) / size;
    return std::pair(uniform_light(Vec3f::filled(1) + share * share), true);
  });
}

struct ApartPack {
  Packed packed;
  LightGrid grid;

  ApartPack() {
    Report report;
    packed.scene = scene_from_document(sheet_document(50), "sheet", report).value();
    grid = large_grid({{{-1, -1, -1}}, {{2, 2, 2}}});
    PackLight light;
    light.grids = {{.grid = &grid}, {.grid = &grid, .priority = 1}};
    Progress progress;
    packed.file = make_pack(packed.scene, light, {}, progress, report, packed.statistics).value();
  }
};

TEST(BricksApart, ArePackedAndVerified) {
  const ApartPack apart;
  const OpenedPack pack = open(apart.packed.file);
  const Verification verified = verify_pack(pack);
  ASSERT_TRUE(verified.errors.empty()) << verified.errors.front();
  ASSERT_EQ(pack.grids().size(), 2u);
  uint64_t bytes = 0;
  for (const GridDescription& grid : pack.grids()) {
    ASSERT_GE(grid.bricks.size(), 2u);
    bytes += pack.reader().directory().streams[grid.stream].length;
    for (const BricksDescription& bricks : grid.bricks)
      bytes += pack.reader().directory().streams[bricks.stream].length;
  }
  EXPECT_EQ(apart.packed.statistics.light_bytes, bytes);
}

TEST(BricksApart, AreHeldToWhatTheJsonSays) {
  const ApartPack apart;
  const OpenedPack sound = open(apart.packed.file);
  const std::vector<PackStream> streams = streams_of(sound.reader());
  const auto refused = [&](const auto& change) {
    Json json = sound.json();
    change(json["extensions"][grids_extension]["grids"][0]["bricks"]);
    const std::vector<uint8_t> file = rewrite(sound, json, streams);
    const auto opened = try_open(file);
    return !opened || !verify_pack(*opened).errors.empty();
  };
  EXPECT_FALSE(refused([](Json&) {}));
  EXPECT_TRUE(refused([](Json& bricks) { bricks.erase(0); }));
  EXPECT_TRUE(refused([](Json& bricks) { bricks[0]["min"][1] = -7; }));
  EXPECT_TRUE(refused([](Json& bricks) { bricks[0]["stream"] = bricks[1]["stream"]; }));
  EXPECT_TRUE(refused([](Json& bricks) { bricks[0]["stream"] = 0; }));
  EXPECT_TRUE(refused([](Json& bricks) { bricks = 5; }));
}

TEST(BricksApart, AreUnpackedWholeAndInPart) {
  const ApartPack apart;
  const OpenedPack pack = open(apart.packed.file);
  const LightGrid whole = unpack_light(pack.reader(), 1, {}).value();
  ASSERT_EQ(whole.bricks.size(), apart.grid.bricks.size());
  const LightGrid half = unpack_light(pack.reader(), 1, {.share = 0.5f}).value();
  EXPECT_GT(half.bricks.size(), whole.bricks.size() / 4);
  EXPECT_LT(half.bricks.size(), whole.bricks.size());
  Random random(1, 0);
  const Vec3f size = whole.shape.hi() - whole.shape.lo;
  for (int i = 0; i < 200; i++) {
    const Vec3f share = random_colour(random), normal = random_direction(random);
    const Vec3f expected = apart.grid.irradiance(whole.shape.lo + size * share, normal);
    for (const LightGrid* grid : {&whole, &half})
      for (int c = 0; c < 3; c++)
        EXPECT_NEAR(grid->irradiance(whole.shape.lo + size * share, normal)[c], expected[c], 0.02f * expected[c])
            << "steps of 1/32 of an octave, and between the known";
  }
}

// A client that gives bricks of the first regions no weight ends in the same light as one that reads stream by stream.
TEST(BricksApart, AreStreamedByWeight) {
  const ApartPack apart;
  const OpenedPack pack = open(apart.packed.file);
  Client client{ClientOptions{}};
  const auto line = memory_transport(apart.packed.file);
  LightUpdate last;
  std::vector<uint8_t> atlas;
  uint32_t updates = 0;
  const auto outcome = fetch(client, *line, [&](const Update& update) {
    if (std::holds_alternative<OpeningUpdate>(update)) client.set_weight(pack.grids()[0].bricks[0].stream, 0);
    const auto* light = std::get_if<LightUpdate>(&update);
    if (light == nullptr || light->asset != pack.grids()[1].stream) return;
    updates++;
    last = *light;
    atlas.assign(light->atlas.begin(), light->atlas.end());
  });
  ASSERT_TRUE(outcome);
  EXPECT_GT(updates, 1u);
  const ClientProgress progress = client.progress();
  EXPECT_EQ(progress.nodes, progress.nodes_total);
  EXPECT_EQ(progress.light_bytes, progress.light_bytes_total);
  EXPECT_EQ(progress.light_bytes_total, apart.packed.statistics.light_bytes);

  AssetContext context{.bin = pack.bin()};
  std::vector<std::unique_ptr<AssetDecoder>> decoders;
  const Directory& directory = pack.reader().directory();
  for (uint32_t stream = 0; stream < directory.streams.size(); stream++) {
    decoders.push_back(open_asset(directory, stream, context).value());
    for (uint32_t block = 0; block < directory.streams[stream].blocks; block++)
      ASSERT_TRUE(decoders.back()->append(pack.reader().block(stream, block).value()));
  }
  AssetDecoder& grid = *decoders[pack.grids()[1].stream];
  ASSERT_TRUE(grid.settle());
  const LightUpdate direct = std::get<LightUpdate>(grid.take(1).value());
  EXPECT_TRUE(std::ranges::equal(direct.atlas, atlas));
  EXPECT_EQ(direct.nodes, last.nodes);
}

}  // namespace
}  // namespace lightwell
