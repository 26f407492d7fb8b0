// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/import_gltf_material.h"

#include <array>
#include <cmath>

#include "lightwell/texture/image_file.h"

namespace lightwell {
namespace {

/// The most pixels that all images of a scene may have together.
constexpr uint64_t max_pixels = uint64_t(1) << 31;

// Beyond these a factor changes nothing that can be seen.
constexpr float largest_specular_color = 1e6f, largest_ior = 1e6f;
constexpr double largest_scale = 1e6;

/// Extensions of materials that change how a surface looks in ways that are not followed. They are kept in a pack, so
/// that a page may show them.
constexpr std::array ignored_extensions = std::to_array<const char*>(
    {"KHR_materials_anisotropy", "KHR_materials_clearcoat", "KHR_materials_diffuse_transmission",
     "KHR_materials_dispersion", "KHR_materials_iridescence", "KHR_materials_pbrSpecularGlossiness",
     "KHR_materials_sheen", "KHR_materials_volume"});

TextureLookup::Wrap wrap_mode(const Json& sampler, const char* key) {
  switch (index_of(sampler, key)) {
    case 33071: return TextureLookup::Wrap::clamp;
    case 33648: return TextureLookup::Wrap::mirror;
    default: return TextureLookup::Wrap::repeat;
  }
}

/// KHR_texture_transform: scaled, turned counter-clockwise where v points up, then moved.
void apply_transform(const Json& transform, TextureLookup& lookup) {
  const auto offset = numbers<2>(transform, "offset", {{0, 0}});
  const auto scale = numbers<2>(transform, "scale", {{1, 1}});
  const double angle = number(transform, "rotation", 0);
  const double c = std::cos(angle), s = std::sin(angle);
  lookup.row_u = {static_cast<float>(c * scale[0]), static_cast<float>(s * scale[1]), static_cast<float>(offset[0])};
  lookup.row_v = {static_cast<float>(-s * scale[0]), static_cast<float>(c * scale[1]), static_cast<float>(offset[1])};
  if (const int texcoord = index_of(transform, "texCoord"); texcoord >= 0) lookup.texcoord = texcoord;
}

/// Reads one material; notes whether a factor had to be clamped.
class MaterialReader {
 public:
  MaterialReader(const Json& document, const Json& json, std::string name, Report& report)
      : document_(document), json_(json), name_(std::move(name)), report_(report) {}

  Material read() {
    Material material;
    material.name = text(json_, "name");
    read_surface(material);
    read_emission(material);
    const std::string mode = text(json_, "alphaMode");
    if (mode == "MASK") material.alpha = Material::Alpha::mask;
    if (mode == "BLEND") material.alpha = Material::Alpha::blend;
    material.alpha_cutoff = factor(json_, "alphaCutoff", 0.5f, 1e6f);
    material.double_sided = boolean(json_, "doubleSided", false);
    if (clamped_) report_.warn(name_ + ": factors outside their range were clamped");
    return material;
  }

 private:
  void read_surface(Material& material) {
    const Json& surface = member(json_, "pbrMetallicRoughness");
    material.base_color = factors<4>(surface, "baseColorFactor", 1);
    material.base_color_texture = lookup(member(surface, "baseColorTexture"));
    material.metallic = factor(surface, "metallicFactor", 1, 1);
    material.roughness = factor(surface, "roughnessFactor", 1, 1);
    material.metallic_roughness_texture = lookup(member(surface, "metallicRoughnessTexture"));
    const Json& normal = member(json_, "normalTexture");
    material.normal_texture = lookup(normal);
    material.normal_scale = static_cast<float>(std::clamp(number(normal, "scale", 1), -largest_scale, largest_scale));
    const Json& transmission = extension(json_, "KHR_materials_transmission");
    material.transmission = factor(transmission, "transmissionFactor", 0, 1);
    material.transmission_texture = lookup(member(transmission, "transmissionTexture"));
    read_gloss(material);
    if (extension(json_, "KHR_materials_unlit").is_object()) make_diffuse(material);
  }

  void read_gloss(Material& material) {
    const Json& specular = extension(json_, "KHR_materials_specular");
    material.specular = factor(specular, "specularFactor", 1, 1);
    material.specular_texture = lookup(member(specular, "specularTexture"));
    material.specular_color = factors<3>(specular, "specularColorFactor", 1, largest_specular_color);
    material.specular_color_texture = lookup(member(specular, "specularColorTexture"));
    material.ior = factor(extension(json_, "KHR_materials_ior"), "ior", 1.5f, largest_ior);
  }

  /// An unlit surface shows its colour without light; for the light around it, it is a diffuse one of that colour.
  static void make_diffuse(Material& material) {
    material.unlit = true;
    material.metallic = 0;
    material.roughness = 1;
    material.metallic_roughness_texture = {};
    material.specular = 0;
    material.normal_texture = {};
  }

  void read_emission(Material& material) {
    constexpr float largest_strength = 1e12f;
    const float strength =
        factor(extension(json_, "KHR_materials_emissive_strength"), "emissiveStrength", 1, largest_strength);
    material.emission = factors<3>(json_, "emissiveFactor", 0) * strength;
    material.emission_texture = lookup(member(json_, "emissiveTexture"));
  }

  float clamp(double value, float largest) {
    const double inside = std::clamp(value, 0.0, static_cast<double>(largest));
    clamped_ |= inside != value;
    return static_cast<float>(inside);
  }

  float factor(const Json& object, const char* key, float fallback, float largest) {
    return clamp(number(object, key, fallback), largest);
  }

  template <int N>
  Vec<float, N> factors(const Json& object, const char* key, float fallback, float largest = 1) {
    const auto values = numbers<N>(object, key, Vec<double, N>::filled(fallback));
    Vec<float, N> result;
    for (int i = 0; i < N; i++) result[i] = clamp(values[i], largest);
    return result;
  }

  TextureLookup lookup(const Json& info) {
    TextureLookup lookup;
    const int index = index_of(info, "index");
    if (index < 0) return lookup;
    const Json& texture = element(member(document_, "textures"), static_cast<size_t>(index));
    const int sampler_index = index_of(texture, "sampler");
    const Json& sampler = element(member(document_, "samplers"), static_cast<size_t>(sampler_index));
    lookup.texcoord = std::max(0, index_of(info, "texCoord"));
    lookup.wrap_u = wrap_mode(sampler, "wrapS");
    lookup.wrap_v = wrap_mode(sampler, "wrapT");
    apply_transform(extension(info, "KHR_texture_transform"), lookup);
    if (lookup.texcoord > 1) {
      report_.warn(name_ + ": texture coordinates beyond TEXCOORD_1 are not read, TEXCOORD_0 is taken");
      lookup.texcoord = 0;
    }
    lookup.image = image_of(texture);
    return lookup;
  }

  const Json& document_;
  const Json& json_;
  const std::string name_;
  Report& report_;
  bool clamped_ = false;
};

Result<Image> decode_image(const Document& document, int index, ImageLimit limit) {
  LW_TRY(bytes, read_image(document, index));
  const std::string name = element_name("images", static_cast<size_t>(index));
  auto image = read_image_file(bytes, limit);
  if (!image) return fail(in_element(naming_image_option(image.error()), name));
  return image;
}

/// One warning for each extension that is not followed, by the first material that has it.
void warn_of_ignored_extensions(const Json& materials, Report& report) {
  for (const char* ignored : ignored_extensions) {
    std::string first;
    size_t count = 0;
    for (size_t i = 0; i < materials.size(); i++) {
      if (!extension(materials[i], ignored).is_object() || count++ > 0) continue;
      first = element_name("materials", i);
      if (const std::string name = text(materials[i], "name"); !name.empty()) first += " \"" + name.substr(0, 80) + '"';
    }
    if (count > 1) first += " and " + std::to_string(count - 1) + " more";
    if (count > 0) report.warn(first + ": " + ignored + " is ignored; the light is that without it");
  }
}

}  // namespace

int image_of(const Json& texture) {
  for (const char* name : {"EXT_texture_webp", "", "KHR_texture_basisu", "EXT_texture_avif"}) {
    const int source = index_of(*name ? extension(texture, name) : texture, "source");
    if (source >= 0) return source;
  }
  return -1;
}

std::vector<bool> read_by_textures(const Json& document) {
  std::vector<bool> read(member(document, "images").size(), false);
  for (const Json& texture : member(document, "textures"))
    if (const auto image = static_cast<size_t>(image_of(texture)); image < read.size()) read[image] = true;
  return read;
}

std::vector<Material> read_materials(const Json& document, Report& report) {
  std::vector<Material> materials;
  const Json& array = member(document, "materials");
  for (size_t i = 0; i < array.size(); i++)
    materials.push_back(MaterialReader(document, array[i], element_name("materials", i), report).read());
  warn_of_ignored_extensions(array, report);
  return materials;
}

std::vector<Image> read_images(const Document& document, ImageLimit limit, Report& report) {
  const Image white{1, 1, 3, {255, 255, 255}};
  const std::vector<bool> read = read_by_textures(document.json);
  std::vector<Image> images(read.size(), white);
  uint64_t pixels = 0;
  for (size_t i = 0; i < images.size(); i++) {
    if (!read[i]) continue;
    auto image = decode_image(document, static_cast<int>(i), limit);
    if (image) pixels += uint64_t(static_cast<uint32_t>(image->width)) * static_cast<uint32_t>(image->height);
    if (image && pixels > max_pixels)
      image = fail(ErrorKind::limit, element_name("images", i), "too many pixels in all images together");
    if (image)
      images[i] = std::move(*image);
    else
      report.warn(image.error().message() + "; a white pixel stands for it");
  }
  return images;
}

}  // namespace lightwell
