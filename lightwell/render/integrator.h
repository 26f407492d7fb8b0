// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "lightwell/base/progress.h"
#include "lightwell/light/grid.h"
#include "lightwell/render/picture.h"
#include "lightwell/trace/paths.h"

namespace lightwell {

/// Where light comes from: all of it, straight from its source, or after at least one reflection. A picture's total
/// also shows what shines by itself; its other parts do not.
enum class LightPart { total, direct, indirect };

/// How the light of a point is found.
enum class Integrator {
  path,    ///< path tracing, the reference
  direct,  ///< path tracing of the direct light only
  ivg,     ///< direct light by path tracing, the rest looked up in a light grid, as the viewer does
};

struct RenderOptions {
  Integrator integrator = Integrator::path;
  LightPart part = LightPart::total;
  int width = 640, height = 480;  ///< pixels
  int samples = 64;               ///< a pixel
  int max_bounces = 128;          ///< of `path`, between source and surface: 0 is direct light only
  uint64_t seed = 1;
  int threads = 0;  ///< 0: all processors
  /// For `ivg`: the grid, and the luminaires whose direct light it contains (one flag each). In the grid's picture that
  /// light counts as indirect.
  const LightGrid* grid = nullptr;
  std::span<const uint8_t> contained{};
};

struct RenderStatistics {
  double seconds = 0;
  uint64_t rays = 0;
};

/// The radiance that a surface reflects from a light grid towards who looks: the Lambertian part of the irradiance, and
/// for metals the irradiance of the mirrored direction / pi, as the viewer has it.
Vec3f reflected_from_grid(const LightGrid& grid, const Receiver& receiver);

/// The picture that a camera takes, each pixel the mean over its square. The same bytes for any number of threads.
/// Fails when `progress` asks to stop, when a size or the samples are not positive, or when `ivg` lacks its grid.
Result<Picture> render(const TraceScene& scene, const Camera& camera, const RenderOptions& options, Progress& progress,
                       RenderStatistics& statistics);

}  // namespace lightwell
