// SPDX-License-Identifier: Apache-2.0
#include "lightwell/render/compare.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lightwell/base/assert.h"
#include "lightwell/render/colour.h"
#include "lightwell/render/flip.h"
#include "lightwell/texture/transfer.h"

namespace lightwell {
namespace {

using Pixels = std::vector<Vec3f>;

Pixels pixels_of(const Picture& picture) {
  Pixels pixels;
  for (size_t i = 0; i + 2 < picture.pixels.size(); i += 3) {
    pixels.push_back({{picture.pixels[i], picture.pixels[i + 1], picture.pixels[i + 2]}});
  }
  return pixels;
}

Pixels shown(const Picture& picture, const Display& display) {
  Pixels pixels = pixels_of(picture);
  std::transform(pixels.begin(), pixels.end(), pixels.begin(), display);
  return pixels;
}

template <typename PixelError>
std::vector<float> errors_of(const Pixels& a, const Pixels& b, const PixelError& error) {
  std::vector<float> errors(a.size());
  std::transform(a.begin(), a.end(), b.begin(), errors.begin(), error);
  return errors;
}

float root_mean_square(const Vec3f& a, const Vec3f& b) { return std::sqrt(dot(a - b, a - b) / 3); }

float relative_square(const Vec3f& a, const Vec3f& reference) {
  const Vec3f difference = a - reference;
  const Vec3f relative = difference * difference / (reference * reference + Vec3f::filled(0.01f));
  return (relative[0] + relative[1] + relative[2]) / 3;
}

Vec3f lab_of_rgb(const Vec3f& rgb) { return lab_of(relative_xyz(rgb)); }

std::vector<float> pixel_errors(const Picture& picture, const Picture& reference, Metric metric,
                                const Display& display) {
  switch (metric) {
    case Metric::rmse: return errors_of(pixels_of(picture), pixels_of(reference), root_mean_square);
    case Metric::relmse: return errors_of(pixels_of(picture), pixels_of(reference), relative_square);
    case Metric::flip: return flip(shown(reference, display), shown(picture, display), picture.width, picture.height);
    case Metric::deltae:
      return errors_of(shown(picture, display), shown(reference, display),
                       [](const Vec3f& a, const Vec3f& b) { return ciede2000(lab_of_rgb(a), lab_of_rgb(b)); });
    case Metric::lab:
      return errors_of(shown(picture, display), shown(reference, display),
                       [](const Vec3f& a, const Vec3f& b) { return length(lab_of_rgb(a) - lab_of_rgb(b)); });
  }
  return {};
}

double mean_of(const std::vector<float>& errors, Metric metric) {
  double sum = 0;
  for (const double e : errors) sum += metric == Metric::rmse ? e * e : e;
  const double mean = sum / static_cast<double>(errors.size());
  return metric == Metric::rmse ? std::sqrt(mean) : mean;
}

}  // namespace

std::optional<Metric> metric_of(std::string_view name) {
  constexpr std::array<std::string_view, 5> names{"rmse", "relmse", "deltae", "lab", "flip"};
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<Metric>(found - names.begin());
}

Result<Comparison> compare(const Picture& picture, const Picture& reference, Metric metric, const Display& display) {
  if (picture.width != reference.width || picture.height != reference.height) {
    return fail("pictures", "one has " + std::to_string(picture.width) + "x" + std::to_string(picture.height) +
                                " pixels, the other " + std::to_string(reference.width) + "x" +
                                std::to_string(reference.height));
  }
  if (picture.pixels.empty()) return fail("pictures", "have no pixels");
  for (const Picture* either : {&picture, &reference})
    if (!std::ranges::all_of(either->pixels, [](float value) { return std::isfinite(value); }))
      return fail(either == &picture ? "the first picture" : "the second picture",
                  "has pixels that are no finite numbers");
  Comparison result;
  result.errors = pixel_errors(picture, reference, metric, display);
  result.mean = mean_of(result.errors, metric);
  std::vector<float> sorted = result.errors;
  std::sort(sorted.begin(), sorted.end());
  result.p95 = sorted[(sorted.size() * 95 + 99) / 100 - 1];
  result.max = sorted.back();
  return result;
}

Image heat_map(const Comparison& comparison, int width, int height) {
  LW_ASSERT(comparison.errors.size() == static_cast<size_t>(width) * static_cast<size_t>(height));
  Image image{width, height, 3, {}};
  for (const float error : comparison.errors) {
    const float heat = comparison.max > 0 ? 3 * error / static_cast<float>(comparison.max) : 0.0f;
    for (int c = 0; c < 3; c++) image.pixels.push_back(to_byte(heat - static_cast<float>(c)));
  }
  return image;
}

}  // namespace lightwell
