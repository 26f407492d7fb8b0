// SPDX-License-Identifier: Apache-2.0
#include "lightwell/gltf/references.h"

#include <array>

namespace lightwell {
namespace {

constexpr std::string_view lights = "extensions.KHR_lights_punctual.lights";
constexpr std::string_view variants = "extensions.KHR_materials_variants.variants";

struct Pattern {
  std::string_view from;  ///< "[]" matches every element, a leading "*" any start of a key
  std::string_view to;
};

constexpr std::array patterns = std::to_array<Pattern>({
    {"scene", "scenes"},
    {"scenes[].nodes[]", "nodes"},
    {"nodes[].children[]", "nodes"},
    {"nodes[].mesh", "meshes"},
    {"nodes[].skin", "skins"},
    {"nodes[].camera", "cameras"},
    {"nodes[].extensions.KHR_lights_punctual.light", lights},
    {"nodes[].extensions.EXT_mesh_gpu_instancing.attributes.*", "accessors"},
    {"nodes[].extensions.MSFT_lod.ids[]", "nodes"},
    {"skins[].joints[]", "nodes"},
    {"skins[].skeleton", "nodes"},
    {"skins[].inverseBindMatrices", "accessors"},
    {"animations[].channels[].target.node", "nodes"},
    {"animations[].samplers[].input", "accessors"},
    {"animations[].samplers[].output", "accessors"},
    {"meshes[].primitives[].attributes.*", "accessors"},
    {"meshes[].primitives[].indices", "accessors"},
    {"meshes[].primitives[].material", "materials"},
    {"meshes[].primitives[].targets[].*", "accessors"},
    {"meshes[].primitives[].extensions.LIGHTWELL_progressive_mesh.deformation.attributes.*", "accessors"},
    {"meshes[].primitives[].extensions.LIGHTWELL_progressive_mesh.deformation.targets[].*", "accessors"},
    {"meshes[].primitives[].extensions.KHR_draco_mesh_compression.bufferView", "bufferViews"},
    {"meshes[].primitives[].extensions.KHR_materials_variants.mappings[].material", "materials"},
    {"meshes[].primitives[].extensions.KHR_materials_variants.mappings[].variants[]", variants},
    {"materials[].*Texture.index", "textures"},
    {"materials[].pbrMetallicRoughness.*Texture.index", "textures"},
    {"materials[].extensions.*.*Texture.index", "textures"},
    {"textures[].sampler", "samplers"},
    {"textures[].source", "images"},
    {"textures[].extensions.*.source", "images"},
    {"images[].bufferView", "bufferViews"},
    {"accessors[].bufferView", "bufferViews"},
    {"accessors[].sparse.indices.bufferView", "bufferViews"},
    {"accessors[].sparse.values.bufferView", "bufferViews"},
    {"bufferViews[].buffer", "buffers"},
    {"bufferViews[].extensions.*.buffer", "buffers"},
});

/// Follows one pattern through the JSON and visits the values that match it.
template <typename AnyJson>
class Walk {
 public:
  Walk(const Pattern& pattern, const ReferenceVisitor<AnyJson>& visit) : pattern_(pattern), visit_(visit) {}

  void follow(AnyJson& json, std::string_view pattern) {
    if (pattern.empty()) return visit_(json, pattern_.to, ReferencePlace(pattern_.from, steps_));
    if (pattern.starts_with("[]")) return each_element(json, pattern.substr(2));
    if (pattern.starts_with('.')) pattern.remove_prefix(1);
    const size_t end = std::min(pattern.find_first_of(".["), pattern.size());
    each_member(json, pattern.substr(0, end), pattern.substr(end));
  }

 private:
  using Step = ReferencePlace::Step;

  void each_element(AnyJson& json, std::string_view rest) {
    if (!json.is_array()) return;
    for (size_t i = 0; i < json.size(); i++) step(i, json[i], rest);
  }

  void each_member(AnyJson& json, std::string_view key, std::string_view rest) {
    if (!json.is_object()) return;
    if (!key.starts_with('*')) {
      const auto found = json.find(key);
      if (found != json.end()) step(key, *found, rest);
      return;
    }
    for (auto& [name, value] : json.items())
      if (name.ends_with(key.substr(1))) step(name, value, rest);
  }

  void step(const Step& taken, AnyJson& json, std::string_view rest) {
    steps_.push_back(taken);
    follow(json, rest);
    steps_.pop_back();
  }

  const Pattern& pattern_;
  const ReferenceVisitor<AnyJson>& visit_;
  std::vector<Step> steps_;
};

template <typename AnyJson>
void walk(AnyJson& json, std::string_view array, const ReferenceVisitor<AnyJson>& visit) {
  for (const Pattern& pattern : patterns)
    if (array.empty() || pattern.to == array) Walk<AnyJson>(pattern, visit).follow(json, pattern.from);
}

}  // namespace

std::string ReferencePlace::text() const {
  std::string text;
  for (const Step& step : steps_)
    if (const size_t* index = std::get_if<size_t>(&step))
      text += element_name("", *index);
    else
      text.append(text.empty() ? "" : ".").append(std::get<std::string_view>(step));
  return text;
}

void for_each_reference(const Json& json, const ReferenceVisitor<const Json>& visit) { walk(json, {}, visit); }

void for_each_reference(Json& json, std::string_view array, const ReferenceVisitor<Json>& visit) {
  walk(json, array, visit);
}

void for_each_reference(const Json& json, std::string_view array, const ReferenceVisitor<const Json>& visit) {
  walk(json, array, visit);
}

const Json& referenced_array(const Json& json, std::string_view array) {
  const Json* found = &json;
  for (size_t begin = 0; begin <= array.size();) {
    const size_t end = std::min(array.find('.', begin), array.size());
    found = &member(*found, std::string(array.substr(begin, end - begin)).c_str());
    begin = end + 1;
  }
  return *found;
}

}  // namespace lightwell
