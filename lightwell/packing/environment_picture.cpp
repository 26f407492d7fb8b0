// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/environment_picture.h"

#include <algorithm>

#include "lightwell/scene/sky_map.h"
#include "lightwell/texture/image_file.h"

namespace lightwell {
namespace {

// As many stops as the brightest pixel lies above the mean, and these below it: what is darker is black beside the
// rest. At 14 stops a byte is a step of 4 %.
constexpr float stops_below_mean = 6;
constexpr float least_stops = 8, most_stops = 20;

/// Each pixel the mean of those that it covers.
RadianceImage smaller(const RadianceImage& map, const Vec3f& scale) {
  const int width = std::min(map.width, environment_width);
  const int height = std::min(map.height, environment_width / 2);
  RadianceImage result{width, height, {}};
  for (int y = 0; y < height; y++)
    for (int x = 0; x < width; x++) {
      const auto begin = [](int i, int count, int of) { return static_cast<int>(int64_t(i) * of / count); };
      const int x0 = begin(x, width, map.width), x1 = begin(x + 1, width, map.width);
      const int y0 = begin(y, height, map.height), y1 = begin(y + 1, height, map.height);
      Vec3f sum{};
      for (int row = y0; row < y1; row++)
        for (int column = x0; column < x1; column++)
          sum += pixel_radiance(
              map, static_cast<size_t>(row) * static_cast<size_t>(map.width) + static_cast<size_t>(column));
      const Vec3f mean = scale * sum / static_cast<float>((x1 - x0) * (y1 - y0));
      result.pixels.insert(result.pixels.end(), mean.e.begin(), mean.e.end());
    }
  return result;
}

}  // namespace

std::optional<CodedRadiance> coded(const Environment& environment) {
  if (!environment.map || environment.map->pixels.empty()) return std::nullopt;
  const RadianceImage map = smaller(*environment.map, environment.radiance);
  double sum = 0;
  for (const float value : map.pixels) sum += static_cast<double>(value);
  const float mean = static_cast<float>(sum / static_cast<double>(map.pixels.size()));
  CodedRadiance result;
  result.radiance = *std::ranges::max_element(map.pixels);
  if (!(mean > 0 && result.radiance <= most_environment_radiance)) return std::nullopt;
  result.stops = std::clamp(std::log2(result.radiance / mean) + stops_below_mean, least_stops, most_stops);
  result.image = {map.width, map.height, 3, {}};
  for (const float value : map.pixels) {
    const float share = 1 + std::log2(value / result.radiance) / result.stops;  // of black: -inf
    result.image.pixels.push_back(static_cast<uint8_t>(std::lround(255 * std::clamp(share, 0.0f, 1.0f))));
  }
  return result;
}

RadianceImage decoded(const Image& image, const EnvironmentPicture& picture) {
  RadianceImage map{image.width, image.height, {}};
  const auto channels = static_cast<size_t>(image.channels);
  for (size_t i = 0; i < image.pixels.size(); i += channels)
    for (size_t c = 0; c < 3; c++) {
      const uint8_t byte = image.pixels[i + (channels < 3 ? 0 : c)];
      const float share = std::exp2(picture.stops * (static_cast<float>(byte) / 255 - 1));
      map.pixels.push_back(byte == 0 ? 0 : picture.radiance * share);
    }
  return map;
}

std::optional<EnvironmentPicture> add_environment(Scene& scene, Document& document) {
  std::optional<CodedRadiance> picture = coded(scene.environment);
  if (!picture) return std::nullopt;
  const int view = DocumentBuilder(document).buffer_view(write_png(picture->image));
  Json& json = document.json;
  json["images"].push_back({{"mimeType", mime_type(ImageFormat::png)}, {"bufferView", view}});
  json["textures"].push_back({{"source", json["images"].size() - 1}});
  scene.images.push_back(std::move(picture->image));
  return EnvironmentPicture{static_cast<uint32_t>(json["textures"].size() - 1), picture->radiance, picture->stops};
}

}  // namespace lightwell
