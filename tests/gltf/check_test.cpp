// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tests/gltf/samples.h"

namespace lightwell {
namespace {

/// A document with one of everything that a check looks at.
Document rich_document() {
  Mesh mesh = square();
  mesh.normals.assign(4, Vec3f{{0, 0, 1}});
  Document document = document_of(mesh);
  DocumentBuilder builder(document);
  builder.add("materials", {{"name", "grey"}, {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
  builder.add("images", {{"bufferView", builder.buffer_view(bytes_of("no image"))}, {"mimeType", "image/png"}});
  builder.add("samplers", Json::object());
  builder.add("textures", {{"source", 0}, {"sampler", 0}});
  builder.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}});
  builder.add("nodes", {{"camera", 0}, {"children", {2}}});
  builder.add("nodes", {{"rotation", {0, 0, 0, 1}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  builder.add("skins", {{"joints", {1, 2}}, {"skeleton", 1}});
  builder.add("animations",
              {{"samplers", Json::array({{{"input", 0}, {"output", 0}}})},
               {"channels", Json::array({{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}}})}});
  document.json["scenes"][0]["nodes"].push_back(1);
  document.json["meshes"][0]["primitives"][0]["material"] = 0;
  document.json["extensions"] = {{"KHR_lights_punctual", {{"lights", Json::array({{{"type", "point"}}})}}}};
  document.json["extensionsUsed"] = {"KHR_lights_punctual"};
  return document;
}

struct Fault {
  const char* pointer;  ///< where the JSON is changed
  Json value;           ///< to what
  const char* message;  ///< and what is said about it
};

class Check : public testing::TestWithParam<Fault> {};

TEST_P(Check, NamesTheFault) {
  Document document = rich_document();
  ASSERT_TRUE(read_again(document)) << read_again(document).error().message();
  document.json[Json::json_pointer(GetParam().pointer)] = GetParam().value;
  const auto read = read_again(document);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().message(), GetParam().message);
}

const Json no_accessor = {{"componentType", 5126}, {"count", 3}, {"type", "VEC3"}};

INSTANTIATE_TEST_SUITE_P(
    All, Check,
    testing::Values(
        Fault{"/nodes", 1, "nodes: is not an array"}, Fault{"/meshes/0", 1, "meshes[0]: is not an object"},
        Fault{"/scene", 3, "scene: there is no scenes[3]"}, Fault{"/scene", -1, "scene: is not an index"},
        Fault{"/scene", "0", "scene: is not an index"}, Fault{"/scene", 0.5, "scene: is not an index"},
        Fault{"/scenes/0/nodes/0", 9, "scenes[0].nodes[0]: there is no nodes[9]"},
        Fault{"/scenes/0/nodes/0", 2, "scenes[0]: nodes[2] is no root"},
        Fault{"/scenes/0/nodes/1", 0, "scenes[0]: nodes[0] is listed twice"},
        Fault{"/nodes/0/mesh", 1, "nodes[0].mesh: there is no meshes[1]"},
        Fault{"/nodes/0/skin", 7, "nodes[0].skin: there is no skins[7]"},
        Fault{"/nodes/1/camera", 1, "nodes[1].camera: there is no cameras[1]"},
        Fault{"/nodes/1/children/0", 1, "nodes[1]: is its own ancestor"},
        Fault{"/nodes/2/children", {1}, "nodes[1]: is its own ancestor"},
        Fault{"/nodes/0/children", {2}, "nodes[2]: has more than one parent"},
        Fault{"/nodes/0/children", 7, "nodes[0]: children is not an array"},
        Fault{"/nodes/0/extensions",
              {{"EXT_mesh_gpu_instancing", {{"attributes", 77}}}},
              "nodes[0].EXT_mesh_gpu_instancing: attributes is not an object"},
        Fault{"/textures/0/extensions", Json::array(),
              "textures[0]: it, or something in it, has extensions that are no object"},
        Fault{"/extensions", 1, "extensions: is, or has in it, extensions that are no object"},
        Fault{"/materials/0/pbrMetallicRoughness/baseColorTexture/extensions", "x",
              "materials[0]: it, or something in it, has extensions that are no object"},
        Fault{"/scenes/0/nodes", 7, "scenes[0]: nodes is not an array"},
        Fault{"/animations/0/channels", 7, "animations[0]: channels is not an array"},
        Fault{"/skins", {{{"joints", 7}}}, "skins[0]: joints is not an array"},
        Fault{"/extensions/KHR_lights_punctual/lights/1", 7, "KHR_lights_punctual: lights is not an array of objects"},
        Fault{"/extensions/KHR_materials_variants/variants/0", 1,
              "KHR_materials_variants: variants is not an array of objects"},
        Fault{"/meshes/0/primitives/0/targets", 7, "meshes[0].primitives[0]: targets is not an array"},
        Fault{"/nodes/0/matrix", {1, 2}, "nodes[0]: matrix is not an array of 16 numbers"},
        Fault{"/nodes/2/rotation/3", "1", "nodes[2]: rotation is not an array of 4 numbers"},
        Fault{"/nodes/2/extensions/KHR_lights_punctual/light", 1,
              "nodes[2].extensions.KHR_lights_punctual.light: there is no extensions.KHR_lights_punctual.lights[1]"},
        Fault{"/skins/0/joints/1", 5, "skins[0].joints[1]: there is no nodes[5]"},
        Fault{"/animations/0/channels/0/target/node", 5, "animations[0].channels[0].target.node: there is no nodes[5]"},
        Fault{"/animations/0/samplers/0/input", 90, "animations[0].samplers[0].input: there is no accessors[90]"},
        Fault{"/meshes/0/primitives", Json::array(), "meshes[0]: has no primitives"},
        Fault{"/meshes/0/primitives/0/attributes", Json::object(), "meshes[0].primitives[0]: has no attributes"},
        Fault{"/meshes/0/primitives/0/mode", 7, "meshes[0].primitives[0]: mode is not a number from 0 to 6"},
        Fault{"/meshes/0/primitives/0/material", 1, "meshes[0].primitives[0].material: there is no materials[1]"},
        Fault{"/meshes/0/primitives/0/indices", 3, "meshes[0].primitives[0].indices: there is no accessors[3]"},
        Fault{"/meshes/0/primitives/0/attributes/NORMAL", 2,
              "meshes[0].primitives[0]: attribute NORMAL has another count than the others"},
        Fault{"/meshes/0/primitives/0/targets", Json::array({{{"POSITION", 8}}}),
              "meshes[0].primitives[0].targets[0].POSITION: there is no accessors[8]"},
        Fault{"/materials/0/pbrMetallicRoughness/baseColorTexture/index", 4,
              "materials[0].pbrMetallicRoughness.baseColorTexture.index: there is no textures[4]"},
        Fault{
            "/materials/0/normalTexture", {{"index", 4}}, "materials[0].normalTexture.index: there is no textures[4]"},
        Fault{"/materials/0/extensions",
              {{"KHR_materials_clearcoat", {{"clearcoatTexture", {{"index", 4}}}}}},
              "materials[0].extensions.KHR_materials_clearcoat.clearcoatTexture.index: there is no textures[4]"},
        Fault{"/textures/0/source", 4, "textures[0].source: there is no images[4]"},
        Fault{"/textures/0/sampler", 4, "textures[0].sampler: there is no samplers[4]"},
        Fault{"/images/0/bufferView", 44, "images[0].bufferView: there is no bufferViews[44]"},
        Fault{"/accessors/0/componentType", 5124, "accessors[0]: componentType is none of glTF's"},
        Fault{"/accessors/0/type", "VEC5", "accessors[0]: type is none of glTF's"},
        Fault{"/accessors/0/count", 5, "accessors[0]: reaches outside bufferViews[0]"},
        Fault{"/accessors/0/count", 0, "accessors[0]: count is not a valid size"},
        Fault{"/accessors/0/count", 1e300, "accessors[0]: count is not a valid size"},
        Fault{"/accessors/0/count", 9007199254740992.0, "accessors[0]: reaches outside bufferViews[0]"},
        Fault{"/accessors/0/byteOffset", -4, "accessors[0]: byteOffset is not a valid size"},
        Fault{"/accessors/0/bufferView", nullptr, "accessors[0].bufferView: is not an index"},
        Fault{"/accessors/0/sparse", Json::object(), "accessors[0].sparse: count is missing"},
        Fault{"/bufferViews/0/buffer", 1, "bufferViews[0].buffer: there is no buffers[1]"},
        Fault{"/bufferViews/0/byteLength", 100000, "bufferViews[0]: reaches outside buffers[0]"},
        Fault{"/bufferViews/0/byteOffset", 100000, "bufferViews[0]: reaches outside buffers[0]"},
        Fault{"/bufferViews/0/byteStride", 6, "bufferViews[0]: byteStride is not a multiple of 4 from 4 to 252"},
        Fault{"/bufferViews/0/byteStride", 8,
              "accessors[0]: its elements are larger than the stride of its buffer view"},
        Fault{"/buffers/0/byteLength", 1e6, "buffers[0]: byteLength is 1000000, but it holds 116 bytes"},
        Fault{"/buffers/0/uri", "data:;base64,****", "buffers[0]: its data URI holds a character that is not base64"}));

TEST(CheckPrimitive, NamesTheFault) {
  const auto error_of = [](const char* pointer, const Json& value) {
    Document document = rich_document();
    document.json[Json::json_pointer(pointer)] = value;
    const auto mesh = first_mesh(document);
    return mesh ? "" : mesh.error().message();
  };
  EXPECT_EQ(error_of("/accessors/1/type", "VEC2"),
            "meshes[0].primitives[0].attributes.NORMAL: accessors[1] is of a type that it cannot have");
  EXPECT_EQ(error_of("/accessors/1/componentType", 5122),
            "meshes[0].primitives[0].attributes.NORMAL: holds integers that are not normalized");
  EXPECT_EQ(error_of("/accessors/2/componentType", 5122), "accessors[2]: holds no indices (unsigned scalars)");
  EXPECT_EQ(error_of("/meshes/0/primitives/0/mode", 1), "meshes[0].primitives[0]: is not made of triangles");
  EXPECT_EQ(error_of("/meshes/0/primitives/0/attributes", {{"NORMAL", 1}}), "meshes[0].primitives[0]: has no POSITION");
}

}  // namespace
}  // namespace lightwell
