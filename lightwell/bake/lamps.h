// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "lightwell/scene/scene.h"

namespace lightwell {

/// A lamp that a client lights and shadows by itself (LIGHTWELL_lamps of docs/format.md): a simple shape that stands for an
/// emissive instance or a punctual lamp of the scene. All in scene space.
struct ClientLamp {
  enum class Kind { rectangle, sphere, point, spot, sun };

  Kind kind = Kind::point;
  std::string name;
  Vec3f center{};               ///< metres; not for a sun
  Vec3f normal{{0, -1, 0}};     ///< unit: where a rectangle faces, a spot points, a sun's light goes
  Vec3f half_u{}, half_v{};     ///< of a rectangle: from its centre to the middle of two sides, metres
  float radius = 0;             ///< of a sphere, metres
  Vec3f radiance{};             ///< of a rectangle or sphere, W/m2/sr
  Vec3f intensity{};            ///< of a point or spot W/sr; of a sun the irradiance facing it, W/m2
  float range = 0;              ///< metres, of a point or spot; 0: unlimited
  float inner_cone = 0, outer_cone = 0;  ///< radians from the axis, of a spot
  bool two_sided = false;       ///< a rectangle that shines to both sides
  float power = 0;              ///< W, mean of the channels; what lamps are ranked by
  int instance = -1;            ///< the emissive instance of the scene it stands for, or
  int lamp = -1;                ///< the punctual lamp
  int node = -1;                ///< of the scene's document
};

/// Who lights what: the light of the client's lamps is bounced into the grid only; the light of the others, which the client
/// does not know, goes into the grid from its first flight on, so that no light is missing or counted twice.
struct LampPlan {
  std::vector<ClientLamp> client;    ///< the strongest first
  std::vector<int> grid_instances;   ///< emissive instances whose direct light the grid holds
  std::vector<int> grid_lamps;       ///< punctual lamps whose direct light the grid holds
};

/// Splits the scene's emitters: the `most` strongest that a rectangle, a sphere or a punctual lamp describes are the
/// client's. An emissive instance is a rectangle when its faces lie in one plane, a sphere when nearly all of them look away
/// from their common centre; one of any other form is the grid's.
LampPlan plan_lamps(const Scene& scene, size_t most = 16);

}  // namespace lightwell
