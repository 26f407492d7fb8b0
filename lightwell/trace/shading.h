// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/trace/bsdf.h"

namespace lightwell {

/// The reflection at a point of a surface whose normal for shading, interpolated or from a normal map, leans away from
/// its geometric one. No energy is lost: what the BSDF around the shading normal would reflect into the surface is
/// folded up again, as if the surface's plane were a mirror. Both normals are unit and on the side of `out`; see
/// facing().
struct Shading {
  Bsdf bsdf;
  Vec3f normal{};          ///< geometric
  Vec3f shading_normal{};  ///< may be the same
  Vec3f out{};             ///< unit, towards the viewer

  struct Evaluation {
    Vec3f reflectance{};  ///< the BSDF's value times the cosine to the shading normal, 1/sr
    float density = 0;    ///< with which sample() chooses the direction, 1/sr
  };
  /// For light that arrives from a unit direction; nothing from below the surface.
  Evaluation evaluate(const Vec3f& in) const;
  /// Its `in` is above the surface, or the weight is 0.
  Bsdf::Sample sample(Random& random) const;
};

/// The normal turned just so far that whoever looks from `out` sees its side.
Vec3f facing(const Vec3f& shading_normal, const Vec3f& out);

}  // namespace lightwell
