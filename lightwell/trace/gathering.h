// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "lightwell/trace/world.h"

namespace lightwell {

/// What a ray sees: the diffuse surfaces at its end, straight or by way of gloss, whose own light is still to be found
/// out; and light that is known.
struct Gathering {
  /// A point of a surface that reflects diffusely: it sends albedo / pi times its irradiance.
  struct Diffuse {
    Vec3f position{};
    Vec3f facing{};     ///< unit normal on the side that is seen
    Vec3f albedo{};     ///< less what surfaces on the way keep
    uint64_t cell = 0;  ///< of a surface cache: see SurfaceCache::find_cells()
  };
  static constexpr size_t most_diffuse = 8;

  std::array<Diffuse, most_diffuse> diffuse;
  size_t diffuse_count = 0;
  Vec3f mirrored{};  ///< W/m2/sr, of luminaires by way of gloss and near surfaces
  Vec3f emitted{};   ///< W/m2/sr, of the luminaire that the ray meets first
  int luminaire = -1;
  bool meets_surface = false;
  Hit first;  ///< where it does
  int rays = 0;
};

/// Follows a ray. Gloss is followed by one sample of its lobe, and one of the luminaires, weighted by the power
/// heuristic, as often as it reflects. So are all surfaces at which the ray arrives after less than `near` metres: a
/// cache does not know their light well, since its cells are larger than what lies between.
Gathering gather(const World& world, Ray ray, float near, Random& random);

}  // namespace lightwell
