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

  const std::vector<Luminaire>& luminaires() const { return inventory_.luminaires; }
  /// True when there is no light at all.
  bool dark() const { return choice_.total() <= 0; }
  /// The sum of what sources are chosen by, W: about the mean of power(), and not 0 unless dark.
  float total_weight() const { return static_cast<float>(choice_.total()); }
  /// False when the sum of all light is beyond a float.
  bool finite() const;
  /// Sum over all luminaires, W.
  Vec3f power() const;

  /// Emits a photon, sources being chosen by power. Must not be dark.
  Emission emit(Random& random) const;
  /// Chooses a source by power and a point of it. Radiance 0 when `point` is behind it. Must not be dark.
  Arrival sample(const Vec3f& point, Random& random) const;
  /// The density with which sample() at `point` chooses the direction to an emissive surface's `hit`, 1/sr.
  float density(const Vec3f& point, const Hit& hit) const;
  /// The density with which sample() chooses a direction of the environment, 1/sr.
  float environment_density(const Vec3f& direction) const;

  /// The luminaire that a hit belongs to; -1 when it does not shine.
  int luminaire(const Hit& hit) const;
  const EnvironmentLight& environment() const { return environment_; }
  /// The environment's number among the luminaires; -1 when it is black.
  int environment_luminaire() const { return inventory_.environment_luminaire; }
  /// Where photons carry all of the light.
  const Box3f& region() const { return region_.box(); }

 private:
  const Lamp& lamp(const Luminaire& luminaire) const;
  const EmissiveFace& face(size_t element) const { return inventory_.faces[element - inventory_.first_face()]; }

  const TraceScene& scene_;
  EnvironmentLight environment_;
  LightRegion region_;
  LuminaireInventory inventory_;
  Distribution choice_;
};

}  // namespace lightwell
