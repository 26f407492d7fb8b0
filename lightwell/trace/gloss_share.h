// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace lightwell {

/// What GGX facets, each met once, reflect of light from all directions alike: reflectance at normal incidence times
/// `normal` plus reflectance at grazing angles times `grazing` (Karis, Real Shading in Unreal Engine 4, SIGGRAPH 2013).
/// Facets that reflected everything would lose 1 - all() to each other.
struct GlossShare {
  float normal = 0;
  float grazing = 0;

  float of(float at_normal, float at_grazing) const { return at_normal * normal + at_grazing * grazing; }
  float all() const { return normal + grazing; }
};

/// The share that goes to a direction, given its cosine to the normal, for glTF's perceptual roughness. From a table,
/// within 0.003 of the integral.
GlossShare gloss_share(float cosine, float roughness);

/// The mean of gloss_share() over the hemisphere, weighted by the cosine.
GlossShare mean_gloss_share(float roughness);

}  // namespace lightwell
