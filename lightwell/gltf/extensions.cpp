// SPDX-License-Identifier: Apache-2.0
#include "lightwell/gltf/extensions.h"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>

namespace lightwell {
namespace {

constexpr std::array known = std::to_array<std::string_view>({
    // Read here or by the scene's import.
    "EXT_mesh_gpu_instancing",
    "EXT_meshopt_compression",
    "EXT_texture_webp",
    "KHR_draco_mesh_compression",
    "KHR_lights_punctual",
    "KHR_materials_emissive_strength",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_mesh_quantization",
    "KHR_meshopt_compression",
    "KHR_texture_basisu",
    "KHR_texture_transform",
    // Kept as they are.
    "EXT_texture_avif",
    "KHR_animation_pointer",
    "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",
    "KHR_materials_diffuse_transmission",
    "KHR_materials_dispersion",
    "KHR_materials_ior",
    "KHR_materials_iridescence",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_variants",
    "KHR_materials_volume",
    "KHR_node_visibility",
    "KHR_xmp_json_ld",
    "MSFT_lod",
});

/// Data about what is shown, which cannot change its shape or its light: left out even where a file requires them.
constexpr std::array metadata = std::to_array<std::string_view>({
    "EXT_feature_metadata",
    "EXT_instance_features",
    "EXT_mesh_features",
    "EXT_structural_metadata",
    "KHR_xmp",
});

/// Removes names from the lists of extensions, and lists that become empty.
template <typename Unwanted>
void forget(Json& json, const Unwanted& unwanted) {
  for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
    if (!member(json, list).is_array()) continue;
    Json kept = Json::array();
    for (Json& entry : json[list])
      if (!unwanted(entry)) kept.push_back(std::move(entry));
    if (kept.empty())
      json.erase(list);
    else
      json[list] = std::move(kept);
  }
}

bool is_known(std::string_view name) {
  return std::find(known.begin(), known.end(), name) != known.end() || name.starts_with("LIGHTWELL_");
}

bool is_metadata(std::string_view name) { return std::find(metadata.begin(), metadata.end(), name) != metadata.end(); }

/// Removes unknown extensions and collects their names. Extras may hold anything and are left alone.
void drop_unknown(Json& json, std::set<std::string>& dropped) {
  if (json.is_array())
    for (Json& value : json) drop_unknown(value, dropped);
  if (!json.is_object()) return;
  if (const auto extensions = json.find("extensions"); extensions != json.end() && extensions->is_object()) {
    Json kept = Json::object();
    for (auto& [name, value] : extensions->items()) {
      if (is_known(name))
        kept[name] = std::move(value);
      else
        dropped.insert(name);
    }
    if (kept.empty())
      json.erase("extensions");
    else
      *extensions = std::move(kept);
  }
  for (auto& [name, value] : json.items())
    if (name != "extras") drop_unknown(value, dropped);
}

}  // namespace

Result<void> check_required_extensions(const Json& json) {
  for (const Json& name : member(json, "extensionsRequired"))
    if (name.is_string() && !is_known(name.get<std::string>()) && !is_metadata(name.get<std::string>()))
      return fail(ErrorKind::unsupported, "extensionsRequired",
                  name.get<std::string>().substr(0, 80) + " is not supported");
  return {};
}

void drop_unknown_extensions(Json& json, Report& report) {
  std::set<std::string> dropped;
  drop_unknown(json, dropped);
  for (const Json& name : member(json, "extensionsUsed"))
    if (name.is_string() && !is_known(name.get<std::string>())) dropped.insert(name.get<std::string>());
  forget(json, [&](const Json& name) { return name.is_string() && dropped.contains(name.get<std::string>()); });
  std::string names;
  for (const std::string& name : dropped) {
    if (names.size() < 400) names += (names.empty() ? "" : ", ") + name.substr(0, 80);
  }
  if (!dropped.empty()) report.warn("extensions left out, not supported: " + names);
}

bool uses_extension(const Json& json, std::string_view name) {
  const Json& used = member(json, "extensionsUsed");
  return std::find(used.begin(), used.end(), name) != used.end();
}

void forget_extension(Json& json, std::string_view name) {
  forget(json, [&](const Json& entry) { return entry == name; });
}

}  // namespace lightwell
