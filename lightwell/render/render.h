// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/base/progress.h"
#include "lightwell/render/integrator.h"
#include "lightwell/render/picture.h"

namespace lightwell {

struct RenderOptions {
  const IntegratorKind* integrator = &integrators().front();
  IntegratorOptions light;
  int width = 640, height = 480;  ///< pixels
  int samples = 64;               ///< a pixel
  /// How the picture will be shown: what is unlit is to look as its file has it.
  Display display{.exposure = 0, .tone = ToneCurve::none};
  uint64_t seed = 1;
  int threads = 0;  ///< 0: all processors
};

struct RenderStatistics {
  double seconds = 0;
  uint64_t rays = 0;
};

/// Renders the picture of a camera, W/m2/sr, each pixel the mean over its square. The same bytes for any number of
/// threads. Fails when `progress` is cancelled, when a size or the number of samples is not positive, or when an
/// integrator lacks the baked light that it needs.
Result<Picture> render(const World& world, const Camera& camera, const RenderOptions& options, Progress& progress,
                       RenderStatistics& statistics);

}  // namespace lightwell
