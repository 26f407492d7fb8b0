// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/pack_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "lightwell/bake/unpack.h"
#include "lightwell/bake/verify.h"
#include "lightwell/base/random.h"
#include "lightwell/mesh/quantize.h"
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
};

Packed pack(Document document) {
  Packed packed;
  Report report;
  packed.scene = scene_from_document(std::move(document), "test", report).value();
  const LightGrid grid = some_light(packed.scene.bounds());
  PackLight light;
  light.grid = &grid;
  light.exposure = 1.5f;
  Progress progress;
  auto file = make_pack(packed.scene, light, {}, progress, report, packed.statistics);
  EXPECT_TRUE(file) << file.error().message();
  if (file) packed.file = std::move(*file);
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

using Corner = std::array<int, 8>;  // of a face: position, normal and texcoord codes

std::vector<std::array<Corner, 3>> faces_of(const QuantizedMesh& mesh) {
  std::vector<std::array<Corner, 3>> faces;
  for (const Face& face : mesh.faces) {
    std::array<Corner, 3> corners{};
    for (size_t c = 0; c < 3; c++) {
      const uint32_t v = face[c];
      corners[c] = {mesh.positions[v][0], mesh.positions[v][1], mesh.positions[v][2]};
      if (!mesh.normals.empty())
        std::tie(corners[c][3], corners[c][4]) = std::pair<int, int>(mesh.normals[v].u, mesh.normals[v].v);
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
  light.grid = &grid;
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
