// SPDX-License-Identifier: Apache-2.0
//
// Imports any glTF document as a scene. The input is a script of edits to the JSON of a document that has some of
// everything the import reads: a text with changed bytes is hardly ever JSON, let alone a document.
#include <cmath>

#include "lightwell/base/assert.h"
#include "lightwell/scene/import_gltf.h"

using namespace lightwell;

namespace {

// Larger documents would only slow the search down.
constexpr size_t most_edits = 64, most_places = 4096;

/// A valid document. Its buffer holds four positions, normals and texture coordinates, six indices, and sixteen times
/// 1.
constexpr std::string_view valid_document =
    R"({
  "asset": {"version": "2.0"},
  "extensionsUsed": ["EXT_mesh_gpu_instancing", "EXT_texture_webp", "KHR_animation_pointer", "KHR_lights_punctual",
    "KHR_materials_emissive_strength", "KHR_materials_transmission", "KHR_materials_unlit", "KHR_node_visibility",
    "KHR_texture_transform"],
  "scene": 0,
  "scenes": [{"nodes": [0, 1, 2, 3, 4], "extras": {"lightwell": {"skyRadiance": [1, 2, 3]}}}],
  "nodes": [
    {"children": [5, 6, 7], "translation": [1, 2, 3], "rotation": [0, 0.6, 0, 0.8], "scale": [1, 2, -1]},
    {"mesh": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]},
    {"name": "eye", "camera": 0, "children": [8]},
    {"mesh": 1, "skin": 0},
    {"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 0, "ROTATION": 5, "SCALE": 6}}}},
    {"name": "sun", "extensions": {"KHR_lights_punctual": {"light": 0}}},
    {"name": "spot", "extensions": {"KHR_lights_punctual": {"light": 1}}},
    {"mesh": 0, "extensions": {"KHR_node_visibility": {"visible": false}}},
    {"mesh": 0, "children": [9]},
    {"mesh": 1}],
  "meshes": [
    {"primitives": [
      {"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2, "TEXCOORD_1": 2, "COLOR_0": 5}, "indices": 3, "material": 0},
      {"attributes": {"POSITION": 0}, "mode": 5, "material": 1}]},
    {"primitives": [
      {"attributes": {"POSITION": 0}, "indices": 3, "targets": [{"POSITION": 1}], "material": 2},
      {"attributes": {"POSITION": 0}, "mode": 1}]}],
  "skins": [{"joints": [5]}],
  "animations": [{
    "channels": [
      {"sampler": 0, "target": {"node": 8, "path": "translation"}},
      {"sampler": 0, "target": {"path": "pointer", "extensions": {"KHR_animation_pointer": {"pointer": "/nodes/9/scale"}}}}],
    "samplers": [{"input": 4, "output": 0}]}],
  "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1, "aspectRatio": 1.5},
    "extras": {"width": 640, "height": 480}}],
  "extensions": {"KHR_lights_punctual": {"lights": [
    {"type": "directional", "color": [1, 0.5, 0.25], "intensity": 2},
    {"type": "spot", "range": 10, "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.5}}]}},
  "materials": [
    {"pbrMetallicRoughness": {"baseColorFactor": [0.8, 0.8, 0.8, 0.5], "metallicFactor": 0, "roughnessFactor": 0.5,
        "baseColorTexture": {"index": 0, "texCoord": 1, "extensions": {"KHR_texture_transform":
          {"offset": [0.1, 0.2], "scale": [2, 3], "rotation": 0.4, "texCoord": 0}}},
        "metallicRoughnessTexture": {"index": 1}},
      "alphaMode": "MASK", "alphaCutoff": 0.25, "doubleSided": true},
    {"emissiveFactor": [1, 1, 1], "emissiveTexture": {"index": 0}, "alphaMode": "BLEND", "extensions": {
      "KHR_materials_emissive_strength": {"emissiveStrength": 8}, "KHR_materials_transmission": {"transmissionFactor": 0.6}}},
    {"extensions": {"KHR_materials_unlit": {}}}],
  "textures": [{"source": 0, "sampler": 0}, {"source": 0, "extensions": {"EXT_texture_webp": {"source": 1}}}],
  "samplers": [{"wrapS": 33071, "wrapT": 33648}],
  "images": [{"bufferView": 0, "mimeType": "image/png"}, {"uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAAB)"
    R"(CAIAAACQd1PeAAAADElEQVR4nGNoaGgAAAMEAYFL09IQAAAAAElFTkSuQmCC"}],
  "accessors": [
    {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
    {"bufferView": 0, "byteOffset": 48, "componentType": 5126, "count": 4, "type": "VEC3"},
    {"bufferView": 0, "byteOffset": 96, "componentType": 5126, "count": 4, "type": "VEC2"},
    {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"},
    {"bufferView": 0, "componentType": 5126, "count": 4, "type": "SCALAR"},
    {"bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC4"},
    {"bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC3"}],
  "bufferViews": [
    {"buffer": 0, "byteLength": 128},
    {"buffer": 0, "byteOffset": 128, "byteLength": 12},
    {"buffer": 0, "byteOffset": 140, "byteLength": 64}],
  "buffers": [{"byteLength": 204, "uri": "data:application/octet-stream;base64,)"
    R"(AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAACAPwAAgD8AAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/)"
    R"(AAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/AAAAAAAAgD8AAIA/AAAAAAAAgD8AAAEAAgAAAAIAAwAAAIA/)"
    R"(AACAPwAAgD8AAIA/AACAPwAAgD8AAIA/AACAPwAAgD8AAIA/AACAPwAAgD8AAIA/AACAPwAAgD8AAIA/"}]
})";

/// Collects a value and everything in it.
void collect(Json& value, std::vector<Json*>& places) {
  places.push_back(&value);
  if (value.is_structured())
    for (Json& part : value) collect(part, places);
}

enum class Edit : uint8_t { remove, empty, set_small, set_number, set_power, copy, append, shorten };

/// Edits one place: removes or shortens it, or puts in a value of the script or a copy of another place.
void edit(const std::vector<Json*>& places, ByteReader& script) {
  Json& place = *places[script.u16() % places.size()];
  const Json& other = *places[script.u16() % places.size()];
  switch (static_cast<Edit>(script.u8() % 8)) {
    case Edit::remove: place = nullptr; break;
    case Edit::empty: place = Json::array(); break;
    case Edit::set_small: place = static_cast<int>(script.u8()) - 1; break;
    case Edit::set_number: place = script.f64(); break;
    case Edit::set_power: place = std::ldexp(1.0, script.u8() * 8); break;
    case Edit::copy: place = Json(other); break;
    case Edit::append:
      if (place.is_array()) place.push_back(Json(other));
      break;
    case Edit::shorten:
      if (place.is_array() && !place.empty()) place.erase(place.size() - 1);
      break;
  }
}

Json edited_document(ByteReader script) {
  static const Json valid = Json::parse(valid_document);
  Json document = valid;
  for (size_t edits = 0; edits < most_edits && script.remaining() > 0; edits++) {
    std::vector<Json*> places;
    collect(document, places);
    if (places.size() > most_places) break;
    edit(places, script);
  }
  return document;
}

bool refers(int index, size_t count) { return index >= 0 && static_cast<size_t>(index) < count; }

bool is_finite(const Transform& m) { return std::isfinite(length(m.x) + length(m.y) + length(m.z) + length(m.t)); }

void check(const TextureLookup& lookup, const Scene& scene) {
  LW_ASSERT(lookup.image == -1 || refers(lookup.image, scene.images.size()));
  LW_ASSERT(lookup.texcoord == 0 || lookup.texcoord == 1);
}

void check(const Mesh& mesh) {
  for (const Vec3f& position : mesh.positions) LW_ASSERT(is_finite(position));
  for (const Face& face : mesh.faces)
    for (const uint32_t corner : face) LW_ASSERT(corner < mesh.positions.size());
}

void check(const Scene& scene) {
  for (const Image& image : scene.images) LW_ASSERT(image.width > 0 && image.height > 0 && !image.pixels.empty());
  for (const Material& material : scene.materials) {
    for (const TextureLookup* lookup :
         {&material.base_color_texture, &material.emission_texture, &material.metallic_roughness_texture})
      check(*lookup, scene);
    LW_ASSERT(is_finite(material.emission));
  }
  for (const Primitive& primitive : scene.primitives) {
    LW_ASSERT(primitive.material == -1 || refers(primitive.material, scene.materials.size()));
    check(primitive.mesh);
  }
  for (const Instance& instance : scene.instances)
    LW_ASSERT(refers(instance.primitive, scene.primitives.size()) && is_finite(instance.to_scene));
  for (const Lamp& lamp : scene.lamps)
    LW_ASSERT(is_finite(lamp.position) && is_finite(lamp.direction) && is_finite(lamp.intensity));
  for (const Camera& camera : scene.cameras) LW_ASSERT(is_finite(camera.to_scene));
}

}  // namespace

/// Every document gives a scene whose meshes and lights are valid, or an error of one line.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string text = edited_document(ByteReader({data, size})).dump();
  Report report;
  auto document = read_document(as_bytes(text), "/nonexistent", report);
  if (!document) return 0;
  const auto scene = scene_from_document(std::move(*document), "fuzzed", report);
  if (scene)
    check(*scene);
  else
    LW_ASSERT(scene.error().message().find('\n') == std::string::npos);
  return 0;
}
