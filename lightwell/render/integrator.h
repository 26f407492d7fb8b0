// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>

#include "lightwell/light/light_field.h"
#include "lightwell/render/lamp_light.h"
#include "lightwell/render/light_part.h"
#include "lightwell/trace/paths.h"

namespace lightwell {

/// The light that a receiver reflects towards the viewer, in the parts that were asked for.
struct ReflectedLight {
  Vec3f radiance{};  ///< W/m2/sr
  int rays = 0;      ///< traced for it
};

/// Finds the light that a receiver reflects: a random part, one sample at a time, and a part that is known without
/// sampling. Threads may share it.
class Integrator {
 public:
  virtual ~Integrator() = default;
  /// One random sample; the mean of many, plus known(), is the light.
  virtual ReflectedLight sample(const Receiver& receiver, Random& random) const = 0;
  /// The part that is looked up.
  virtual Vec3f known(const Receiver&) const { return {}; }
  /// False when sample() has nothing to add.
  virtual bool samples() const { return true; }
};

/// Options of an integrator.
struct IntegratorOptions {
  LightPart part = LightPart::total;
  int max_bounces = 128;  ///< between source and receiver, for path tracing; 0 is direct light only
  /// The baked light, for integrators that look it up, and the luminaires whose direct light it holds, which then
  /// counts as indirect.
  const LightField* field = nullptr;
  /// The sky's own light where it was taken out of `field`, to be found by rays (leave_sky_to_rays).
  const LightField* sky = nullptr;
  LuminaireSet held{};
  /// Luminaires whose direct light is left out. Their bounced light stays.
  LuminaireSet left_out{};
  /// By which the light of luminaires is multiplied. That of `field` is so already.
  LuminaireFactors factors{};
  /// Of the lamps' direct light, for integrators that take it by points of them, as the page does.
  LampSampling sampling{};
};

/// A row of the table of integrators. A new integrator is a new file and a row.
struct IntegratorKind {
  const char* name;
  const char* help;     ///< a few words for the command line
  bool finds_indirect;  ///< false: direct light alone
  bool needs_field;     ///< looks up baked light
  bool takes_points;    ///< of lamps, for their direct light, if it is to (LampSampling)
  /// World and options must outlive the integrator. `field` must be set if it is needed.
  std::unique_ptr<Integrator> (*make)(const World& world, const IntegratorOptions& options);
};

/// All integrators; the first is the reference.
std::span<const IntegratorKind> integrators();

}  // namespace lightwell
