// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/pack_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <tuple>

#include "lightwell/base/random.h"
#include "lightwell/mesh/quantize.h"
#include "lightwell/pack/opening.h"
#include "lightwell/pack/writer.h"
#include "lightwell/packing/opening_budget.h"
#include "lightwell/packing/unpack.h"
#include "lightwell/packing/verify.h"
#include "lightwell/scene/builtin.h"
#include "lightwell/scene/import_gltf.h"
#include "lightwell/texture/image_file.h"

namespace lightwell {
namespace {

// A grid whose light differs from node to node.
LightGrid some_light(const Box3f& bounds) {
  LightGrid grid;
  grid.shape = GridShape::over(bounds, 9);
  for (size_t i = 0; i < grid.shape.count(); i++) {
    Moments moments;
    for (size_t k = 0; k < 6; k++) moments.m[k] = Vec3f{{1, 2, 3}} * (1 + Random(1, i).uniform());
    grid.moments.push_back(moments);
  }
  grid.valid.assign(grid.shape.count(), 1);
  return grid;
}

struct Packed {
  Scene scene;
  std::vector<uint8_t> file;
  PackStatistics statistics;
  std::vector<std::string> warnings;
};

Packed pack(Document document) {
  Packed packed;
  Report report;
  packed.scene = scene_from_document(std::move(document), "test", report).value();
  const LightGrid grid = some_light(packed.scene.bounds());
  PackLight light;
  light.grids = {{.grid = &grid}};
  light.exposure = 1.5f;
  Progress progress;
  auto file = make_pack(packed.scene, light, {}, progress, report, packed.statistics);
  EXPECT_TRUE(file) << file.error().message();
  if (file) packed.file = std::move(*file);
  packed.warnings = report.warnings;
  return packed;
}

PackReader reader_of(const std::vector<uint8_t>& file) {
  return PackReader::open(
             [&file](uint64_t first, uint64_t length) -> Result<std::vector<uint8_t>> {
               if (first + length > file.size()) return fail("", "beyond the end");
               return std::vector<uint8_t>(file.begin() + static_cast<ptrdiff_t>(first),
                                           file.begin() + static_cast<ptrdiff_t>(first + length));
             },
             file.size())
      .value();
}

Document room() { return find_builtin_scene("box-small")->make(1); }

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
  const PackReader reader = reader_of(packed.file);
  const Verification verification = verify_pack(reader);
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
  const PackReader reader = reader_of(packed.file);
  Report report;
  auto scene = scene_from_document(unpack_document(reader, {}, report).value(), "again", report).value();
  ASSERT_EQ(scene.primitives.size(), packed.scene.primitives.size());
  for (size_t i = 0; i < scene.primitives.size(); i++) {
    const auto wanted = quantize(packed.scene.primitives[i].mesh, {}), found = quantize(scene.primitives[i].mesh, {});
    EXPECT_EQ(faces_of(*found), faces_of(*wanted));
  }
  EXPECT_EQ(scene.document.json.dump().find("LIGHTWELL"), std::string::npos);
}

// A bumpy sheet of 20 x 20 quads with texture coordinates and colours.
Mesh painted_sheet() {
  Mesh mesh;
  constexpr uint32_t n = 20;
  Random random(7, 0);
  for (uint32_t j = 0; j <= n; j++)
    for (uint32_t i = 0; i <= n; i++) {
      const float u = static_cast<float>(i) / n, v = static_cast<float>(j) / n;
      mesh.positions.push_back({{u, v, 0.1f * random.uniform()}});
      mesh.texcoords[0].push_back({{u, 1 - v}});
      mesh.colors.push_back({{u, v, random.uniform(), 1}});
    }
  for (uint32_t j = 0; j < n; j++)
    for (uint32_t i = 0; i < n; i++) {
      const uint32_t k = j * (n + 1) + i;
      mesh.faces.push_back({k, k + 1, k + n + 2});
      mesh.faces.push_back({k, k + n + 2, k + n + 1});
    }
  mesh.normals = smooth_normals(mesh);
  return mesh;
}

Document sheet_document() {
  Document document;
  DocumentBuilder builder(document);
  Json primitive = builder.primitive(painted_sheet());
  primitive["material"] = builder.add("materials", Json::object());
  builder.add("meshes", {{"primitives", Json::array({primitive})}});
  document.json["nodes"] = {{{"mesh", 0}}};
  builder.add("scenes", {{"nodes", {0}}});
  return document;
}

TEST(MakePack, KeepsTextureCoordinatesAndColours) {
  const Packed packed = pack(sheet_document());
  Report report;
  const PackReader reader = reader_of(packed.file);
  const auto scene = scene_from_document(unpack_document(reader, {}, report).value(), "again", report).value();
  EXPECT_EQ(faces_of(*quantize(scene.primitives[0].mesh, {})),
            faces_of(*quantize(packed.scene.primitives[0].mesh, {})));
  EXPECT_EQ(pack_json(reader).value()["scenes"][0]["name"], "test");
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
  const PackReader reader = reader_of(packed.file);
  EXPECT_EQ(pack_json(reader).value()["materials"][0]["normalTexture"], Json({{"index", 0}}));
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
  const PackReader reader = reader_of(packed.file);
  const Json json = pack_json(reader).value();
  EXPECT_FALSE(json["textures"][0].contains("extensions"));
  Report report;
  const auto scene = scene_from_document(unpack_document(reader, {}, report).value(), "", report).value();
  const int image = scene.materials[0].base_color_texture.image;
  EXPECT_EQ(scene.images.at(static_cast<size_t>(image)).pixels, (std::vector<uint8_t>{255, 0, 0}));
}

TEST(MakePack, GivesCoarserLevelsOnDemand) {
  const Packed packed = pack(room());
  const PackReader reader = reader_of(packed.file);
  Report report;
  size_t before = 0;
  for (float share : {0.0f, 0.1f, 0.5f, 1.0f}) {
    auto scene = scene_from_document(unpack_document(reader, {share, -1}, report).value(), "", report).value();
    size_t faces = 0;
    for (const Primitive& primitive : scene.primitives) faces += primitive.mesh.faces.size();
    EXPECT_GE(faces, before);
    EXPECT_GE(static_cast<float>(faces), share * 20012);
    before = faces;
  }
}

TEST(MakePack, KeepsTheLight) {
  const Packed packed = pack(room());
  const PackReader reader = reader_of(packed.file);
  auto grid = unpack_light(reader, find_light_stream(reader).value(), {});
  ASSERT_TRUE(grid);
  const LightGrid wanted = some_light(packed.scene.bounds());
  const Vec3f center = packed.scene.bounds().center(), up{{0, 1, 0}};
  // RGB9E5 keeps nine bits of the largest channel: half a step is 2^-9 of it, S in 1/127.
  EXPECT_NEAR(grid->irradiance(center, up)[2] / wanted.irradiance(center, up)[2], 1, 0.004f);
}

TEST(MakePack, KeepsNamesExtrasAndCameras) {
  Document document = room();
  document.json["extras"] = {{"museum", "of things"}};
  document.json["nodes"][0]["name"] = "the first";
  const Packed packed = pack(std::move(document));
  const PackReader reader = reader_of(packed.file);
  const Json json = pack_json(reader).value();
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
  EXPECT_TRUE(verify_pack(reader_of(packed.file)).errors.empty());
}

// A row of sheets, each with 12 KB of arrays and more.
Document row_of_sheets(int sheets) {
  Document document;
  DocumentBuilder builder(document);
  Mesh sheet = painted_sheet();
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
    const OpeningBudget budget = OpeningBudget::of(static_cast<size_t>(sheets), 1);
    EXPECT_LT(pack(row_of_sheets(sheets)).statistics.opening_bytes, budget.bytes_for_likeness * 11 / 10 + 4096);
  }
}

// One for positions and normals, one for indices: a view says as much in JSON as an array.
TEST(MakePack, HoldsItsArraysInFewBufferViews) {
  const Packed packed = pack(room());
  const Json json = pack_json(reader_of(packed.file)).value();
  EXPECT_GT(json["accessors"].size(), 6u);
  EXPECT_LE(json["bufferViews"].size(), 4u);
}

TEST(MakePack, StreamsImages) {
  Document document = room();
  Image noise{128, 128, 3, {}};
  Random random(5, 0);
  for (int i = 0; i < 128 * 128 * 3; i++) noise.pixels.push_back(static_cast<uint8_t>(random.below(256)));
  const std::vector<uint8_t> file = write_png(noise);
  const int view = DocumentBuilder(document).buffer_view(file);
  document.json["images"] = {{{"bufferView", view}, {"mimeType", "image/png"}}};
  document.json["textures"] = {{{"source", 0}}};
  document.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  const Packed packed = pack(std::move(document));
  EXPECT_GT(packed.statistics.texture_bytes, file.size());
  const PackReader reader = reader_of(packed.file);
  EXPECT_TRUE(verify_pack(reader).errors.empty());
  Report report;
  const Document again = unpack_document(reader, {}, report).value();
  EXPECT_EQ(read_image(again, 0).value(), file);
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

// The JSON changed in one digit, in a file whose checks are right otherwise.
TEST(VerifyPack, HoldsTheJsonAgainstTheStreams) {
  const Packed packed = pack(room());
  const PackReader reader = reader_of(packed.file);
  const auto with_json = [&](const std::string& pointer, const Json& value) {
    Json json = pack_json(reader).value();
    EXPECT_TRUE(json.contains(Json::json_pointer(pointer))) << pointer;
    json[Json::json_pointer(pointer)] = value;
    const GlbChunks chunks = glb_chunks(reader.opening());
    std::vector<PackStream> streams;
    for (size_t i = 0; i < reader.directory().streams.size(); i++) {
      const StreamEntry& entry = reader.directory().streams[i];
      streams.push_back({entry.kind, entry.codec, entry.error, entry.parameters, {}});
      for (uint32_t block = 0; block < entry.blocks; block++)
        streams[i].blocks.push_back(
            {reader.block(i, block).value(), reader.rows(i)[block].adds, reader.rows(i)[block].error});
    }
    return PackWriter::create({chunks.bin.begin(), chunks.bin.end()}, std::move(streams))->finish(json.dump()).value();
  };
  const auto errors = [&](const std::string& pointer, const Json& value) {
    const std::vector<uint8_t> file = with_json(pointer, value);
    return verify_pack(reader_of(file)).errors.size();
  };
  EXPECT_EQ(errors("/asset/version", "2.0"), 0u);
  const std::string grid = "/extensions/LIGHTWELL_light_grids/grids/0/";
  const Json json = pack_json(reader).value();
  size_t streamed = 0;
  while (!json["meshes"][streamed]["primitives"][0].contains("extensions")) streamed++;
  const std::string mesh =
      "/meshes/" + std::to_string(streamed) + "/primitives/0/extensions/LIGHTWELL_progressive_mesh/";
  EXPECT_EQ(errors(grid + "min/1", 7.5), 1u);
  EXPECT_EQ(errors(grid + "cell/0", 0.25), 1u);
  EXPECT_EQ(errors(grid + "nodes/2", 99), 1u);
  EXPECT_EQ(errors(grid + "normalOffset", 0.25), 1u);
  EXPECT_EQ(errors(mesh + "vertices", 1), 1u);
  EXPECT_EQ(errors(mesh + "error", 1000), 1u);
  EXPECT_EQ(errors(mesh + "bounds/max/0", -1000), 1u);
  EXPECT_GE(errors(grid + "stream", 1), 1u);
  EXPECT_EQ(errors("/extensions/LIGHTWELL_streams/version", 1), 1u);
  EXPECT_EQ(errors("/extensions/LIGHTWELL_streams/id", "0"), 1u);
}

TEST(VerifyPack, FindsEveryDamagedByte) {
  const Packed packed = pack(room());
  Random random(9, 0);
  for (int i = 0; i < 40; i++) {
    std::vector<uint8_t> damaged = packed.file;
    const size_t at = random.below(static_cast<uint32_t>(damaged.size()));
    damaged[at] = static_cast<uint8_t>(damaged[at] ^ 1u << random.below(8));
    auto reader = PackReader::open(
        [&](uint64_t first, uint64_t length) -> Result<std::vector<uint8_t>> {
          if (first + length > damaged.size()) return fail("", "beyond the end");
          return std::vector<uint8_t>(damaged.begin() + static_cast<ptrdiff_t>(first),
                                      damaged.begin() + static_cast<ptrdiff_t>(first + length));
        },
        damaged.size());
    const size_t padding = packed.file.size() - 3;  // up to three bytes behind the last stream mean nothing
    if (at >= padding) continue;
    EXPECT_TRUE(!reader || !verify_pack(*reader).errors.empty()) << "byte " << at;
  }
}

}  // namespace
}  // namespace lightwell
