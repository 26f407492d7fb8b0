// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "lightwell/base/random.h"
#include "lightwell/gltf/accessor.h"
#include "lightwell/pack/opening.h"
#include "lightwell/pack/writer.h"
#include "lightwell/packing/opened_pack.h"
#include "lightwell/packing/pack_scene.h"
#include "lightwell/scene/import_gltf.h"
#include "lightwell/texture/image_file.h"
#include "tests/pack/pack_samples.h"

namespace lightwell {

/// A grid whose light differs from node to node.
inline LightGrid some_light(const Box3f& bounds) {
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

/// An uneven sky, 12 stops from its darkest to its brightest.
inline Environment some_sky(int width, int height) {
  auto map = std::make_shared<RadianceImage>(RadianceImage{width, height, {}});
  for (int i = 0; i < width * height; i++) {
    const float along = static_cast<float>(i) / static_cast<float>(width * height);
    for (const float channel : {1.0f, 0.8f, 0.5f}) map->pixels.push_back(channel * std::exp2(6 - 12 * along));
  }
  return {Vec3f::filled(1), std::move(map)};
}

/// The pack of a document under that light.
inline Packed pack(Document document, const std::vector<ClientLamp>& lamps = {}, Environment environment = {}) {
  Packed packed;
  Report report;
  packed.scene = scene_from_document(std::move(document), "test", report).value();
  packed.scene.environment = std::move(environment);
  const LightGrid grid = some_light(packed.scene.bounds());
  PackLight light;
  light.grids = {{.grid = &grid, .contains = {.environment = packed.scene.environment.map != nullptr}}};
  light.lamps = lamps;
  light.exposure = 1.5f;
  Progress progress;
  auto file = make_pack(packed.scene, light, {}, progress, report, packed.statistics);
  EXPECT_TRUE(file) << file.error().message();
  if (file) packed.file = std::move(*file);
  packed.warnings = report.warnings;
  return packed;
}

/// `file` must outlive what is opened.
inline Result<OpenedPack> try_open(const std::vector<uint8_t>& file) {
  LW_TRY(reader, PackReader::open(from_memory(file), file.size()));
  return OpenedPack::open(std::move(reader));
}

inline OpenedPack open(const std::vector<uint8_t>& file) { return try_open(file).value(); }

/// A pack of that JSON, BIN and streams with all checks right. Where the JSON names the id of `pack`, it names the new
/// one's.
inline std::vector<uint8_t> rewrite(const OpenedPack& pack, Json json, std::vector<uint8_t> bin,
                                    std::vector<PackStream> streams) {
  const PackWriter writer = PackWriter::create(std::move(bin), std::move(streams)).value();
  const Json::json_pointer id("/extensions/LIGHTWELL_streams/id");
  if (json.contains(id) && json[id] == to_text(pack.reader().directory().id)) json[id] = to_text(writer.plan().id);
  return writer.finish(json.dump()).value();
}

/// The same with the opening's BIN as it was.
inline std::vector<uint8_t> rewrite(const OpenedPack& pack, const Json& json, std::vector<PackStream> streams) {
  return rewrite(pack, json, {pack.bin().begin(), pack.bin().end()}, std::move(streams));
}

/// A bumpy sheet of n x n quads with texture coordinates and colours.
inline Mesh painted_sheet(uint32_t n) {
  Mesh mesh;
  Random random(7, 0);
  for (uint32_t j = 0; j <= n; j++)
    for (uint32_t i = 0; i <= n; i++) {
      const float u = static_cast<float>(i) / static_cast<float>(n), v = static_cast<float>(j) / static_cast<float>(n);
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

/// The sheet with a material, shown by a node. One of 20 x 20 quads stays whole in the opening, one of 50 x 50 is
/// streamed.
inline Document sheet_document(uint32_t n = 20) {
  Document document;
  DocumentBuilder builder(document);
  Json primitive = builder.primitive(painted_sheet(n));
  primitive["material"] = builder.add("materials", Json::object());
  builder.add("meshes", {{"primitives", Json::array({primitive})}});
  document.json["nodes"] = {{{"mesh", 0}}};
  builder.add("scenes", {{"nodes", {0}}});
  return document;
}

/// A sheet of n x n quads (n even) that four joints and two morph targets bend. Along its middle it has two vertices at
/// each place, which only their joints tell apart. The second target moves a few vertices and no normals.
inline Document deforming_document(uint32_t n) {
  Mesh mesh = painted_sheet(n);
  mesh.texcoords[0].clear();
  mesh.colors.clear();
  const auto all = static_cast<uint32_t>(mesh.positions.size());
  for (uint32_t j = 0; j <= n; j++) {
    mesh.positions.push_back(mesh.positions[j * (n + 1) + n / 2]);
    mesh.normals.push_back(mesh.normals[j * (n + 1) + n / 2]);
  }
  for (size_t f = 0; f < mesh.faces.size(); f++)
    if (f / 2 % n >= n / 2)
      for (uint32_t& corner : mesh.faces[f])
        if (corner % (n + 1) == n / 2) corner = all + corner / (n + 1);

  std::vector<std::array<uint8_t, 4>> joints;
  std::vector<Vec4f> weights;
  std::vector<Vec3f> bulge, turn, corner;
  for (uint32_t v = 0; v < mesh.positions.size(); v++) {
    const Vec3f p = mesh.positions[v];
    const bool right = v >= all || v % (n + 1) > n / 2;
    joints.push_back(right ? std::array<uint8_t, 4>{2, 3, 0, 0} : std::array<uint8_t, 4>{0, 1, 0, 0});
    const float second = std::floor(8 * p[1]) / 8;
    weights.push_back({{1 - second, second, 0, 0}});
    bulge.push_back({{0, 0, 1 + p[0] * p[1]}});
    turn.push_back({{0.1f * p[0], 0, 0}});
    corner.push_back(p[0] + p[1] < 0.2f ? Vec3f{{0, 1, p[0]}} : Vec3f{});
  }
  Document document;
  DocumentBuilder builder(document);
  Json primitive = builder.primitive(mesh);
  const auto vec4 = [&](const auto& values, Component component) {
    const Bytes bytes(reinterpret_cast<const uint8_t*>(values.data()), values.size() * sizeof(values[0]));
    return builder.add("accessors", {{"bufferView", builder.buffer_view(bytes)},
                                     {"componentType", static_cast<int>(component)},
                                     {"count", values.size()},
                                     {"type", "VEC4"}});
  };
  primitive["attributes"]["JOINTS_0"] = vec4(joints, Component::u8);
  primitive["attributes"]["WEIGHTS_0"] = vec4(weights, Component::f32);
  primitive["targets"] = {{{"POSITION", builder.accessor(bulge, true)}, {"NORMAL", builder.accessor(turn, false)}},
                          {{"POSITION", builder.accessor(corner, true)}}};
  builder.add("meshes", {{"primitives", Json::array({primitive})}});
  document.json["skins"] = {{{"joints", {1, 2, 3, 4}}}};
  document.json["nodes"] = {{{"mesh", 0}, {"skin", 0}}, Json::object(), Json::object(), Json::object(), Json::object()};
  builder.add("scenes", {{"nodes", {0, 1, 2, 3, 4}}});
  return document;
}

/// Gives the first material of a document an image that no file makes small: noise. Returns its file.
inline std::vector<uint8_t> add_noise(Document& document, int side) {
  Image noise{side, side, 3, {}};
  Random random(5, 0);
  for (int i = 0; i < side * side * 3; i++) noise.pixels.push_back(static_cast<uint8_t>(random.below(256)));
  std::vector<uint8_t> file = write_png(noise);
  const int view = DocumentBuilder(document).buffer_view(file);
  document.json["images"] = {{{"bufferView", view}, {"mimeType", "image/png"}}};
  document.json["textures"] = {{{"source", 0}}};
  document.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  return file;
}

}  // namespace lightwell
