// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/obj_materials.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <string_view>

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
constexpr std::array unread_names = {"Ks", "Pm", "Pr", "bump", "norm", "map_Ks", "map_Pm", "map_Pr"};

/// A bit for each of those that a material has.
uint32_t unread(const tinyobj::material_t& material) {
  constexpr int glossy = 2;  // illum from here on asks for highlights
  const std::array<bool, unread_names.size()> set = {
      material.illum >= glossy && max_component(clamped(material.specular, 1)) > 0,
      material.metallic > 0,
      material.roughness > 0,
      !material.bump_texname.empty() || !material.displacement_texname.empty(),
      !material.normal_texname.empty(),
      !material.specular_texname.empty(),
      !material.metallic_texname.empty(),
      !material.roughness_texname.empty()};
  uint32_t bits = 0;
  for (size_t i = 0; i < set.size(); i++) bits |= uint32_t(set[i]) << i;
  return bits;
}

ObjTexture texture_of(const std::string& file, const tinyobj::texture_option_t& options) {
  const auto& offset = options.origin_offset;
  const auto& scale = options.scale;
  return {file, {{{offset[0], offset[1]}}, {{scale[0], scale[1]}}, options.clamp}};
}

ObjMaterial material_of(const tinyobj::material_t& material, size_t folder) {
  return {.name = material.name,
          .color = clamped(material.diffuse, 1),
          .emission = clamped(material.emission, 1e9f),
          .opacity = clamped(material.dissolve, 1),
          .color_map = texture_of(material.diffuse_texname, material.diffuse_texopt),
          .emission_map = texture_of(material.emissive_texname, material.emissive_texopt),
          .opacity_map = material.alpha_texname,
          .unread = unread(material),
          .folder = static_cast<uint32_t>(folder)};
}

/// The first materials of an MTL text, which are taken off it.
std::string take_some(std::string_view& text) {
  constexpr size_t enough = 64 << 10;
  const size_t next = text.size() > enough ? text.find("\nnewmtl ", enough) : text.npos;
  std::string some(text.substr(0, next == text.npos ? next : next + 1));
  text.remove_prefix(some.size());
  return some;
}

}  // namespace

bool ObjMaterialReader::operator()(const std::string& names, std::vector<tinyobj::material_t>*,
                                   std::map<std::string, int>* indices, std::string*, std::string*) {
  if (read(names, *indices)) return true;
  // Not one file with spaces in its name: perhaps several files.
  bool any = false;
  std::istringstream words(names);
  for (std::string name; words >> name && name != names;) any |= read(name, *indices);
  if (!any) report_.warn("mtllib " + names.substr(0, 80) + ": no such file below the OBJ file's folder");
  return any;
}

bool ObjMaterialReader::read(const std::string& name, std::map<std::string, int>& indices) {
  const auto file = read_uri(as_uri(name), folder_);
  if (!file) return false;
  folders_.push_back(std::filesystem::path(name).parent_path());
  const std::string text = checked_mtl_text(*file);
  std::string_view rest = text;
  do read_some(take_some(rest), indices);
  while (!rest.empty());
  return true;
}

void ObjMaterialReader::read_some(const std::string& text, std::map<std::string, int>& indices) {
  std::istringstream stream(text);
  std::string warning, error;
  std::map<std::string, int> own_indices;
  std::vector<tinyobj::material_t> some;
  tinyobj::LoadMtl(&own_indices, &some, &stream, &warning, &error);
  for (const tinyobj::material_t& material : some) {
    indices.emplace(material.name, static_cast<int>(materials_.size()));  // of several of one name the first counts
    materials_.push_back(material_of(material, folders_.size() - 1));
  }
}

std::string ObjMaterialReader::texture_uri(const std::string& name, const ObjMaterial& material) const {
  return as_uri((folders_[material.folder] / name).lexically_normal().generic_string());
}

Json ObjMaterialReader::texture(SceneBuilder& scene, const ObjTexture& texture, const ObjMaterial& material) const {
  return scene.texture(texture_uri(texture.file, material), texture.placement);
}

/// glTF has a colour's opacity in the alpha of its image: the map of another image becomes that.
void ObjMaterialReader::add_opacity(SceneBuilder& scene, const ObjMaterial& material, Json& json) const {
  json["alphaMode"] = "MASK";
  if (material.opacity_map == material.color_map.file) return;
  const auto mask = read_uri(texture_uri(material.opacity_map, material), folder_);
  auto color = material.color_map.file.empty() ? Result<std::vector<uint8_t>>()
                                               : read_uri(texture_uri(material.color_map.file, material), folder_);
  const Result<std::vector<uint8_t>> cut =
      mask && color ? cut_out(*color, *mask, limit_) : fail(mask ? color.error() : mask.error());
  if (cut)
    json["pbrMetallicRoughness"]["baseColorTexture"] = scene.texture(*cut, material.color_map.placement);
  else
    report_.warn("material " + material.name.substr(0, 80) +
                 ": map_d is left out: " + naming_image_option(cut.error()).message());
}

int ObjMaterialReader::add_to(SceneBuilder& scene, size_t index, bool has_texcoords) const {
  const ObjMaterial& material = materials_[index];
  for (size_t i = 0; i < unread_names.size(); i++)
    if ((material.unread >> i & 1) != 0)
      report_.warn(std::string("materials: ") + unread_names[i] +
                   " is not supported and left out; surfaces are diffuse");
  Json json = lambertian_json(
      {.name = material.name, .color = material.color, .emission = material.emission, .double_sided = true});
  if (has_texcoords && !material.color_map.file.empty())
    json["pbrMetallicRoughness"]["baseColorTexture"] = texture(scene, material.color_map, material);
  if (has_texcoords && !material.emission_map.file.empty()) {
    json["emissiveTexture"] = texture(scene, material.emission_map, material);
    // A map without a factor is meant to be seen.
    if (max_component(material.emission) == 0) json["emissiveFactor"] = {1, 1, 1};
  }
  if (!has_texcoords && !(material.color_map.file.empty() && material.opacity_map.empty()))
    report_.warn("material " + material.name.substr(0, 80) + ": its textures are left out where faces have no vt");
  if (material.opacity < 1) {
    json["pbrMetallicRoughness"]["baseColorFactor"][3] = material.opacity;
    json["alphaMode"] = "BLEND";
  }
  if (has_texcoords && !material.opacity_map.empty()) add_opacity(scene, material, json);
  return scene.material(std::move(json));
}

}  // namespace lightwell
