// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/import_gltf.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <numbers>

#include "lightwell/base/file.h"
#include "lightwell/scene/plain_images.h"
#include "lightwell/texture/image_file.h"
#include "tests/texture/webp_files.h"

namespace lightwell {
namespace {

namespace fs = std::filesystem;

/// The unit square in z = 0, facing +z.
Mesh square() {
  Mesh mesh;
  mesh.positions = {{{0, 0, 0}}, {{1, 0, 0}}, {{1, 1, 0}}, {{0, 1, 0}}};
  mesh.faces = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

/// One mesh, and the nodes of a JSON text under an only scene, which shows those named `roots`.
Document scene_document(const char* nodes, const Json& roots) {
  Document document;
  DocumentBuilder builder(document);
  const Json primitive = builder.primitive(square());
  builder.add("meshes", {{"primitives", Json::array({primitive})}});
  document.json["nodes"] = Json::parse(nodes);
  builder.add("scenes", {{"nodes", roots}});
  return document;
}

Scene import(Document document, Report& report) {
  auto scene = scene_from_document(std::move(document), "test", report);
  EXPECT_TRUE(scene) << scene.error().message();
  return scene ? std::move(*scene) : Scene();
}

Scene import(Document document) {
  Report report;
  Scene scene = import(std::move(document), report);
  EXPECT_EQ(report.warnings, std::vector<std::string>());
  return scene;
}

#define EXPECT_NEAR_VEC(a, b, tolerance) EXPECT_LE(length((a) - (b)), tolerance)

// The product of the textbook matrices, by hand: scaled by 2, turned a quarter about z (x to y), moved by (1, 2, 3);
// the parent moves by (10, 0, 0). Rounding of the quaternion's root stays below 1e-6.
TEST(ImportGltf, TransformsMultiplyDownTheTree) {
  const Scene scene = import(scene_document(R"([
      {"translation": [10, 0, 0], "children": [1, 2]},
      {"translation": [1, 2, 3], "rotation": [0, 0, 0.70710678, 0.70710678], "scale": [2, 2, 2], "mesh": 0},
      {"matrix": [0,2,0,0, -2,0,0,0, 0,0,2,0, 1,2,3,1], "mesh": 0}])",
                                            {0}));
  ASSERT_EQ(scene.instances.size(), 2u);
  ASSERT_EQ(scene.primitives.size(), 1u);
  for (const Instance& instance : scene.instances) {
    EXPECT_EQ(instance.primitive, 0);
    EXPECT_NEAR_VEC(instance.to_scene.point(Vec3f{{1, 0, 0}}), (Vec3f{{11, 4, 3}}), 1e-6f);
    EXPECT_NEAR_VEC(instance.to_scene.point(Vec3f{{0, 1, 1}}), (Vec3f{{9, 2, 5}}), 1e-6f);
  }
  EXPECT_EQ(scene.instances[0].node, 1);
  EXPECT_EQ(scene.instances[1].node, 2);
}

TEST(ImportGltf, ShowsTheDefaultSceneOrTheFirst) {
  Document document = scene_document(R"([{"mesh": 0}, {"mesh": 0, "translation": [0, 0, 5]}])", {0});
  DocumentBuilder(document).add("scenes", {{"nodes", {1}}});
  EXPECT_EQ(import(document).instances.at(0).node, 0);
  document.json["scene"] = 1;
  EXPECT_EQ(import(document).instances.at(0).node, 1);
  EXPECT_EQ(import(document).name, "test");
}

TEST(ImportGltf, MirroredNodesAreKept) {
  const Scene scene = import(scene_document(R"([{"mesh": 0, "scale": [-1, 1, 1]}])", {0}));
  EXPECT_LT(scene.instances.at(0).to_scene.determinant(), 0);
}

TEST(ImportGltf, FlattenedNodesAreLeftOut) {
  const char* nodes = R"([{"mesh": 0, "scale": [1, 0, 1]}, {"mesh": 0, "matrix": [1,2,3,0, 2,4,6,0, 0,0,1,0, 0,0,0,1]},
                          {"mesh": 0, "scale": [1e300, 1e300, 1e300]}, {"mesh": 0, "translation": [1e300, 0, 0]},
                          {"mesh": 0, "scale": [1e-6, 1e-6, 1e-6]}])";
  Report report;
  const Scene scene = import(scene_document(nodes, {0, 1, 2, 3, 4}), report);
  ASSERT_EQ(scene.instances.size(), 1u);
  EXPECT_EQ(scene.instances[0].node, 4);
  EXPECT_EQ(report.warnings, std::vector<std::string>{
                                 "nodes[0] and 3 more: its transform flattens what it holds; left out of the bake"});
}

TEST(ImportGltf, DeepTreesNeedNoStack) {
  std::string nodes = "[";
  for (int i = 1; i <= 100000; i++) nodes += "{\"children\":[" + std::to_string(i) + "]},";
  EXPECT_EQ(import(scene_document((nodes + "{\"mesh\":0}]").c_str(), {0})).instances.size(), 1u);
}

TEST(ImportGltf, GpuInstancesArePlaced) {
  Document document = scene_document(
      R"([{"mesh": 0, "translation": [0, 0, 7], "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {}}}}])", {0});
  DocumentBuilder builder(document);
  Json& nodes = document.json["nodes"];
  const int moved = builder.accessor({{{1, 0, 0}}, {{2, 0, 0}}, {{3, 0, 0}}}, false);
  const int scaled = builder.accessor({{{1, 1, 1}}, {{2, 2, 2}}, {{0, 0, 0}}}, false);
  nodes[0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"TRANSLATION", moved}, {"SCALE", scaled}};
  Report report;
  const Scene scene = import(document, report);
  ASSERT_EQ(scene.instances.size(), 2u);  // the third is flat
  EXPECT_EQ(report.warnings.size(), 1u);
  EXPECT_EQ(scene.instances[1].to_scene.point(Vec3f{{1, 1, 1}}), (Vec3f{{4, 2, 9}}));
  EXPECT_EQ(scene.instances[1].node, 0);

  nodes[0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["ROTATION"] = moved;
  const auto wrong = scene_from_document(document, "", report);
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().message(),
            "nodes[0].EXT_mesh_gpu_instancing.ROTATION: is of a type or count that it cannot have");
}

// A small file that uses the same data again and again must not place or draw more than memory holds.
TEST(ImportGltf, RefusesMoreThanTheFileCanHold) {
  Document document = scene_document("[]", Json::array());
  const int moved = DocumentBuilder(document).accessor(std::vector<Vec3f>(10000), false);
  for (int i = 0; i < 20; i++) {
    document.json["nodes"].push_back(Json::parse(R"({"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {}}})"));
    document.json["nodes"][i]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"TRANSLATION", moved}};
    document.json["scenes"][0]["nodes"].push_back(i);
  }
  Report report;
  const auto placed = scene_from_document(document, "", report);
  ASSERT_FALSE(placed);
  EXPECT_EQ(placed.error().message(), "nodes[18].EXT_mesh_gpu_instancing: places more than the file can hold");

  document = scene_document(R"([{"mesh": 0}])", {0});
  const int many =
      DocumentBuilder(document).add("accessors", {{"componentType", 5126}, {"type", "VEC3"}, {"count", 20000000}});
  Json& primitives = document.json["meshes"][0]["primitives"];
  primitives = Json::array();
  for (int i = 0; i < 2; i++) primitives.push_back({{"attributes", {{"POSITION", many}}}});
  const auto drawn = scene_from_document(document, "", report);
  ASSERT_FALSE(drawn);
  EXPECT_EQ(drawn.error().message(), "meshes[0]: the scene has more corners than the file can hold");
}

// Thousands of instances of a mesh of many faces share it, but not the time that each takes.
TEST(ImportGltf, RefusesMoreTrianglesThanCanBeLookedAt) {
  Document document = scene_document(R"([{"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {}}}])", {0});
  DocumentBuilder builder(document);
  const int moved = builder.accessor(std::vector<Vec3f>(60000), false);
  const int corners = builder.indices(std::vector<Face>(40000, {0, 1, 2}), 3);
  document.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"TRANSLATION", moved}};
  document.json["meshes"][0]["primitives"][0]["indices"] = corners;
  Report report;
  const auto refused = scene_from_document(document, "", report);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message(), "nodes: place more than 2147483648 triangles, counted with every instance");
}

TEST(ImportGltf, AnimatedNodesStandWhereTheFileHasThem) {
  Document document = scene_document(R"([{"children": [1], "translation": [1, 0, 0]}, {"mesh": 0}])", {0});
  DocumentBuilder(document).add("animations",
                                Json::parse(R"({"channels": [{"target": {"node": 0, "path": "rotation"}}]})"));
  const Scene scene = import(document);
  ASSERT_EQ(scene.instances.size(), 1u);
  EXPECT_EQ(scene.instances[0].to_scene.t, (Vec3d{{1, 0, 0}}));
  EXPECT_FALSE(scene.primitives[0].deforming);
}

TEST(ImportGltf, ASkinsJointsStandWhereNumbersReach) {
  for (const char* far : {"1e39", "1e300"}) {
    Document document = scene_document(
        (R"([{"mesh": 0, "skin": 0}, {"translation": [)" + std::string(far) + R"(, 0, 0]}])").c_str(), {0, 1});
    document.json["skins"] = Json::parse(R"([{"joints": [1]}])");
    Report report;
    const auto refused = scene_from_document(document, "", report);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().message(), "nodes[0]: the joints of its skin are too far away");
  }
}

TEST(ImportGltf, MorphTargetsHaveTheirWeights) {
  Document document = scene_document(
      R"([{"mesh": 0}, {"mesh": 0, "weights": [0, 2]}, {"mesh": 0, "translation": [0, 0, 9]}])", {0, 1, 2});
  DocumentBuilder builder(document);
  Json& mesh = document.json["meshes"][0];
  mesh["weights"] = {1, 0};
  mesh["primitives"][0]["targets"] = Json::array();
  for (const float by : {1.0f, 10.0f})
    mesh["primitives"][0]["targets"].push_back(
        {{"POSITION", builder.accessor(std::vector<Vec3f>(4, {{0, 0, by}}), false)}});
  const Scene scene = import(document);
  ASSERT_EQ(scene.primitives.size(), 2u);  // one for each pose
  ASSERT_EQ(scene.instances.size(), 3u);
  for (const Instance& instance : scene.instances) {
    const Primitive& primitive = scene.primitives[static_cast<size_t>(instance.primitive)];
    EXPECT_TRUE(primitive.deforming);
    EXPECT_EQ(primitive.mesh.positions[2], (Vec3f{{1, 1, instance.node == 1 ? 20.0f : 1.0f}}));
  }

  mesh["primitives"][0]["targets"][0]["POSITION"] = builder.accessor(std::vector<Vec3f>(3), false);
  Report report;
  const auto wrong = scene_from_document(document, "", report);
  ASSERT_FALSE(wrong);
  EXPECT_NE(wrong.error().message().find("has another count than POSITION"), std::string::npos);
}

// Two joints, each far away and turned: the lower corners follow the first, the upper ones the second, halves in
// between.
TEST(ImportGltf, SkinsAreInTheirPose) {
  Document document = scene_document(R"([
      {"mesh": 0, "skin": 0, "translation": [77, 0, 0], "scale": [0, 1, 1]},
      {"translation": [0, 0, 5], "children": [2]},
      {"translation": [10, 0, 0], "rotation": [0, 0, 0.70710678118654752, 0.70710678118654752]}])",
                                     {0, 1});
  DocumentBuilder builder(document);
  const auto vec4 = [&](int component, Bytes bytes) {
    return builder.add(
        "accessors",
        {{"bufferView", builder.buffer_view(bytes)}, {"componentType", component}, {"count", 4}, {"type", "VEC4"}});
  };
  const std::array<uint8_t, 16> joints = {0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0};
  const std::array<float, 16> weights = {1, 0, 0, 0, 0.5f, 0.5f, 0, 0, 0, 1, 0, 0, 0, 3, 0, 0};  // the last not scaled
  Json& attributes = document.json["meshes"][0]["primitives"][0]["attributes"];
  attributes["JOINTS_0"] = vec4(5121, joints);
  attributes["WEIGHTS_0"] = vec4(5126, as_bytes(std::string_view(reinterpret_cast<const char*>(weights.data()), 64)));
  document.json["skins"] = Json::parse(R"([{"joints": [1, 2]}])");
  const Scene scene = import(document);
  ASSERT_EQ(scene.instances.size(), 1u);
  const Mesh& mesh = scene.primitives[0].mesh;
  const auto place = [&](size_t i) { return scene.instances[0].to_scene.point(mesh.positions[i]); };
  EXPECT_TRUE(scene.primitives[0].deforming);
  // By hand: the second joint takes (x, y, 0) to (10 - y, x, 5). The node's own transform does not count.
  EXPECT_NEAR_VEC(place(0), (Vec3f{{0, 0, 5}}), 1e-6f);
  EXPECT_NEAR_VEC(place(1), (Vec3f{{5.5f, 0.5f, 5}}), 1e-6f);
  EXPECT_NEAR_VEC(place(2), (Vec3f{{9, 1, 5}}), 1e-6f);
  EXPECT_NEAR_VEC(place(3), (Vec3f{{9, 0, 5}}), 1e-6f);

  document.json["skins"][0]["joints"] = {1};
  Report report;
  const auto wrong = scene_from_document(document, "", report);
  ASSERT_FALSE(wrong);
  EXPECT_NE(wrong.error().message().find("a joint that its skin does not have"), std::string::npos);
}

// 13,000 km away floats are a metre apart; what is there keeps its shape, and lamps and cameras their places in it.
TEST(ImportGltf, ScenesFarAwayAreCountedFromAnOriginNearby) {
  Document document = scene_document(R"([
      {"translation": [13000000.3, 0, 5], "children": [1, 2, 3]}, {"mesh": 0, "scale": [0.1, 0.1, 0.1]},
      {"translation": [0, 0.25, 0], "extensions": {"KHR_lights_punctual": {"light": 0}}},
      {"camera": 0, "translation": [0.25, 0, 0]}])",
                                     {0});
  document.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::parse(R"([{"type": "point"}])");
  document.json["cameras"] = Json::parse(R"([{"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}])");
  Report report;
  const Scene scene = import(document, report);
  EXPECT_EQ(report.warnings.size(), 1u);
  const Vec3d root{{13000000.3, 0, 5}};
  EXPECT_LE(length(scene.origin - root), 0.2);
  const auto in_file = [&](const Vec3f& p) { return p.cast<double>() + scene.origin - root; };
  EXPECT_NEAR_VEC(in_file(scene.bounds().lo), (Vec3d{}), 1e-7);  // a float of a number below 0.2
  EXPECT_NEAR_VEC(in_file(scene.bounds().hi), (Vec3d{{0.1, 0.1, 0}}), 1e-7);
  EXPECT_NEAR_VEC(in_file(scene.lamps.at(0).position), (Vec3d{{0, 0.25, 0}}), 1e-7);
  EXPECT_NEAR_VEC(in_file(scene.cameras.at(0).to_scene.t.cast<float>()), (Vec3d{{0.25, 0, 0}}), 1e-7);

  const auto again = scene_from_document(document, "", report, Vec3d{{13000000, 0, 0}});
  ASSERT_TRUE(again);
  EXPECT_EQ(again->origin, (Vec3d{{13000000, 0, 0}}));
}

// From so far away no ray's length is a float any more. A sun has no place.
TEST(ImportGltf, LampsAndCamerasBeyondNumbersAreLeftOut) {
  Document document = scene_document(R"([{"mesh": 0},
      {"translation": [0, 1e19, 0], "camera": 0},
      {"translation": [0, 1e19, 0], "extensions": {"KHR_lights_punctual": {"light": 0}}},
      {"translation": [0, 1e19, 0], "camera": 0, "extensions": {"KHR_lights_punctual": {"light": 1}}}])",
                                     {0, 1, 2, 3});
  document.json["cameras"] = Json::parse(R"([{"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}])");
  document.json["extensions"]["KHR_lights_punctual"]["lights"] =
      Json::parse(R"([{"type": "point"}, {"type": "directional"}])");
  Report report;
  const Scene scene = import(document, report);
  EXPECT_TRUE(scene.cameras.empty());
  ASSERT_EQ(scene.lamps.size(), 1u);
  EXPECT_EQ(scene.lamps[0].kind, Lamp::Kind::sun);
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_EQ(report.warnings[0], "nodes[1] and 2 more: its lamp or camera stands farther than 1e9 m away; left out");
}

TEST(ImportGltf, LinesAreCopiedWithAWarning) {
  Document document = scene_document(R"([{"mesh": 0}])", {0});
  document.json["meshes"][0]["primitives"][0]["mode"] = 1;
  Report report;
  EXPECT_TRUE(import(document, report).primitives.empty());
  EXPECT_EQ(
      report.warnings,
      std::vector<std::string>{"meshes[0].primitives[0]: has no triangles; copied as it is and left out of the bake"});
}

TEST(ImportGltf, HiddenNodesAreLeftOut) {
  const Document document = scene_document(
      R"([{"children": [1], "extensions": {"KHR_node_visibility": {"visible": false}}}, {"mesh": 0}])", {0});
  Report report;
  EXPECT_TRUE(import(document, report).instances.empty());
  EXPECT_EQ(report.warnings.size(), 1u);
}

TEST(ImportGltf, MaterialsAreRead) {
  Document document;
  document.json["samplers"] = Json::parse(R"([{"wrapS": 33071, "wrapT": 33648}])");
  document.json["images"] = Json::array();
  document.json["textures"] =
      Json::parse(R"([{"source": 0, "sampler": 0}, {"source": 1, "extensions": {"EXT_texture_webp": {"source": 2}}}])");
  document.json["materials"] = Json::parse(R"([{}, {
      "name": "all", "alphaMode": "MASK", "alphaCutoff": 0.25, "doubleSided": true,
      "emissiveFactor": [0.5, 0.25, 0], "emissiveTexture": {"index": 1},
      "pbrMetallicRoughness": {"baseColorFactor": [0.1, 0.2, 0.3, 0.4], "metallicFactor": 0.5, "roughnessFactor": 0.75,
        "baseColorTexture": {"index": 0, "texCoord": 1},
        "metallicRoughnessTexture": {"index": 0, "extensions": {"KHR_texture_transform":
          {"offset": [1, 2], "scale": [3, 4], "rotation": 1.5707963267948966, "texCoord": 1}}}},
      "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 8},
        "KHR_materials_transmission": {"transmissionFactor": 0.6}}
    }, {"alphaMode": "BLEND", "pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 1]}, "extensions": {"KHR_materials_unlit": {}}}])");
  document.json["scenes"] = Json::array({Json::object()});
  const std::vector<Material> materials = import(document).materials;
  ASSERT_EQ(materials.size(), 3u);
  const Material& standard = materials[0];
  EXPECT_EQ(standard.base_color, Vec4f::filled(1));
  EXPECT_EQ(standard.emission, Vec3f{});
  EXPECT_EQ(standard.metallic, 1);
  EXPECT_EQ(standard.roughness, 1);
  EXPECT_EQ(standard.alpha, Material::Alpha::opaque);
  EXPECT_EQ(standard.base_color_texture.image, -1);

  const Material& all = materials[1];
  EXPECT_EQ(all.name, "all");
  EXPECT_EQ(all.alpha, Material::Alpha::mask);
  EXPECT_EQ(all.alpha_cutoff, 0.25f);
  EXPECT_TRUE(all.double_sided);
  EXPECT_EQ(all.base_color, (Vec4f{{0.1f, 0.2f, 0.3f, 0.4f}}));
  EXPECT_EQ(all.emission, (Vec3f{{4, 2, 0}}));
  EXPECT_EQ(all.emission_texture.image, 2);
  EXPECT_EQ(all.metallic, 0.5f);
  EXPECT_EQ(all.roughness, 0.75f);
  EXPECT_EQ(all.transmission, 0.6f);
  EXPECT_EQ(all.base_color_texture.image, 0);
  EXPECT_EQ(all.base_color_texture.texcoord, 1);
  EXPECT_EQ(all.base_color_texture.wrap_u, TextureLookup::Wrap::clamp);
  EXPECT_EQ(all.base_color_texture.wrap_v, TextureLookup::Wrap::mirror);
  // A quarter counter-clockwise with v up: u' = 4 v + 1, v' = -3 u + 2.
  const TextureLookup& turned = all.metallic_roughness_texture;
  EXPECT_EQ(turned.texcoord, 1);
  for (const auto& [value, expected] :
       {std::pair(turned.row_u[0], 0.0f), std::pair(turned.row_u[1], 4.0f), std::pair(turned.row_u[2], 1.0f),
        std::pair(turned.row_v[0], -3.0f), std::pair(turned.row_v[1], 0.0f), std::pair(turned.row_v[2], 2.0f)})
    EXPECT_NEAR(value, expected, 1e-6f);

  EXPECT_EQ(materials[2].alpha, Material::Alpha::blend);
  EXPECT_EQ(materials[2].metallic, 0);
}

TEST(ImportGltf, GlossAndNormalMapsAreRead) {
  Document document;
  document.json["images"] = Json::array();
  document.json["textures"] = Json::parse(R"([{"source": 0}, {"source": 1}, {"source": 2}, {"source": 3}])");
  document.json["materials"] = Json::parse(R"([{}, {
      "normalTexture": {"index": 0, "texCoord": 1, "scale": -0.5},
      "extensions": {"KHR_materials_ior": {"ior": 1.8},
        "KHR_materials_transmission": {"transmissionFactor": 1, "transmissionTexture": {"index": 1}},
        "KHR_materials_specular": {"specularFactor": 0.25, "specularColorFactor": [2, 0.5, 0],
          "specularTexture": {"index": 2}, "specularColorTexture": {"index": 3, "texCoord": 1}}}
    }, {"normalTexture": {"index": 0}, "extensions": {"KHR_materials_unlit": {}}}])");
  document.json["scenes"] = Json::array({Json::object()});
  const std::vector<Material> materials = import(document).materials;
  EXPECT_EQ(materials[0].specular, 1);
  EXPECT_EQ(materials[0].specular_color, Vec3f::filled(1));
  EXPECT_EQ(materials[0].ior, 1.5f);
  EXPECT_EQ(materials[0].normal_texture.image, -1);
  const Material& all = materials[1];
  EXPECT_EQ(all.specular, 0.25f);
  EXPECT_EQ(all.specular_color, (Vec3f{{2, 0.5f, 0}}));
  EXPECT_EQ(all.ior, 1.8f);
  EXPECT_EQ(all.normal_texture.image, 0);
  EXPECT_EQ(all.normal_texture.texcoord, 1);
  EXPECT_EQ(all.normal_scale, -0.5f);
  EXPECT_EQ(all.transmission_texture.image, 1);
  EXPECT_EQ(all.specular_texture.image, 2);
  EXPECT_EQ(all.specular_color_texture.image, 3);
  EXPECT_EQ(all.specular_color_texture.texcoord, 1);
  // What is unlit has neither gloss nor bumps.
  EXPECT_EQ(materials[2].specular, 0);
  EXPECT_EQ(materials[2].normal_texture.image, -1);
}

// One line for each extension, by the first material that has it.
TEST(ImportGltf, ExtensionsThatAreIgnoredAreNamed) {
  Document document;
  document.json["materials"] = Json::parse(R"([
    {"extensions": {"KHR_materials_ior": {"ior": 1.3}, "KHR_materials_unlit": {}}},
    {"name": "paint", "extensions": {"KHR_materials_clearcoat": {"clearcoatFactor": 1}}},
    {"extensions": {"KHR_materials_sheen": {}, "KHR_materials_clearcoat": {}}}])");
  document.json["scenes"] = Json::array({Json::object()});
  Report report;
  import(document, report);
  EXPECT_EQ(report.warnings,
            (std::vector<std::string>{
                "materials[1] \"paint\" and 1 more: KHR_materials_clearcoat is ignored; the light is that without it",
                "materials[2]: KHR_materials_sheen is ignored; the light is that without it"}));
}

TEST(ImportGltf, FactorsOutsideTheirRangeAreClamped) {
  Document document;
  document.json["scenes"] = Json::array({Json::object()});
  document.json["materials"] = Json::parse(R"([{"emissiveFactor": [-1, 1e300, 0.5], "extensions":
      {"KHR_materials_emissive_strength": {"emissiveStrength": 1e300}}}])");
  Report report;
  const Scene scene = import(document, report);
  EXPECT_EQ(scene.materials[0].emission, (Vec3f{{0, 1e12f, 0.5e12f}}));
  EXPECT_EQ(report.warnings, std::vector<std::string>{"materials[0]: factors outside their range were clamped"});
}

TEST(ImportGltf, ImagesAreDecodedAndOthersAreWhite) {
  Document document;
  document.json["scenes"] = Json::array({Json::object()});
  DocumentBuilder builder(document);
  const int png = builder.buffer_view(write_png(Image{1, 2, 3, {1, 2, 3, 4, 5, 6}}));
  const std::string ktx2 = "\xabKTX 20\xbb\r\n\x1a\n";
  builder.add("images", {{"bufferView", png}, {"mimeType", "image/png"}});
  builder.add("images", {{"bufferView", builder.buffer_view(as_bytes(ktx2))}, {"mimeType", "image/ktx2"}});
  builder.add("images", {{"uri", "../secret.png"}});
  builder.add("images", {{"uri", "nobody-asks-for-it.png"}});
  document.json["textures"] =
      Json::parse(R"([{"source": 0}, {"extensions": {"KHR_texture_basisu": {"source": 1}}}, {"source": 2}])");
  Report report;
  const Scene scene = import(document, report);
  ASSERT_EQ(scene.images.size(), 4u);
  EXPECT_EQ(scene.images[0].pixels, (std::vector<uint8_t>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(scene.images[0].height, 2);
  for (const size_t i : {1, 2, 3}) EXPECT_EQ(scene.images[i].pixels, (std::vector<uint8_t>{255, 255, 255}));
  EXPECT_EQ(report.warnings,
            (std::vector<std::string>{"images[1]: KTX2: damaged header; a white pixel stands for it",
                                      "images[2]: its URI does not lead to a file below the document's folder; a white "
                                      "pixel stands for it"}));
}

// Every viewer shows a PNG; packs hold no KTX2.
TEST(ImportGltf, ImagesInKtx2BecomePngs) {
  const std::string name = std::string(LIGHTWELL_TEST_DATA) + "/ktx2/uastc_rgba_mips_zstd";
  Document document;
  DocumentBuilder builder(document);
  for (int i = 0; i < 2; i++)
    builder.add("images", {{"bufferView", builder.buffer_view(read_file(name + ".ktx2").value())}});
  document.json["textures"] = {{{"extensions", {{"KHR_texture_basisu", {{"source", 1}}}}}}};
  make_images_plain(document, {});
  EXPECT_EQ(document.json["images"][1]["mimeType"], "image/png");
  const auto image = read_image_file(read_image(document, 1).value()).value();
  EXPECT_EQ(image.pixels, read_image_file(read_file(name + ".png").value()).value().pixels);
  EXPECT_FALSE(document.json["images"][0].contains("mimeType")) << "no texture shows it";
}

// An image in another format stands beside glTF's own: WebP is read instead of it, KTX2 is not.
TEST(ImportGltf, TexturesAreReadFromTheFormatThatIsKnown) {
  Document document;
  document.json["scenes"] = Json::array({Json::object()});
  DocumentBuilder builder(document);
  builder.add("images", {{"bufferView", builder.buffer_view(write_png(Image{1, 2, 3, {1, 2, 3, 4, 5, 6}}))}});
  builder.add("images", {{"bufferView", builder.buffer_view(lossless_webp(Image{1, 1, 3, {7, 8, 9}}))}});
  builder.add("images", {{"bufferView", builder.buffer_view(as_bytes("\xabKTX 20 and so on"))}});
  document.json["textures"] = Json::parse(R"([{"source": 0, "extensions": {"EXT_texture_webp": {"source": 1}}},
                                              {"source": 0, "extensions": {"KHR_texture_basisu": {"source": 2}}}])");
  document.json["materials"] = Json::parse(R"([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}},
                                               {"pbrMetallicRoughness": {"baseColorTexture": {"index": 1}}}])");
  Report report;
  const Scene scene = import(document, report);
  EXPECT_EQ(scene.materials[0].base_color_texture.image, 1);
  EXPECT_EQ(scene.materials[1].base_color_texture.image, 0);
  EXPECT_EQ(scene.images[1].pixels, (std::vector<uint8_t>{7, 8, 9}));
  EXPECT_EQ(scene.images[0].height, 2);
  EXPECT_TRUE(report.warnings.empty());
}

TEST(ImportGltf, VariantsAreNamed) {
  Report report;
  Json json = Json::object();
  name_variants(json, report);
  EXPECT_TRUE(report.warnings.empty());
  json["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "oak"}}, {{"name", "steel"}}};
  name_variants(json, report);
  EXPECT_EQ(report.warnings,
            std::vector<std::string>{
                "variants \"oak\", \"steel\" are kept; the light is that of the materials without a variant"});
}

TEST(ImportGltf, LampsAreRead) {
  Document document = scene_document(R"([
      {"extensions": {"KHR_lights_punctual": {"light": 0}}, "rotation": [-0.70710678, 0, 0, 0.70710678]},
      {"name": "node", "translation": [1, 2, 3], "scale": [5, 5, 5], "extensions": {"KHR_lights_punctual": {"light": 1}}},
      {"extensions": {"KHR_lights_punctual": {"light": 2}}},
      {"extensions": {"KHR_lights_punctual": {"light": 3}}}])",
                                     {0, 1, 2, 3});
  document.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::parse(R"([
      {"type": "directional", "name": "sun", "color": [1, 0.5, 0.25], "intensity": 8}, {"type": "point", "range": 4},
      {"type": "spot", "spot": {"innerConeAngle": 0.25, "outerConeAngle": 0.5}},
      {"type": "point", "intensity": 0}])");
  const std::vector<Lamp> lamps = import(document).lamps;
  ASSERT_EQ(lamps.size(), 3u);  // the last does not shine
  EXPECT_EQ(lamps[0].kind, Lamp::Kind::sun);
  EXPECT_EQ(lamps[0].name, "sun");
  EXPECT_EQ(lamps[0].intensity, (Vec3f{{8, 4, 2}}));
  EXPECT_NEAR_VEC(lamps[0].direction, (Vec3f{{0, -1, 0}}), 1e-6f);
  EXPECT_EQ(lamps[1].kind, Lamp::Kind::point);
  EXPECT_EQ(lamps[1].name, "node");
  EXPECT_EQ(lamps[1].position, (Vec3f{{1, 2, 3}}));
  EXPECT_EQ(lamps[1].range, 4);
  EXPECT_EQ(lamps[1].node, 1);
  EXPECT_EQ(lamps[2].kind, Lamp::Kind::spot);
  EXPECT_EQ(lamps[2].inner_cone, 0.25f);
  EXPECT_EQ(lamps[2].outer_cone, 0.5f);
}

TEST(ImportGltf, LampsOfUnknownTypeAreLeftOut) {
  Document document = scene_document(R"([{"extensions": {"KHR_lights_punctual": {"light": 0}}}])", {0});
  document.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::parse(R"([{"type": "area", "intensity": 5}])");
  Report report;
  EXPECT_TRUE(import(document, report).lamps.empty());
  EXPECT_EQ(report.warnings,
            std::vector<std::string>{"lights[0]: type \"area\" is none of point, spot and directional; left out"});
}

TEST(ImportGltf, CamerasAndTheSkyAreRead) {
  Document document =
      scene_document(R"([{"camera": 0, "translation": [1, 2, 3], "scale": [2, 2, 2]}, {"camera": 1}])", {0, 1});
  document.json["cameras"] = Json::parse(R"([
      {"name": "eye", "type": "perspective", "perspective": {"yfov": 0.5, "aspectRatio": 2, "znear": 1},
       "extras": {"width": 640, "height": 320}},
      {"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 1, "znear": 1, "zfar": 2}}])");
  document.json["scenes"][0]["extras"]["lightwell"]["skyRadiance"] = {0.5, 1, 2};
  Report report;
  const Scene scene = import(document, report);
  ASSERT_EQ(scene.cameras.size(), 1u);
  EXPECT_EQ(scene.cameras[0].name, "eye");
  EXPECT_EQ(scene.cameras[0].yfov, 0.5f);
  EXPECT_EQ(scene.cameras[0].aspect, 2);
  EXPECT_EQ(scene.cameras[0].width, 640);
  EXPECT_EQ(scene.cameras[0].height, 320);
  EXPECT_EQ(scene.cameras[0].to_scene.point(Vec3f{{0, 0, -1}}), (Vec3f{{1, 2, 2}}));  // the scale is taken out
  EXPECT_EQ(scene.environment.radiance, (Vec3f{{0.5f, 1, 2}}));
  EXPECT_EQ(report.warnings, std::vector<std::string>{"cameras without perspective are left out"});
}

TEST(Reorient, TurnsZUpAndScales) {
  Document document = scene_document(R"([{"mesh": 0}, {"mesh": 0, "translation": [0, 0, 1]}])", {0, 1});
  reorient(document, {.up = {.axis = 2}, .front = {}, .unit = 0.5f});
  const Scene scene = import(document);
  ASSERT_EQ(scene.instances.size(), 2u);
  EXPECT_EQ(scene.instances[0].to_scene.point(Vec3f{{1, 2, 3}}), (Vec3f{{0.5f, 1.5f, -1}}));
  EXPECT_EQ(scene.instances[1].to_scene.point(Vec3f{{0, 0, 0}}), (Vec3f{{0, 0.5f, 0}}));
  EXPECT_GT(scene.instances[0].to_scene.determinant(), 0);
  EXPECT_EQ(document.json["scenes"][0]["nodes"], Json({2}));
}

TEST(Reorient, ChangesNothingWhereNothingIsToDo) {
  Document document = scene_document(R"([{"mesh": 0}])", {0});
  const Json before = document.json;
  reorient(document, {});
  EXPECT_EQ(document.json, before);
  Document empty;
  reorient(empty, {.up = {.axis = 2}, .front = {}, .unit = 2});
  EXPECT_EQ(empty.json, Document().json);
}

TEST(ImportGltf, ShowsTheChosenSceneAndNamesTheOthers) {
  Document document = scene_document(R"([{"mesh": 0}, {"mesh": 0, "translation": [5, 0, 0]}])", {0});
  document.json["scenes"][0]["name"] = "day";
  document.json["scenes"].push_back({{"nodes", {1}}, {"name", "night"}});
  document.json["scenes"].push_back({{"nodes", {0, 1}}});
  const auto shown = [&](const std::string& choice, const char* warning) {
    Document copy = document;
    Report report;
    EXPECT_TRUE(choose_scene(copy, choice, report));
    EXPECT_EQ(report.warnings, std::vector<std::string>{warning});
    return import(std::move(copy)).instances;
  };
  EXPECT_EQ(shown("", "scene \"day\" is shown, not \"night\", 2; --scene chooses")[0].to_scene.t[0], 0);
  EXPECT_EQ(shown("night", "scene \"night\" is shown, not \"day\", 2; --scene chooses")[0].to_scene.t[0], 5);
  EXPECT_EQ(shown("2", "scene 2 is shown, not \"day\", \"night\"; --scene chooses").size(), 2u);
  Report report;
  EXPECT_EQ(choose_scene(document, "dusk", report).error().message(),
            "scene dusk: is not in the file, which has \"day\", \"night\", 2");
}

}  // namespace
}  // namespace lightwell
