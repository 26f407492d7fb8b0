// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "lightwell/base/vector.h"
#include "lightwell/scene/luminaire_id.h"

namespace lightwell {

/// A lamp that a client lights and shadows by itself (LIGHTWELL_lamps of docs/format.md): a simple shape that stands
/// for a luminaire of the scene. All in scene space.
struct ClientLamp {
  enum class Kind { rectangle, disc, sphere, point, spot, sun };

  Kind kind = Kind::point;
  std::string name;
  std::string group;                     ///< that it is switched with; empty: none
  Vec3f center{};                        ///< metres; not for a sun
  Vec3f normal{{0, -1, 0}};              ///< unit: where a rectangle or disc faces, a spot points, a sun's light goes
  Vec3f half_u{}, half_v{};              ///< of a rectangle: from its centre to the middle of two sides, metres
  float radius = 0;                      ///< of a disc or sphere, metres
  Vec3f radiance{};                      ///< of a rectangle, disc or sphere, W/m2/sr
  Vec3f intensity{};                     ///< of a point or spot W/sr; of a sun the irradiance facing it, W/m2
  float range = 0;                       ///< metres, of a point or spot; 0: unlimited
  float inner_cone = 0, outer_cone = 0;  ///< radians from the axis, of a spot
  bool two_sided = false;                ///< a rectangle or disc that shines to both sides
  float power = 0;                       ///< W, mean of the channels; what lamps are ranked by
  LuminaireId luminaire;                 ///< that it stands for

  bool operator==(const ClientLamp&) const = default;
};

struct Lamp;

/// A lamp without extent of a scene; what luminaire it is and its power are left to the caller.
ClientLamp describe_lamp(const Lamp& source);

/// The inverse; the lamp must be a point, a spot or a sun.
Lamp punctual_lamp(const ClientLamp& lamp);

}  // namespace lightwell
