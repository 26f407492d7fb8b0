// SPDX-License-Identifier: Apache-2.0
#include "lightwell/render/folds.h"

#include <algorithm>

namespace lightwell {
namespace {

/// From which part of its mean on the sky's irradiance tells something, and from which on it tells all.
constexpr float little = 0.05f, enough = 0.2f;

float smooth_step(float from, float to, float x) {
  const float t = std::clamp((x - from) / (to - from), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

}  // namespace

Vec3f irradiance_in_fold(const Vec3f& albedo, const Vec3f& sky, const Vec3f& reflected, const SkyInFold& shares) {
  Vec3f irradiance{};
  for (size_t c = 0; c < 3; c++) {
    float hidden = 0;
    if (shares.mean[c] > 0 && shares.open[c] > little * shares.mean[c]) {
      const float in_cells = std::clamp(shares.in_cells[c] / shares.open[c], 0.0f, 1.0f);
      hidden = (in_cells - shares.share[c]) * smooth_step(little, enough, shares.open[c] / shares.mean[c]);
    }
    irradiance[c] = std::max(sky[c], (sky[c] + reflected[c]) / (1 - std::min(albedo[c] * hidden, 0.95f)));
  }
  return irradiance;
}

}  // namespace lightwell
