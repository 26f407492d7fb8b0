// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "lightwell/trace/world.h"

namespace lightwell {

/// A rectangle of a flat emissive surface, along two axes in its plane.
struct ShiningPart {
  Vec3f center{};     ///< scene space
  Vec2f half_size{};  ///< along the two axes, metres; its area is that of the surface which it stands for
  Vec3f radiance{};   ///< mean over that, W/m2/sr
};

/// Cuts a flat surface whose emission varies (a screen, a window that is a picture) into the rectangles that shine:
/// what is dark is left out, and where the radiance differs it is divided again, the part that errs most first, until
/// the rest of the variance is small or there are `most` of them. Together they have the power of the surface. `u` and
/// `v` are unit vectors, perpendicular, in its plane. Empty when nothing shines.
std::vector<ShiningPart> shining_parts(const TraceScene& scene, const Luminaire& luminaire, const Vec3f& u,
                                       const Vec3f& v, size_t most);

}  // namespace lightwell
