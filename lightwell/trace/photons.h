// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/trace/world.h"

namespace lightwell {

/// A straight segment of a photon's path.
struct Flight {
  Vec3f origin{};
  Vec3f direction{};       ///< unit
  float length = 0;        ///< metres; infinite when it leaves the scene
  Vec3f flux{};            ///< W
  int bounces = 0;         ///< reflections so far
  int luminaire = 0;       ///< that emitted the photon
  bool from_back = false;  ///< it starts at the back of a surface that is not double-sided
};

/// One photon's path through a scene, flight by flight: `while (walk.next(flight)) …`. A photon carries three colours
/// and survives a reflection with the probability by which its strongest colour is dimmed (Russian roulette). Photon
/// `index` of `seed` takes the same path whichever thread traces it. Its flux is that of a single photon: divide by the
/// number traced.
class PhotonWalk {
 public:
  PhotonWalk(const World& world, uint64_t seed, uint64_t index);
  /// Replaces `flight`, which must hold the last one, by the next; false when the photon is absorbed or has left the
  /// scene.
  bool next(Flight& flight);
  /// Where the last flight ended; null when it did not meet a surface.
  const Hit* end() const { return at_surface_ ? &hit_ : nullptr; }

 private:
  bool reflect(Flight& flight);

  const TraceScene& surfaces_;
  const Lights& lights_;
  Random random_;
  Hit hit_;
  bool at_surface_ = false;
  bool started_ = false;
};

}  // namespace lightwell
