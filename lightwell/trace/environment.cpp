// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/environment.h"

#include "lightwell/scene/sky_map.h"

namespace lightwell {
namespace {

constexpr float whole_sphere = 4 * pi;

}  // namespace

EnvironmentLight::EnvironmentLight(const Environment& environment) : scale_(environment.radiance) {
  const RadianceImage* map = environment.map.get();
  if (!map || map->width < 1 || map->height < 1) {
    mean_ = scale_;
    return;
  }
  map_ = map;
  std::vector<float> weights(static_cast<size_t>(map->width) * static_cast<size_t>(map->height));
  Vec3d sum{};
  for (size_t i = 0; i < weights.size(); i++) {
    const float angle = solid_angle(static_cast<int>(i / static_cast<size_t>(map->width)), *map);
    const Vec3f flux = scale_ * pixel_radiance(*map, i) * angle;
    weights[i] = mean_of_channels(flux);
    sum += flux.cast<double>();
  }
  pixels_ = Distribution(weights);
  mean_ = (sum / static_cast<double>(whole_sphere)).cast<float>();
}

Vec3f EnvironmentLight::radiance(const Vec3f& direction) const {
  return map_ ? scale_ * pixel_radiance(*map_, pixel(direction)) : scale_;
}

Vec3f EnvironmentLight::seen(const Vec3f& d) const {
  if (!map_) return scale_;
  const float x = (0.5f + std::atan2(d[0], -d[2]) / (2 * pi)) * static_cast<float>(map_->width) - 0.5f;
  const float y = std::acos(std::clamp(d[1], -1.0f, 1.0f)) / pi * static_cast<float>(map_->height) - 0.5f;
  const int column = static_cast<int>(std::floor(x)), row = static_cast<int>(std::floor(y));
  const float right = x - static_cast<float>(column), below = y - static_cast<float>(row);
  const auto at = [&](int i, int j) {
    const int around = (i + map_->width) % map_->width, within = std::clamp(j, 0, map_->height - 1);
    return pixel_radiance(*map_,
                          static_cast<size_t>(within) * static_cast<size_t>(map_->width) + static_cast<size_t>(around));
  };
  const Vec3f upper = at(column, row) * (1 - right) + at(column + 1, row) * right;
  const Vec3f lower = at(column, row + 1) * (1 - right) + at(column + 1, row + 1) * right;
  return scale_ * (upper * (1 - below) + lower * below);
}

// Radiance and density are taken from the chosen pixel: looked up again from the direction, they could by rounding be
// those of a black neighbour.
EnvironmentLight::Sample EnvironmentLight::sample(Random& random) const {
  if (!map_) return {.direction = sample_sphere(random), .radiance = scale_, .density = 1 / whole_sphere};
  const size_t chosen = pixels_.sample(random);
  const size_t width = static_cast<size_t>(map_->width);
  const int row = static_cast<int>(chosen / width);
  const float share = random.uniform();
  const float y = cos_edge(row, map_->height) * (1 - share) + cos_edge(row + 1, map_->height) * share;
  const float u = (static_cast<float>(chosen % width) + random.uniform()) / static_cast<float>(width);
  const float angle = 2 * pi * (u - 0.5f);
  const float radius = std::sqrt(std::max(0.0f, 1 - y * y));
  return {.direction = {{radius * std::sin(angle), y, -radius * std::cos(angle)}},
          .radiance = scale_ * pixel_radiance(*map_, chosen),
          .density = pixels_.probability(chosen) / solid_angle(row, *map_)};
}

float EnvironmentLight::density(const Vec3f& direction) const {
  if (!map_) return 1 / whole_sphere;
  const size_t index = pixel(direction);
  const int row = static_cast<int>(index / static_cast<size_t>(map_->width));
  return pixels_.probability(index) / solid_angle(row, *map_);
}

Emission EnvironmentLight::emit(const LightRegion& region, Random& random) const {
  const Sample chosen = sample(random);
  return {.ray = region.beam_ray(-chosen.direction, random),
          .flux = chosen.radiance * (region.beam_area() / chosen.density)};
}

Arrival EnvironmentLight::arrive(Random& random) const {
  const Sample chosen = sample(random);
  return {.direction = chosen.direction,
          .distance = std::numeric_limits<float>::infinity(),
          .radiance = chosen.radiance,
          .density = chosen.density};
}

size_t EnvironmentLight::pixel(const Vec3f& d) const {
  const float u = 0.5f + std::atan2(d[0], -d[2]) / (2 * pi);
  const float v = std::acos(std::clamp(d[1], -1.0f, 1.0f)) / pi;
  const int x = std::clamp(static_cast<int>(u * static_cast<float>(map_->width)), 0, map_->width - 1);
  const int y = std::clamp(static_cast<int>(v * static_cast<float>(map_->height)), 0, map_->height - 1);
  return static_cast<size_t>(y) * static_cast<size_t>(map_->width) + static_cast<size_t>(x);
}

}  // namespace lightwell
