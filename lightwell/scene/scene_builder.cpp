// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/scene_builder.h"

#include <algorithm>

#include "lightwell/scene/camera.h"

namespace lightwell {
namespace {

Json to_json(const Vec3f& v) { return {v[0], v[1], v[2]}; }

}  // namespace

std::string as_uri(const std::string& path) {
  constexpr char digits[] = "0123456789ABCDEF";
  std::string uri;
  for (const char c : path) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) || std::string_view("-._~/").find(c) != std::string_view::npos) {
      uri += c;
    } else if (c == '\\') {
      uri += '/';
    } else {
      uri += {'%', digits[byte >> 4], digits[byte & 15]};
    }
  }
  return uri;
}

Json lambertian_json(const Lambertian& material) {
  const Vec3f& color = material.color;
  Json json = {
      {"name", material.name},
      {"pbrMetallicRoughness",
       {{"baseColorFactor", {color[0], color[1], color[2], 1}}, {"metallicFactor", 0}, {"roughnessFactor", 1}}},
      {"extensions", {{"KHR_materials_specular", {{"specularFactor", 0}}}}}};
  const float brightest = max_component(material.emission);
  if (brightest > 0) json["emissiveFactor"] = to_json(material.emission / std::max(brightest, 1.0f));
  if (brightest > 1) json["extensions"]["KHR_materials_emissive_strength"] = {{"emissiveStrength", brightest}};
  if (material.double_sided) json["doubleSided"] = true;
  return json;
}

int SceneBuilder::material(Json material) {
  for (const auto& extension : member(material, "extensions").items()) use_extension(extension.key());
  return builder_.add("materials", std::move(material));
}

Json SceneBuilder::texture(const std::string& uri, const TexturePlacement& placement) {
  const auto [known, added] = images_.try_emplace(uri, -1);
  if (added) known->second = builder_.add("images", {{"uri", uri}});
  return texture_of(known->second, placement);
}

Json SceneBuilder::texture(const std::vector<uint8_t>& png, const TexturePlacement& placement) {
  const int view = builder_.buffer_view(png);
  return texture_of(builder_.add("images", {{"bufferView", view}, {"mimeType", "image/png"}}), placement);
}

Json SceneBuilder::texture_of(int image, const TexturePlacement& placement) {
  const auto [known, added] = textures_.try_emplace({image, placement.clamped}, -1);
  if (added) {
    constexpr int clamp_to_edge = 33071;
    Json texture{{"source", image}};
    if (placement.clamped)
      texture["sampler"] = builder_.add("samplers", {{"wrapS", clamp_to_edge}, {"wrapT", clamp_to_edge}});
    known->second = builder_.add("textures", std::move(texture));
  }
  Json used{{"index", known->second}};
  const auto& [offset, scale, clamped] = placement;
  if (offset == Vec2f{} && scale == Vec2f::filled(1)) return used;
  use_extension("KHR_texture_transform");
  // glTF's v points down.
  used["extensions"]["KHR_texture_transform"] = {{"offset", {offset[0], 1 - scale[1] - offset[1]}},
                                                 {"scale", {scale[0], scale[1]}}};
  return used;
}

Json SceneBuilder::primitive(const Part& part) {
  Json primitive = builder_.primitive(part.mesh);
  primitive["material"] = part.material;
  return primitive;
}

void SceneBuilder::object(const std::string& name, const std::vector<Part>& parts, const Vec3d& origin) {
  Json primitives = Json::array();
  for (const Part& part : parts) primitives.push_back(primitive(part));
  object_of(name, std::move(primitives), origin);
}

void SceneBuilder::object_of(const std::string& name, Json primitives, const Vec3d& origin) {
  Json shown = {{"name", name},
                {"mesh", builder_.add("meshes", {{"name", name}, {"primitives", std::move(primitives)}})}};
  if (origin != Vec3d{}) shown["translation"] = origin.e;
  node(std::move(shown));
}

void SceneBuilder::camera(const std::string& name, const Vec3d& eye, const Vec3d& target, double yfov, int width,
                          int height) {
  Camera camera;
  camera.name = name;
  camera.to_scene = looking_at(eye, target);
  camera.yfov = static_cast<float>(yfov);
  camera.aspect = static_cast<float>(width) / static_cast<float>(height);
  camera.width = width;
  camera.height = height;
  show();
  add_camera(document_, camera, 0.01f);
}

void SceneBuilder::use_extension(const std::string& name) {
  Json& used = document_.json["extensionsUsed"];
  if (std::find(used.begin(), used.end(), name) == used.end()) used.push_back(name);
}

void SceneBuilder::show() {
  document_.json["scene"] = 0;
  Json& scenes = document_.json["scenes"];
  if (scenes.empty()) scenes.push_back({{"nodes", Json::array()}});
}

void SceneBuilder::node(Json node) {
  show();
  document_.json["scenes"][0]["nodes"].push_back(builder_.add("nodes", std::move(node)));
}

}  // namespace lightwell
