// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/pack_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <tuple>

#include "lightwell/mesh/quantize.h"
#include "lightwell/packing/opening_budget.h"
#include "lightwell/packing/unpack.h"
#include "lightwell/packing/verify.h"
#include "lightwell/scene/builtin.h"
#include "lightwell/texture/mip.h"
#include "tests/packing/sample_scenes.h"
#include "tests/texture/webp_files.h"

namespace lightwell {
namespace {

Document room() { return find_builtin_scene("box-small")->make(1); }

double mean_of(const Image& image) {
  return std::accumulate(image.pixels.begin(), image.pixels.end(), 0.0) / static_cast<double>(image.pixels.size());
}

using Corner = std::array<int, 13>;  // of a face: position, normal, texcoord and colour codes

std::vector<std::array<Corner, 3>> faces_of(const QuantizedMesh& mesh) {
  std::vector<std::array<Corner, 3>> faces;
  for (const Face& face : mesh.faces) {
    std::array<Corner, 3> corners{};
    for (size_t c = 0; c < 3; c++) {
      const uint32_t v = face[c];
      corners[c] = {mesh.positions[v][0], mesh.positions[v][1], mesh.positions[v][2]};
      if (!mesh.normals.empty())
        std::tie(corners[c][3], corners[c][4]) = std::pair<int, int>(mesh.normals[v].u, mesh.normals[v].v);
      for (size_t set = 0; set < 2; set++)
        for (size_t axis = 0; axis < 2 && !mesh.texcoords[set].empty(); axis++)
          corners[c][5 + 2 * set + axis] = mesh.texcoords[set][v].e[axis];
      for (size_t channel = 0; channel < 4 && !mesh.colors.empty(); channel++)
        corners[c][9 + channel] = mesh.colors[v][channel];
    }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    faces.push_back(corners);
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

TEST(MakePack, IsVerifiedAndOpensAsGltf) {
  const Packed packed = pack(room());
  const OpenedPack opened = open(packed.file);
  const Verification verification = verify_pack(opened);
  EXPECT_TRUE(verification.errors.empty()) << testing::PrintToString(verification.errors);
  EXPECT_GT(verification.blocks, 10u);
  EXPECT_LT(packed.statistics.opening_bytes, 65536u);
  size_t triangles = 0;
  for (const Primitive& primitive : packed.scene.primitives) triangles += primitive.mesh.faces.size();
  EXPECT_EQ(packed.statistics.triangles, triangles);

  Report report;
  auto coarse = read_document(packed.file, {}, report);
  ASSERT_TRUE(coarse) << coarse.error().message();
}

TEST(MakePack, EndsInTheQuantisedInputFaceForFace) {
  const Packed packed = pack(room());
  const OpenedPack opened = open(packed.file);
  Report report;
  auto scene = scene_from_document(unpack_document(opened, {}, report).value(), "again", report).value();
  ASSERT_EQ(scene.primitives.size(), packed.scene.primitives.size());
  for (size_t i = 0; i < scene.primitives.size(); i++) {
    const auto wanted = quantize(packed.scene.primitives[i].mesh, {}), found = quantize(scene.primitives[i].mesh, {});
    EXPECT_EQ(faces_of(*found), faces_of(*wanted));
  }
  EXPECT_EQ(scene.document.json.dump().find("LIGHTWELL"), std::string::npos);
}

TEST(MakePack, KeepsTextureCoordinatesAndColours) {
  const Packed packed = pack(sheet_document());
  Report report;
  const OpenedPack opened = open(packed.file);
  const auto scene = scene_from_document(unpack_document(opened, {}, report).value(), "again", report).value();
  EXPECT_EQ(faces_of(*quantize(scene.primitives[0].mesh, {})),
            faces_of(*quantize(packed.scene.primitives[0].mesh, {})));
  EXPECT_EQ(opened.json()["scenes"][0]["name"], "test");
}

// Attributes that meshes here do not have are named; a material that reads one of them reads the first instead, as the
// bake did, so that the pack stays valid.
TEST(MakePack, NamesTheAttributesItLeavesOut) {
  Document document = sheet_document();
  Json& attributes = document.json["meshes"][0]["primitives"][0]["attributes"];
  attributes["TEXCOORD_2"] = attributes["TEXCOORD_0"];
  attributes["_TEMPERATURE"] = attributes["TEXCOORD_0"];
  const int view = DocumentBuilder(document).buffer_view(write_png(Image{1, 1, 3, {1, 2, 3}}));
  document.json["images"] = {{{"bufferView", view}, {"mimeType", "image/png"}}};
  document.json["textures"] = {{{"source", 0}}};
  document.json["materials"][0]["normalTexture"] = {{"index", 0}, {"texCoord", 2}};
  const Packed packed = pack(std::move(document));
  EXPECT_NE(std::find(packed.warnings.begin(), packed.warnings.end(),
                      "vertex attributes left out, not supported: TEXCOORD_2, _TEMPERATURE"),
            packed.warnings.end())
      << testing::PrintToString(packed.warnings);
  const OpenedPack opened = open(packed.file);
  EXPECT_EQ(opened.json()["materials"][0]["normalTexture"], Json({{"index", 0}}));
}

// What a viewer needs to show a material as the file has it, also where the light does not know it.
TEST(MakePack, KeepsTheExtensionsOfMaterials) {
  Document document = sheet_document();
  const Json extensions = {{"KHR_materials_specular", {{"specularFactor", 0.25}, {"specularColorFactor", {1, 0.5, 0}}}},
                           {"KHR_materials_ior", {{"ior", 1.8}}},
                           {"KHR_materials_transmission", {{"transmissionFactor", 0.5}}},
                           {"KHR_materials_clearcoat", {{"clearcoatFactor", 1}}}};
  document.json["materials"][0]["extensions"] = extensions;
  for (const auto& extension : extensions.items()) document.json["extensionsUsed"].push_back(extension.key());
  const OpenedPack opened = open(pack(std::move(document)).file);
  EXPECT_EQ(opened.json()["materials"][0]["extensions"], extensions);
}

// A texture whose extension names an image that nobody here decodes keeps glTF's own.
TEST(MakePack, KeepsTheImageThatCanBeRead) {
  Document document = sheet_document();
  const int red = DocumentBuilder(document).buffer_view(write_png(Image{1, 1, 3, {255, 0, 0}}));
  const int unknown = DocumentBuilder(document).buffer_view(as_bytes("\xabKTX 20 and so on"));
  document.json["images"] = {{{"bufferView", red}, {"mimeType", "image/png"}},
                             {{"bufferView", unknown}, {"mimeType", "image/ktx2"}}};
  document.json["textures"] = {{{"source", 0}, {"extensions", {{"KHR_texture_basisu", {{"source", 1}}}}}}};
  document.json["extensionsUsed"] = {"KHR_texture_basisu"};
  document.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  const Packed packed = pack(std::move(document));
  const OpenedPack opened = open(packed.file);
  const Json json = opened.json();
  EXPECT_FALSE(json["textures"][0].contains("extensions"));
  Report report;
  const auto scene = scene_from_document(unpack_document(opened, {}, report).value(), "", report).value();
  const int image = scene.materials[0].base_color_texture.image;
  EXPECT_EQ(scene.images.at(static_cast<size_t>(image)).pixels, (std::vector<uint8_t>{255, 0, 0}));
}

TEST(MakePack, GivesCoarserLevelsOnDemand) {
  const Packed packed = pack(room());
  const OpenedPack opened = open(packed.file);
  Report report;
  size_t before = 0;
  for (float share : {0.0f, 0.1f, 0.5f, 1.0f}) {
    auto scene = scene_from_document(unpack_document(opened, {share, -1}, report).value(), "", report).value();
    size_t faces = 0;
    for (const Primitive& primitive : scene.primitives) faces += primitive.mesh.faces.size();
    EXPECT_GE(faces, before);
    EXPECT_GE(static_cast<float>(faces), share * 20012);
    before = faces;
  }
}

TEST(MakePack, KeepsTheLight) {
  const Packed packed = pack(room());
  const OpenedPack opened = open(packed.file);
  auto grid = unpack_light(opened.reader(), opened.grids().at(0).stream, {});
  ASSERT_TRUE(grid);
  const LightGrid wanted = some_light(packed.scene.bounds());
  const Vec3f center = packed.scene.bounds().center(), up{{0, 1, 0}};
  // Half a step of the logarithm, a 32nd of an octave, is 1.1 %.
  EXPECT_NEAR(grid->irradiance(center, up)[2] / wanted.irradiance(center, up)[2], 1, 0.011f);
}

// Two grids: the first streams, in the order given, each with what it holds.
TEST(MakePack, HoldsAListOfGrids) {
  Report report;
  const Scene scene = scene_from_document(sheet_document(), "test", report).value();
  const LightGrid coarse = some_light(scene.bounds());
  LightGrid fine = coarse;
  fine.shape.lo = fine.shape.lo + fine.shape.cell;
  PackLight light;
  light.grids = {{.grid = &coarse}, {.grid = &fine, .priority = 3}};
  light.grids[0].contains = {.indirect = true, .environment = true};
  Progress progress;
  PackStatistics statistics;
  const std::vector<uint8_t> file = make_pack(scene, light, {}, progress, report, statistics).value();
  const OpenedPack opened = open(file);
  EXPECT_TRUE(verify_pack(opened).errors.empty()) << testing::PrintToString(verify_pack(opened).errors);
  ASSERT_EQ(opened.grids().size(), 2u);
  EXPECT_EQ(opened.grids()[0].contains, light.grids[0].contains);
  EXPECT_EQ(opened.grids()[1].contains, GridContents{});
  EXPECT_EQ(opened.grids()[1].priority, 3);
  for (size_t i = 0; i < 2; i++) {
    const LightGrid grid = unpack_light(opened.reader(), opened.grids()[i].stream, {}).value();
    EXPECT_EQ(grid.shape.lo, light.grids[i].grid->shape.lo);
  }
}

// Clients add the grids of groups up, so that all have the same cells.
TEST(MakePack, GridsOfGroupsHaveTheSameCells) {
  Report report;
  const Scene scene = scene_from_document(sheet_document(), "test", report).value();
  const LightGrid red = some_light(scene.bounds());
  for (const bool alike : {true, false}) {
    LightGrid blue = red;
    if (!alike) blue.normal_offset /= 2;
    PackLight light;
    light.grids = {{.grid = &red, .contains = {.group = "red"}}, {.grid = &blue, .contains = {.group = "blue"}}};
    Progress progress;
    PackStatistics statistics;
    const std::vector<uint8_t> file = make_pack(scene, light, {}, progress, report, statistics).value();
    const OpenedPack opened = open(file);
    EXPECT_EQ(opened.grids()[1].contains.group, "blue");
    EXPECT_EQ(verify_pack(opened).errors.empty(), alike);
  }
}

TEST(MakePack, KeepsNamesExtrasAndCameras) {
  Document document = room();
  document.json["extras"] = {{"museum", "of things"}};
  document.json["nodes"][0]["name"] = "the first";
  const Packed packed = pack(std::move(document));
  const OpenedPack opened = open(packed.file);
  const Json json = opened.json();
  EXPECT_EQ(json["extras"]["museum"], "of things");
  EXPECT_EQ(json["nodes"][0]["name"], "the first");
  EXPECT_EQ(json["cameras"].size(), 1u);
  EXPECT_EQ(json["extensions"]["LIGHTWELL_streams"]["exposure"], 1.5);
  EXPECT_FALSE(json.contains("extensionsRequired") &&
               json["extensionsRequired"].dump().find("LIGHTWELL") != std::string::npos);
}

// A page of a museum in `extras` is no file that anybody fetches.
TEST(MakePack, TakesWhatAClientTakes) {
  Document document = room();
  document.json["asset"]["extras"]["uri"] = "https://museum.example/1";
  const Packed packed = pack(std::move(document));
  EXPECT_TRUE(verify_pack(open(packed.file)).errors.empty());
}

// A row of sheets, each with 12 KB of arrays and more.
Document row_of_sheets(int sheets) {
  Document document;
  DocumentBuilder builder(document);
  Mesh sheet = painted_sheet(20);
  for (int i = 0; i < sheets; i++) {
    for (Vec3f& p : sheet.positions) p[0] += 1;
    builder.add("meshes", {{"primitives", Json::array({builder.primitive(sheet)})}});
    document.json["nodes"].push_back({{"mesh", i}});
  }
  std::vector<int> nodes(static_cast<size_t>(sheets));
  std::iota(nodes.begin(), nodes.end(), 0);
  builder.add("scenes", {{"nodes", nodes}});
  return document;
}

// What the budget takes a primitive and a stream to cost in JSON and directory holds in a real pack. The grid, the
// scene and the accessors' longer numbers are not counted: a tenth and 4 KB.
TEST(MakePack, KeepsOpeningsToTheirBudget) {
  for (const int sheets : {1, 20, 100}) {
    SCOPED_TRACE(sheets);
    const OpeningBudget budget = OpeningBudget::of(static_cast<size_t>(sheets), 0, 1);
    EXPECT_LT(pack(row_of_sheets(sheets)).statistics.opening_bytes, budget.bytes_for_likeness * 11 / 10 + 4096);
  }
}

// One for positions and normals, one for indices: a view says as much in JSON as an array.
TEST(MakePack, HoldsItsArraysInFewBufferViews) {
  const Packed packed = pack(room());
  const Json json = open(packed.file).json();
  EXPECT_GT(json["accessors"].size(), 6u);
  EXPECT_LE(json["bufferViews"].size(), 4u);
}

TEST(MakePack, StreamsImages) {
  Document document = room();
  const std::vector<uint8_t> file = add_noise(document, 128);
  const Packed packed = pack(std::move(document));
  EXPECT_GT(packed.statistics.texture_bytes, file.size());
  const OpenedPack opened = open(packed.file);
  EXPECT_TRUE(verify_pack(opened).errors.empty());
  Report report;
  const Document again = unpack_document(opened, {}, report).value();
  EXPECT_EQ(read_image(again, 0).value(), file);
}

// The level is the mean in linear light: of noise in bytes of sRGB 147, with what is left of the noise of 16 pixels.
// WebP keeps its mean to one step, and takes far less than a fourth.
TEST(MakePack, StreamsLargeImagesInLevels) {
  Document document = room();
  const std::vector<uint8_t> file = add_noise(document, 512);
  const Packed packed = pack(std::move(document));
  const OpenedPack opened = open(packed.file);
  EXPECT_TRUE(verify_pack(opened).errors.empty());
  ASSERT_EQ(opened.textures().size(), 1u);
  const RefinedTexture& refined = opened.textures()[0];
  ASSERT_EQ(refined.levels.size(), 1u);
  EXPECT_EQ(refined.levels[0].width, 128u);
  EXPECT_EQ(refined.levels[0].height, 128u);
  const std::vector<uint8_t> level = unpack_image(opened.reader(), refined.levels[0].stream).value();
  EXPECT_LT(level.size(), file.size() / 4);
  const Image mean = smallest_mip(read_png(file).value(), 128, true), read = read_image_file(level).value();
  EXPECT_EQ(read.width, 128);
  EXPECT_NEAR(mean_of(read), mean_of(mean), 1);
  EXPECT_EQ(unpack_image(opened.reader(), refined.stream).value(), file);
}

TEST(MakePack, StreamsSmallImagesAtOnce) {
  Document document = room();
  add_noise(document, 128);
  const Packed packed = pack(std::move(document));
  EXPECT_TRUE(open(packed.file).textures().at(0).levels.empty());
}

// A picture that stands in the file for viewers without an extension is not sent: the page shows the other one.
TEST(MakePack, HoldsTheImagesThatAreShown) {
  Document document = room();
  const std::vector<uint8_t> shown = lossless_webp(read_png(add_noise(document, 64)).value());
  const std::vector<uint8_t> fallback = write_png(Image{1, 1, 3, {1, 2, 3}});
  DocumentBuilder builder(document);
  document.json["images"] = {{{"bufferView", builder.buffer_view(fallback)}, {"mimeType", "image/png"}},
                             {{"bufferView", builder.buffer_view(shown)}, {"mimeType", "image/webp"}}};
  document.json["textures"] = Json::parse(R"([{"source": 0, "extensions": {"EXT_texture_webp": {"source": 1}}}])");
  const Packed packed = pack(std::move(document));
  const OpenedPack opened = open(packed.file);
  EXPECT_TRUE(verify_pack(opened).errors.empty());
  Report report;
  const Document again = unpack_document(opened, {}, report).value();
  EXPECT_EQ(again.json["images"].size(), 1u);
  EXPECT_EQ(read_image(again, 0).value(), shown);
}

// Variants stay with the primitives, whose materials are renumbered by nobody.
TEST(MakePack, KeepsVariants) {
  Document document = room();
  const Json variants = {{"variants", {{{"name", "oak"}}, {{"name", "steel"}}}}};
  document.json["extensionsUsed"].push_back("KHR_materials_variants");
  document.json["extensions"]["KHR_materials_variants"] = variants;
  document.json["materials"].push_back({{"name", "steel"}});
  const size_t steel = document.json["materials"].size() - 1;
  const Json mappings = {{"mappings", {{{"material", steel}, {"variants", {1}}}}}};
  document.json["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"] = mappings;
  const Packed packed = pack(std::move(document));
  const OpenedPack opened = open(packed.file);
  EXPECT_TRUE(verify_pack(opened).errors.empty());
  EXPECT_EQ(opened.json()["extensions"]["KHR_materials_variants"], variants);
  EXPECT_EQ(opened.json()["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"], mappings);
  EXPECT_EQ(opened.json()["materials"][steel]["name"], "steel");
}

TEST(MakePack, GivesTheSameBytesForAnyNumberOfThreads) {
  Report report;
  const Scene scene = scene_from_document(room(), "test", report).value();
  const LightGrid grid = some_light(scene.bounds());
  PackLight light;
  light.grids = {{.grid = &grid}};
  Progress progress;
  std::vector<std::vector<uint8_t>> files;
  for (int threads : {1, 2, 5}) {
    PackOptions options;
    options.threads = threads;
    PackStatistics statistics;
    files.push_back(make_pack(scene, light, options, progress, report, statistics).value());
  }
  EXPECT_EQ(files[0], files[1]);
  EXPECT_EQ(files[0], files[2]);
}

}  // namespace
}  // namespace lightwell
