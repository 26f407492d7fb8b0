// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "lightwell/render/integrator.h"

namespace lightwell {

/// The light that a receiver reflects straight from its sources: all of it by random samples or, where lamps have
/// points (LampSampling), what is diffuse of their light by these, and at random only the rest: what facets mirror of
/// the lamps, and the luminaires that no lamp stands for. Threads may share it.
class DirectLight {
 public:
  /// World and options must outlive it. The light of `left_out` is not in it.
  DirectLight(const World& world, const IntegratorOptions& options, LuminaireSet left_out);

  bool by_lamps() const { return lamps_ != nullptr; }
  /// A sample; `known` is what else is known of the receiver's light (LampLight::reflected).
  ReflectedLight sample(const Receiver& receiver, const Vec3f& known, Random& random) const;

 private:
  /// Adds a random sample of the light of a world.
  void add_random(const World& world, const Receiver& receiver, Random& random, ReflectedLight& light) const;

  const World& world_;
  const IntegratorOptions& options_;
  const LuminaireSet left_out_;
  std::unique_ptr<const LampLight> lamps_;
  std::unique_ptr<const World> lit_by_lamps_, lit_by_others_;
};

}  // namespace lightwell
