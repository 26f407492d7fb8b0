// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/obj_materials.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "lightwell/gltf/resource.h"
#include "lightwell/scene/cutout.h"
#include "lightwell/scene/obj_text.h"
#include "lightwell/texture/image_file.h"

namespace lightwell {
namespace {

/// A number of a material, kept within [0, most].
float clamped(float value, float most) { return std::isfinite(value) ? std::clamp(value, 0.0f, most) : 0; }

Vec3f clamped(const float (&rgb)[3], float most) {
  return {{clamped(rgb[0], most), clamped(rgb[1], most), clamped(rgb[2], most)}};
}

/// The visible properties of a material that are not read, by their names in the file.
std::vector<std::string> unread(const tinyobj::material_t& material) {
  constexpr int glossy = 2;  // illum from here on asks for highlights
  std::vector<std::string> names;
  const auto add = [&](bool set, const char* name) {
    if (set) names.push_back(name);
  };
  add(material.illum >= glossy && max_component(clamped(material.specular, 1)) > 0, "Ks");
  add(material.metallic > 0, "Pm");
  add(material.roughness > 0, "Pr");
  add(!material.bump_texname.empty() || !material.displacement_texname.empty(), "bump");
  add(!material.normal_texname.empty(), "norm");
  add(!material.specular_texname.empty(), "map_Ks");
  add(!material.metallic_texname.empty(), "map_Pm");
  add(!material.roughness_texname.empty(), "map_Pr");
  return names;
}

}  // namespace

bool ObjMaterialReader::operator()(const std::string& names, std::vector<tinyobj::material_t>* materials,
                                   std::map<std::string, int>* indices, std::string*, std::string*) {
  if (read(names, materials, indices)) return true;
  // Not one file with spaces in its name: perhaps several files.
  bool any = false;
  std::istringstream words(names);
  for (std::string name; words >> name && name != names;) any |= read(name, materials, indices);
  if (!any) report_.warn("mtllib " + names.substr(0, 80) + ": no such file below the OBJ file's folder");
  return any;
}

bool ObjMaterialReader::read(const std::string& name, std::vector<tinyobj::material_t>* materials,
                             std::map<std::string, int>* indices) {
  const auto file = read_uri(as_uri(name), folder_);
  if (!file) return false;
  std::istringstream text(checked_mtl_text(*file));
  std::string warning, error;
  tinyobj::LoadMtl(indices, materials, &text, &warning, &error);
  folder_of_material_.resize(materials->size(), std::filesystem::path(name).parent_path());
  return true;
}

std::string ObjMaterialReader::texture_uri(const std::string& name, size_t material) const {
  return as_uri((folder_of_material_[material] / name).lexically_normal().generic_string());
}

Json ObjMaterialReader::texture(SceneBuilder& scene, const std::string& name, size_t material) const {
  return {{"index", scene.texture(texture_uri(name, material))}};
}

/// glTF has a colour's opacity in the alpha of its image: the map of another image becomes that.
void ObjMaterialReader::add_opacity(SceneBuilder& scene, const tinyobj::material_t& material, size_t index,
                                    Json& json) const {
  json["alphaMode"] = "MASK";
  if (material.alpha_texname == material.diffuse_texname) return;
  const auto mask = read_uri(texture_uri(material.alpha_texname, index), folder_);
  auto color = material.diffuse_texname.empty() ? Result<std::vector<uint8_t>>()
                                                : read_uri(texture_uri(material.diffuse_texname, index), folder_);
  const Result<std::vector<uint8_t>> cut =
      mask && color ? cut_out(*color, *mask, limit_) : fail(mask ? color.error() : mask.error());
  if (cut)
    json["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", scene.texture(*cut)}};
  else
    report_.warn("material " + material.name.substr(0, 80) +
                 ": map_d is left out: " + naming_image_option(cut.error()).message());
}

int ObjMaterialReader::add_to(SceneBuilder& scene, const tinyobj::material_t& material, size_t index,
                              bool has_texcoords) const {
  for (const std::string& name : unread(material))
    report_.warn("materials: " + name + " is not supported and left out; surfaces are diffuse");
  Json json = lambertian_json({.name = material.name,
                               .color = clamped(material.diffuse, 1),
                               .emission = clamped(material.emission, 1e9f),
                               .double_sided = true});
  if (has_texcoords && !material.diffuse_texname.empty())
    json["pbrMetallicRoughness"]["baseColorTexture"] = texture(scene, material.diffuse_texname, index);
  if (has_texcoords && !material.emissive_texname.empty()) {
    json["emissiveTexture"] = texture(scene, material.emissive_texname, index);
    // A map without a factor is meant to be seen.
    if (max_component(clamped(material.emission, 1e9f)) == 0) json["emissiveFactor"] = {1, 1, 1};
  }
  if (!has_texcoords && !(material.diffuse_texname.empty() && material.alpha_texname.empty()))
    report_.warn("material " + material.name.substr(0, 80) + ": its textures are left out where faces have no vt");
  const float opacity = clamped(material.dissolve, 1);
  if (opacity < 1) {
    json["pbrMetallicRoughness"]["baseColorFactor"][3] = opacity;
    json["alphaMode"] = "BLEND";
  }
  if (has_texcoords && !material.alpha_texname.empty()) add_opacity(scene, material, index, json);
  return scene.material(std::move(json));
}

}  // namespace lightwell
