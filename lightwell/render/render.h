// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "lightwell/base/progress.h"
#include "lightwell/render/integrator.h"
#include "lightwell/render/picture.h"

namespace lightwell {

struct RenderOptions {
  const IntegratorKind* integrator = &integrators().front();
  IntegratorOptions light;
  int width = 640, height = 480;  ///< pixels
  int samples = 64;               ///< a pixel, at most
  /// Samples are taken in passes, one a pixel, as long as another is likely to end within so many seconds; the first is
  /// taken in any case. Without it all samples are.
  std::optional<double> seconds{};
  /// How the picture will be shown: what is unlit is to look as its file has it.
  Display display{.exposure = 0, .tone = ToneCurve::none};
  uint64_t seed = 1;
  int threads = 0;  ///< 0: all processors
};

struct RenderStatistics {
  double seconds = 0;
  uint64_t rays = 0;
  int samples = 0;  ///< a pixel
};

/// Renders the picture of a camera, W/m2/sr, each pixel the mean over its square. As many samples give the same bytes,
/// for any number of threads and whether time ended them or not. Fails when `progress` is cancelled, when a size or the
/// number of samples is not positive, or when an integrator lacks the baked light that it needs.
Result<Picture> render(const World& world, const Camera& camera, const RenderOptions& options, Progress& progress,
                       RenderStatistics& statistics);

}  // namespace lightwell
