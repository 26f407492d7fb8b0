// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/base/random.h"
#include "lightwell/scene/scene.h"

namespace lightwell {

/// The reflection at a point of a surface: a Lambertian part and, for metals, a rough GGX lobe (Walter et al.,
/// Microfacet Models for Refraction through Rough Surfaces, EGSR 2007) with Schlick's Fresnel term, mixed by glTF's
/// metallic factor. It reflects no more light than arrives. The weak gloss of dielectrics is left out: their albedo is
/// all diffuse, which is exact for KHR_materials_specular with a factor of 0. Directions are unit vectors that point
/// away from the surface, both on the normal's side; the value is 0 for any other `in`.
struct Bsdf {
  Vec3f diffuse{};      ///< albedo of the Lambertian part
  Vec3f metal{};        ///< reflectance of the metallic part at normal incidence
  float metallic = 0;   ///< share of the metallic part: its reflectance at grazing angles
  float roughness = 1;  ///< perceptual; the lobe's alpha is its square

  static Bsdf lambertian(const Vec3f& albedo) { return {.diffuse = albedo}; }

  /// The value of the BSDF, 1/sr.
  Vec3f value(const Vec3f& normal, const Vec3f& out, const Vec3f& in) const;
  /// The density with which sample() chooses `in`, 1/sr.
  float density(const Vec3f& normal, const Vec3f& out, const Vec3f& in) const;

  struct Sample {
    Vec3f in{};
    Vec3f weight{};  ///< value * cosine / density; 0 when the direction is below the surface
    float density = 0;
  };
  Sample sample(const Vec3f& normal, const Vec3f& out, Random& random) const;

 private:
  float diffuse_share() const;
};

/// The material at a point of a surface.
struct Surface {
  Bsdf bsdf;         ///< of the light that does not pass straight through
  Vec3f emission{};  ///< radiance of the front, W/m2/sr
  /// The share of light that does not pass straight through (alpha, transmission), all colours; 0 where nothing of it
  /// would be reflected.
  float coverage = 1;
  /// What passes of each colour, for one that passes on the average of them: a green pane has more than 1 of green.
  Vec3f tint = Vec3f::filled(1);
};

/// Evaluates a material at texture coordinates (the mesh's two sets) and a vertex colour. Light that
/// KHR_materials_transmission lets through goes straight on, as through a thin pane, instead of being reflected by the
/// dielectric's diffuse part (docs/decisions/018-transmission.md).
Surface surface_of(const Material& material, const std::vector<Image>& images, const std::array<Vec2f, 2>& texcoords,
                   const Vec4f& vertex_color);

/// True when some point of the material may have a coverage below 1.
bool lets_light_pass(const Material& material);
/// True when what passes may have another colour than what arrives.
bool tints_light(const Material& material);

}  // namespace lightwell
