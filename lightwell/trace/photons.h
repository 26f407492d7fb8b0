// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/trace/world.h"

namespace lightwell {

/// A straight piece of a photon's way.
struct Flight {
  Vec3f origin{};
  Vec3f direction{};       ///< unit
  float length = 0;        ///< metres; infinite when it leaves the scene
  Vec3f flux{};            ///< W
  int bounces = 0;         ///< reflections so far
  int luminaire = 0;       ///< where the photon comes from
  bool from_back = false;  ///< it starts at the back of a surface that is not double-sided
};

/// One photon's way through a scene, flight by flight: `while (walk.next(flight)) …`. It is reflected by chance, with
/// the probability by which its strongest colour is dimmed (Russian roulette), and carries three colours. Photon
/// `index` of `seed` flies the same way whichever thread traces it. Its flux is that of one photon: divide by how many
/// are traced.
class PhotonWalk {
 public:
  PhotonWalk(const World& world, uint64_t seed, uint64_t index);
  /// The next flight; false when the photon is absorbed or gone.
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
