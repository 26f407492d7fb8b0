// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/base/random.h"
#include "lightwell/base/vector.h"

namespace lightwell {

/// The reflection at a point of a surface, as glTF's metallic-roughness model has it: a diffuse part under the gloss of
/// a dielectric, and a metal, both with GGX facets of one roughness and Schlick's Fresnel term. It is reciprocal, and
/// white reflects all that arrives: what the gloss of the dielectric does not reflect reaches the diffuse part
/// (Kelemen and Szirmay-Kalos, A Microfacet Based Coupled Specular-Matte BRDF Model, Eurographics 2001), and what
/// metallic facets send to each other leaves them in the end (Kulla and Conty, Revisiting Physically Based Shading at
/// Imageworks, SIGGRAPH 2017). Directions are unit vectors that point away from the surface, both on the normal's side;
/// the value is 0 for any other `in`.
struct Bsdf {
  Vec3f diffuse{};         ///< albedo of the diffuse part, of light that reaches it
  Vec3f gloss{};           ///< reflectance of the facets at normal incidence
  float grazing = 0;       ///< the same at grazing angles, all colours
  Vec3f repeated{};        ///< albedo for light that facets pass to each other
  float roughness = 1;     ///< perceptual; the facets' alpha is its square
  float coat = 0;          ///< of the dielectric alone, which covers the diffuse part: like gloss, all colours ...
  float coat_grazing = 0;  ///< ... and like grazing

  static Bsdf lambertian(const Vec3f& albedo) { return {.diffuse = albedo}; }
  bool glossy() const { return grazing > 0 || max_component(gloss) > 0; }

  /// What goes to a direction of light that arrives from all directions alike, by its ways.
  struct Albedo {
    Vec3f diffuse{}, gloss{}, repeated{};

    Vec3f total() const { return diffuse + gloss + repeated; }
  };
  /// Given the cosine of the direction to the normal.
  Albedo albedo(float cosine) const;
  /// Whether the gloss is so rough and so weak that it is as good as diffuse where the light of many rays is summed up:
  /// it spreads light nearly as far, and rays for it would change the sum by less than their noise.
  bool nearly_diffuse(const Albedo& albedo) const {
    constexpr float rough = 0.5f, weak = 0.1f;
    return roughness >= rough && max_component(albedo.gloss + albedo.repeated) <= weak;
  }

  struct Evaluation {
    Vec3f value{};      ///< of the BSDF, 1/sr
    float density = 0;  ///< with which sample() chooses `in`, 1/sr
  };
  Evaluation evaluate(const Vec3f& normal, const Vec3f& out, const Vec3f& in) const;
  /// The part of the value that is no mirror image: what is diffuse, and what facets pass to each other. It depends on
  /// the cosines of both directions to the normal alone, and only a little.
  Vec3f value_without_facets(float cos_out, float cos_in) const;
  /// The other part: what is met by facets once.
  Bsdf facets_alone() const;

  struct Sample {
    Vec3f in{};
    Vec3f weight{};  ///< value * cosine / density; 0 when the direction is below the surface
    float density = 0;
  };
  Sample sample(const Vec3f& normal, const Vec3f& out, Random& random) const;
};

/// Bsdf::repeated for facets of a reflectance at normal incidence that reflect everything at grazing angles.
Vec3f repeated_reflectance(const Vec3f& gloss, float roughness);

}  // namespace lightwell
