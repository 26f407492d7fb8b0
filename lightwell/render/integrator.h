// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>

#include "lightwell/light/light_field.h"
#include "lightwell/render/light_part.h"
#include "lightwell/trace/paths.h"

namespace lightwell {

/// What a receiver reflects towards who looks, in the parts that were asked for.
struct ReflectedLight {
  Vec3f radiance{};  ///< W/m2/sr
  int rays = 0;      ///< that were traced for it
};

/// A way to find the light that a receiver reflects: what chance decides, one sample at a time, and what needs none.
/// Threads may share it.
class Integrator {
 public:
  virtual ~Integrator() = default;
  /// One sample; the mean of many is the light, but for what known() gives.
  virtual ReflectedLight sample(const Receiver& receiver, Random& random) const = 0;
  /// The part that is looked up.
  virtual Vec3f known(const Receiver&) const { return {}; }
  /// False when sample() has nothing to add.
  virtual bool samples() const { return true; }
};

/// What an integrator is told.
struct IntegratorOptions {
  LightPart part = LightPart::total;
  int max_bounces = 128;  ///< between source and receiver, of one that traces all of the way: 0 is direct light only
  /// The baked light, for one that looks it up, and the luminaires whose direct light it holds, which then counts as
  /// indirect.
  const LightField* field = nullptr;
  LuminaireSet held{};
  /// Luminaires whose direct light is left out. What they bounce stays.
  LuminaireSet left_out{};
};

/// A row of the table of integrators. A new one is a file and a row.
struct IntegratorKind {
  const char* name;
  const char* help;     ///< a few words for the command line
  bool finds_indirect;  ///< false: direct light alone
  bool needs_field;     ///< looks up baked light
  /// World and options outlive the integrator. The field is there where it is needed.
  std::unique_ptr<Integrator> (*make)(const World& world, const IntegratorOptions& options);
};

/// All integrators; the first is the reference.
std::span<const IntegratorKind> integrators();
/// The integrator of a name, which must be in the table.
const IntegratorKind& find_integrator(std::string_view name);

}  // namespace lightwell
