// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "lightwell/trace/sampling.h"

namespace lightwell {

// Facets of a rough surface whose normals have the GGX distribution (Walter et al., Microfacet Models for Refraction
// through Rough Surfaces, EGSR 2007). `alpha` is the distribution's width; cosines are to the surface's normal.

/// The width for glTF's perceptual roughness. A perfect mirror is treated as very smooth, so that it can be sampled
/// like everything else.
inline float ggx_alpha(float roughness) { return std::max(roughness * roughness, 0.02f); }

/// The distribution of the facets' normals, 1/sr.
inline float ggx_facets(float cosine, float alpha) {
  const float a2 = alpha * alpha;
  const float d = cosine * cosine * (a2 - 1) + 1;
  return a2 / (pi * d * d);
}

/// Smith's Lambda: the area of hidden facets per visible one.
inline float ggx_hidden(float cosine, float alpha) {
  const float c2 = cosine * cosine;
  return (std::sqrt(1 + alpha * alpha * (1 - c2) / c2) - 1) / 2;
}

/// The normal of a facet visible from `out`, in the frame whose z is the surface's normal. A uniform point of the unit
/// disc chooses it in proportion to its visible area (Heitz, Sampling the GGX Distribution of Visible Normals, JCGT
/// 2018).
inline Vec3f ggx_visible_facet(const Vec3f& out, float alpha, const Vec3f& disc) {
  const Vec3f stretched = normalized(Vec3f{{alpha * out[0], alpha * out[1], out[2]}});
  const float across = stretched[0] * stretched[0] + stretched[1] * stretched[1];
  const Vec3f t1 = across > 0 ? Vec3f{{-stretched[1], stretched[0], 0}} / std::sqrt(across) : Vec3f{{1, 0, 0}};
  const Vec3f t2 = cross(stretched, t1);
  const float s = (1 + stretched[2]) / 2;
  const float p2 = (1 - s) * std::sqrt(std::max(0.0f, 1 - disc[0] * disc[0])) + s * disc[1];
  const float p3 = std::sqrt(std::max(0.0f, 1 - disc[0] * disc[0] - p2 * p2));
  const Vec3f facet = t1 * disc[0] + t2 * p2 + stretched * p3;
  return normalized(Vec3f{{alpha * facet[0], alpha * facet[1], std::max(0.0f, facet[2])}});
}

/// Schlick's Fresnel term at a cosine to the facet: the share of the reflectance at grazing angles, the rest is that at
/// normal incidence.
inline float schlick_grazing(float cosine) {
  const float x = 1 - std::min(1.0f, cosine), x2 = x * x;
  return x2 * x2 * x;
}

}  // namespace lightwell
