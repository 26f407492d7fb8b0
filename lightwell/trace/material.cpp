// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/material.h"

#include "lightwell/trace/gloss_share.h"
#include "lightwell/trace/sampling.h"
#include "lightwell/trace/texture_lookup.h"

namespace lightwell {
namespace {

Vec3f rgb(const Vec4f& c) { return {{c[0], c[1], c[2]}}; }

/// The reflectance of a dielectric's surface.
struct Coat {
  Vec3f normal{};     ///< at normal incidence
  float grazing = 0;  ///< at grazing angles
};

/// After KHR_materials_specular and KHR_materials_ior, whose defaults are those of a material without them.
Coat coat_of(const Material& material, float specular, const Vec3f& color) {
  const float share = material.specular * specular;
  const float ratio = (material.ior - 1) / (material.ior + 1);
  return {min(material.specular_color * color * (ratio * ratio), Vec3f::filled(1)) * share, share};
}

/// A material at a point, its textures looked up.
struct MaterialPoint {
  Vec3f color{};
  float alpha = 1;
  Vec3f emission{};
  float metallic = 0, roughness = 1, transmission = 0;
  Coat coat;

  /// Of light that alpha covers, what goes straight on at a cosine to the normal. Transmission replaces only the
  /// diffuse part of the dielectric (KHR_materials_transmission): of what its gloss lets in.
  Vec3f passing(float cosine) const {
    if (transmission <= 0) return {};
    const float reflected =
        coat.grazing > 0 ? gloss_share(cosine, roughness).of(max_component(coat.normal), coat.grazing) : 0.0f;
    return color * ((1 - metallic) * transmission * (1 - reflected));
  }

  /// The BSDF of the share of light that does not go straight on.
  Bsdf bsdf(float stopped) const {
    const float dielectric = 1 - metallic;
    Bsdf result{.roughness = roughness, .coat = max_component(coat.normal), .coat_grazing = coat.grazing};
    if (stopped <= 0) return result;
    result.diffuse = color * (dielectric * (1 - transmission) / stopped);
    result.gloss = (coat.normal * dielectric + color * metallic) / stopped;
    result.grazing = (coat.grazing * dielectric + metallic) / stopped;
    if (metallic > 0) result.repeated = repeated_reflectance(color, roughness) * (metallic / stopped);
    return result;
  }
};

MaterialPoint look_up(const Material& material, const std::vector<Image>& images, const std::array<Vec2f, 2>& texcoords,
                      const Vec4f& vertex_color) {
  const auto read = [&](const TextureLookup& texture, bool srgb) { return look_up(texture, images, texcoords, srgb); };
  const Vec4f base = material.base_color * vertex_color * read(material.base_color_texture, true);
  const Vec4f metal_rough = read(material.metallic_roughness_texture, false);
  return {.color = min(max(rgb(base), Vec3f{}), Vec3f::filled(1)),
          .alpha = base[3],
          .emission = material.emission * rgb(read(material.emission_texture, true)),
          .metallic = std::clamp(material.metallic * metal_rough[2], 0.0f, 1.0f),
          .roughness = std::clamp(material.roughness * metal_rough[1], 0.0f, 1.0f),
          .transmission = material.transmission * read(material.transmission_texture, false)[0],
          .coat = coat_of(material, read(material.specular_texture, false)[3],
                          rgb(read(material.specular_color_texture, true)))};
}

float covered(const Material& material, float alpha) {
  switch (material.alpha) {
    case Material::Alpha::opaque: break;
    case Material::Alpha::mask: return alpha >= material.alpha_cutoff ? 1.0f : 0.0f;
    case Material::Alpha::blend: return std::clamp(alpha, 0.0f, 1.0f);
  }
  return 1;
}

}  // namespace

Surface surface_of(const Material& material, const std::vector<Image>& images, const std::array<Vec2f, 2>& texcoords,
                   const Vec4f& vertex_color, float cosine) {
  const MaterialPoint point = look_up(material, images, texcoords, vertex_color);
  // Chance lets all colours pass together, in their mean; the tint has the rest of what they differ in.
  const Vec3f passing = point.passing(cosine);
  const float stopped = 1 - mean_of_channels(passing), alpha = covered(material, point.alpha);
  Surface surface{.bsdf = point.bsdf(stopped), .emission = point.emission, .coverage = alpha * stopped};
  if (surface.coverage == 1) return surface;
  const Vec3f past = Vec3f::filled(1 - alpha) + passing * alpha;
  surface.tint = past / mean_of_channels(past);
  // Gloss stops more of the rays at an angle, for which what shines is none the brighter.
  if (stopped > 0) surface.emission *= (1 - mean_of_channels(point.passing(1))) / stopped;
  if (!surface.bsdf.glossy() && max_component(surface.bsdf.diffuse + surface.emission) <= 0) {
    // Where nothing comes back, chance would only add noise.
    surface.tint = past;
    surface.coverage = 0;
  }
  return surface;
}

bool varies(const Material& material) {
  const auto present = [](const TextureLookup& texture) { return texture.image >= 0; };
  const bool clear = material.transmission > 0 && material.specular > 0;
  return clear || present(material.base_color_texture) || present(material.emission_texture) ||
         present(material.metallic_roughness_texture) || present(material.transmission_texture) ||
         present(material.specular_texture) || present(material.specular_color_texture);
}

bool lets_light_pass(const Material& material) {
  return material.alpha != Material::Alpha::opaque || material.transmission > 0;
}

bool tints_light(const Material& material) { return material.transmission > 0; }

}  // namespace lightwell
