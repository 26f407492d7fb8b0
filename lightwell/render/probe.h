// SPDX-License-Identifier: Apache-2.0
#pragma once

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
  Integrator integrator = Integrator::path;  ///< path or ivg
  LightPart quantity = LightPart::indirect;
  bool environment = true;  ///< false: the environment's direct light is left out, what it bounces stays
  int samples = 1024;       ///< paths a point
  int max_bounces = 128;
  uint64_t seed = 1;
  int threads = 0;  ///< 0: all processors
  /// For `ivg`: the grid, and the luminaires whose direct light it contains, which then counts as indirect. To leave
  /// the environment out, the grid must have been baked without it.
  const LightGrid* grid = nullptr;
  std::span<const uint8_t> contained{};
};

/// The irradiance at points, in their order; the same bytes for any number of threads. Fails when `progress` asks to
/// stop.
Result<std::vector<ProbeValue>> probe(const TraceScene& scene, std::span<const ProbePoint> points,
                                      const ProbeOptions& options, Progress& progress);

}  // namespace lightwell
