// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/opened_pack.h"

#include <gtest/gtest.h>

#include "tests/packing/sample_scenes.h"

namespace lightwell {
namespace {

TEST(OpenedPack, HoldsWhatTheExtensionsSay) {
  ClientLamp lamp;
  lamp.name = "ceiling";
  Document document = sheet_document(50);
  add_noise(document, 64);
  const Packed packed = pack(std::move(document), {lamp});
  const OpenedPack opened = open(packed.file);
  EXPECT_EQ(opened.identity().id, to_text(opened.reader().directory().id));
  EXPECT_EQ(opened.identity().exposure, 1.5f);
  ASSERT_EQ(opened.grids().size(), 1u);
  EXPECT_EQ(opened.grids()[0].shape.lo, some_light(packed.scene.bounds()).shape.lo);
  ASSERT_EQ(opened.lamps().size(), 1u);
  EXPECT_EQ(opened.lamps()[0].name, "ceiling");
  ASSERT_EQ(opened.primitives().size(), 1u);
  EXPECT_EQ(opened.primitives()[0].faces, packed.scene.primitives[0].mesh.faces.size());
  ASSERT_EQ(opened.textures().size(), 1u);
  EXPECT_EQ(opened.textures()[0].width, 64u);
}

// What it gave stays good when it moves on.
TEST(OpenedPack, CanBeMoved) {
  const Packed packed = pack(sheet_document(50));
  OpenedPack opened = open(packed.file);
  const uint8_t* bin = opened.bin().data();
  const OpenedPack moved = std::move(opened);
  EXPECT_EQ(moved.bin().data(), bin);
  EXPECT_EQ(moved.primitives().size(), 1u);
}

TEST(OpenedPack, RefusesStreamsThatThereAreNot) {
  const Packed packed = pack(sheet_document(50));
  const OpenedPack sound = open(packed.file);
  for (const uint32_t stream : {1u, 99u}) {  // a mesh, and none
    Json json = sound.json();
    json["extensions"]["LIGHTWELL_light_grids"]["grids"][0]["stream"] = stream;
    const std::vector<uint8_t> file = rewrite(sound, json, streams_of(sound.reader()));
    const auto opened = try_open(file);
    ASSERT_FALSE(opened);
    EXPECT_EQ(opened.error().message(),
              "LIGHTWELL_light_grids: stream " + std::to_string(stream) + " is no light stream");
  }
}

// Whoever exports or renders a stranger's pack must not read files of his own into it.
TEST(OpenedPack, RefusesOtherFiles) {
  const Packed packed = pack(sheet_document(50));
  const OpenedPack sound = open(packed.file);
  Json json = sound.json();
  json["images"].push_back({{"uri", "CMakeLists.txt"}});
  const std::vector<uint8_t> file = rewrite(sound, json, streams_of(sound.reader()));
  EXPECT_FALSE(try_open(file));
}

}  // namespace
}  // namespace lightwell
