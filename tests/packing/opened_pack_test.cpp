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

// Adding to a document's members moves them: every texture of a streamed image says so, however many there are.
TEST(OpenedPack, NamesAStreamInAllTexturesOfAnImage) {
  Document document = sheet_document();
  add_noise(document, 64);
  for (int i = 1; i < 8; i++) document.json["textures"].push_back({{"source", 0}});
  const Packed packed = pack(std::move(document));
  EXPECT_EQ(open(packed.file).textures().size(), 8u);
}

// A lamp whose surface is smaller than a step of the lattice has none in the pack, and names no vertex of another.
TEST(OpenedPack, ALampTooSmallForTheLatticeNamesNoSurface) {
  Mesh mesh = painted_sheet(50);
  const auto first = static_cast<uint32_t>(mesh.positions.size());
  for (const Vec3f& p :
       {Vec3f{{0.505f, 0.505f, 0.5f}}, Vec3f{{0.505001f, 0.505f, 0.5f}}, Vec3f{{0.505f, 0.505001f, 0.5f}}}) {
    mesh.positions.push_back(p);
    mesh.texcoords[0].push_back({});
    mesh.colors.push_back(Vec4f::filled(1));
    mesh.normals.push_back({{0, 0, 1}});
  }
  mesh.faces.push_back({first, first + 1, first + 2});
  Document document = sheet_document(1);
  const Json primitive = DocumentBuilder(document).primitive(mesh);
  document.json["meshes"][0]["primitives"][0]["attributes"] = primitive["attributes"];
  document.json["meshes"][0]["primitives"][0]["indices"] = primitive["indices"];
  ClientLamp lamp;
  lamp.kind = ClientLamp::Kind::rectangle;
  lamp.luminaire = {.kind = LuminaireId::Kind::surface, .node = 0, .primitive = 0, .vertex = first};
  const Packed packed = pack(std::move(document), {lamp});
  const OpenedPack opened = open(packed.file);
  const uint32_t vertices = opened.primitives().at(0).vertices;
  const LuminaireId& id = opened.lamps().at(0).luminaire;
  if (id.primitive >= 0)
    EXPECT_LT(id.vertex, vertices);
  else
    EXPECT_EQ(id.node, -1);
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
