// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/scene/scene.h"
#include "lightwell/trace/bsdf.h"

namespace lightwell {

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

/// Evaluates a material at texture coordinates (the mesh's two sets) and a vertex colour, for a ray whose direction has
/// this cosine to the normal. Light that KHR_materials_transmission lets through goes straight on, as through a thin
/// pane, instead of being reflected by the dielectric's diffuse part (docs/decisions/018-transmission.md).
Surface surface_of(const Material& material, const std::vector<Image>& images, const std::array<Vec2f, 2>& texcoords,
                   const Vec4f& vertex_color, float cosine = 1);

/// True when the material may differ with texture coordinates, or with the direction of a ray.
bool varies(const Material& material);
/// True when some point of the material may have a coverage below 1.
bool lets_light_pass(const Material& material);
/// True when what passes may have another colour than what arrives.
bool tints_light(const Material& material);

}  // namespace lightwell
