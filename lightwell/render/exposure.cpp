// SPDX-License-Identifier: Apache-2.0
#include "lightwell/render/exposure.h"

#include <algorithm>

namespace lightwell {
namespace {

constexpr float middle_grey = 0.18f;
constexpr float white = 1;

/// Rec. 709 luminance of the pixels that are not black.
std::vector<float> luminances(const Picture& picture) {
  std::vector<float> result;
  for (size_t i = 0; i < picture.pixels.size(); i += 3) {
    const float* p = &picture.pixels[i];
    const float luminance = 0.2126f * p[0] + 0.7152f * p[1] + 0.0722f * p[2];
    if (luminance > 0) result.push_back(luminance);
  }
  return result;
}

}  // namespace

float choose_exposure(const TraceScene& scene, const Camera& camera, const LightGrid& grid,
                      std::span<const uint8_t> contained) {
  // Direct and indirect light apart, since their sum would also show the lamps.
  RenderOptions options{.integrator = Integrator::ivg, .width = 96, .height = 72, .samples = 8};
  options.grid = &grid;
  options.contained = contained;
  Progress silent;
  RenderStatistics statistics;
  options.part = LightPart::direct;
  Result<Picture> picture = render(scene, camera, options, silent, statistics);
  options.part = LightPart::indirect;
  const Result<Picture> indirect = render(scene, camera, options, silent, statistics);
  if (!picture || !indirect) return 0;
  for (size_t i = 0; i < picture->pixels.size(); i++) picture->pixels[i] += indirect->pixels[i];

  std::vector<float> all = luminances(*picture);
  if (all.empty()) return 0;
  double logarithms = 0;
  for (const float luminance : all) logarithms += std::log2(static_cast<double>(luminance));
  const float mean = static_cast<float>(std::exp2(logarithms / static_cast<double>(all.size())));
  const auto bright = all.begin() + static_cast<ptrdiff_t>(0.95 * static_cast<double>(all.size() - 1));
  std::nth_element(all.begin(), bright, all.end());
  const float exposure = std::log2(std::min(middle_grey / mean, white / *bright));
  return std::round(exposure * 10) / 10;
}

}  // namespace lightwell
