// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/base/progress.h"
#include "lightwell/render/integrator.h"

namespace lightwell {

/// Where irradiance is measured: a point in free space or on a surface, and the unit normal of the hemisphere.
struct ProbePoint {
  Vec3f position{};
  Vec3f normal{};
};

struct ProbeValue {
  Vec3f irradiance{};        ///< W/m2
  float standard_error = 0;  ///< root mean square over the channels; 0 for what is looked up in a grid
};

struct ProbeOptions {
  const IntegratorKind* integrator = &integrators().front();
  IntegratorOptions light{.part = LightPart::indirect};
  int samples = 1024;  ///< paths a point
  uint64_t seed = 1;
  int threads = 0;  ///< 0: all processors
};

/// Measures the irradiance at points, in their order. The same bytes for any number of threads. Fails when `progress`
/// is cancelled, or when an integrator lacks the baked light that it needs.
Result<std::vector<ProbeValue>> probe(const World& world, std::span<const ProbePoint> points,
                                      const ProbeOptions& options, Progress& progress);

}  // namespace lightwell
