// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "lightwell/trace/environment.h"
#include "lightwell/trace/light_region.h"
#include "lightwell/trace/light_sample.h"
#include "lightwell/trace/luminaire_inventory.h"

namespace lightwell {

/// All light sources of a scene, for sampling. Threads may share it.
class Lights {
 public:
  /// The scene must outlive the lights.
  explicit Lights(const TraceScene& scene);

  /// The same luminaires, of which only these shine. The others keep their numbers.
  Lights only(const LuminaireSet& shining) const;

  const std::vector<Luminaire>& luminaires() const { return inventory_.luminaires; }
  /// True when there is no light at all.
  bool dark() const { return choice_.total() <= 0; }
  /// The sum of the sources' sampling weights, W: about the channels' mean of power(), and 0 only when dark.
  float total_weight() const { return static_cast<float>(choice_.total()); }
  /// False when the total power is beyond the range of a float.
  bool finite() const;
  /// The power of all luminaires, W.
  Vec3f power() const;

  /// Emits a photon from a source chosen in proportion to its power. Must not be called when dark.
  Emission emit(Random& random) const;
  /// Samples the light that arrives at `point` from a random point of a source chosen in proportion to its power.
  /// Radiance is 0 when `point` is behind the source. Must not be called when dark.
  Arrival sample(const Vec3f& point, Random& random) const;
  /// The density with which sample() at `point` chooses the direction to an emissive surface's `hit`, 1/sr.
  float density(const Vec3f& point, const Hit& hit) const;
  /// The density with which sample() chooses a direction of the environment, which must not be black, 1/sr.
  float environment_density(const Vec3f& direction) const;

  /// The luminaire that a hit belongs to; -1 when it does not shine.
  int luminaire(const Hit& hit) const;
  const EnvironmentLight& environment() const { return environment_; }
  /// The environment's number among the luminaires; -1 when it is black, or does not shine.
  int environment_luminaire() const { return inventory_.environment_luminaire; }
  /// The box in which photons carry all of the light.
  const Box3f& region() const { return region_.box(); }

 private:
  const Lamp& lamp(const Luminaire& luminaire) const;
  const EmissiveFace& face(size_t element) const { return inventory_.faces[element - inventory_.first_face()]; }

  const TraceScene& scene_;
  EnvironmentLight environment_;
  LightRegion region_;
  LuminaireInventory inventory_;
  Distribution choice_;
  std::vector<float> clearances_;  // of the scene's lamps: bulb_radius
};

}  // namespace lightwell
