// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/punctual_light.h"

namespace lightwell {
namespace {

/// The share of a spot's intensity at an angle, given its cosine to the axis (KHR_lights_punctual).
float cone(const Lamp& lamp, float cosine) {
  if (lamp.kind != Lamp::Kind::spot) return 1;
  const float inner = std::cos(lamp.inner_cone), outer = std::cos(lamp.outer_cone);
  const float x = std::clamp((cosine - outer) / std::max(0.001f, inner - outer), 0.0f, 1.0f);
  return x * x;
}

/// The solid angle of a spot's cone, its fading edge weighted by the intensity left there.
float cone_solid_angle(const Lamp& lamp) {
  const float outer = std::cos(lamp.outer_cone);
  const float width = std::max(0.001f, std::cos(lamp.inner_cone) - outer);
  const float full_from = std::min(1.0f, outer + width);
  const float edge = full_from - outer;
  return 2 * pi * (1 - full_from + edge * edge * edge / (3 * width * width));
}

/// The window that ends a lamp's light at its range (KHR_lights_punctual).
float range_window(const Lamp& lamp, float distance) {
  if (lamp.range <= 0) return 1;
  const float x = distance / lamp.range;
  return std::max(0.0f, 1 - x * x * x * x);
}

}  // namespace

Vec3f punctual_power(const Lamp& lamp, const LightRegion& region) {
  const float spread = lamp.kind == Lamp::Kind::sun     ? region.beam_area()
                       : lamp.kind == Lamp::Kind::point ? 4 * pi
                                                        : cone_solid_angle(lamp);
  return lamp.intensity * spread;
}

Emission emit_punctual(const Lamp& lamp, const LightRegion& region, Random& random) {
  if (lamp.kind == Lamp::Kind::sun)
    return {.ray = region.beam_ray(lamp.direction, random), .flux = lamp.intensity * region.beam_area()};
  Emission emission;
  emission.ray.origin = lamp.position;
  if (lamp.kind == Lamp::Kind::point) {
    emission.ray.direction = sample_sphere(random);
    emission.flux = lamp.intensity * (4 * pi);
  } else {
    const float outer = std::cos(lamp.outer_cone);
    const float cosine = 1 - random.uniform() * (1 - outer);
    const float angle = 2 * pi * random.uniform();
    const float radius = std::sqrt(std::max(0.0f, 1 - cosine * cosine));
    emission.ray.direction =
        Frame(lamp.direction).to_world({{radius * std::cos(angle), radius * std::sin(angle), cosine}});
    emission.flux = lamp.intensity * (cone(lamp, cosine) * 2 * pi * (1 - outer));
  }
  // A share of 1 - (distance / range)^4 of the photons gets beyond a distance.
  if (lamp.range > 0) emission.ray.far = lamp.range * std::sqrt(std::sqrt(1 - random.uniform()));
  return emission;
}

Arrival arrive_punctual(const Lamp& lamp, const Vec3f& point) {
  Arrival arrival{.density = 1, .extended = false};
  if (lamp.kind == Lamp::Kind::sun) {
    arrival.direction = -lamp.direction;
    arrival.distance = std::numeric_limits<float>::infinity();
    arrival.radiance = lamp.intensity;
    return arrival;
  }
  const Vec3f way = lamp.position - point;
  arrival.distance = length(way);
  if (arrival.distance <= 0) return arrival;
  arrival.direction = way / arrival.distance;
  const float left = cone(lamp, -dot(arrival.direction, lamp.direction)) * range_window(lamp, arrival.distance);
  arrival.radiance = lamp.intensity * (left / (arrival.distance * arrival.distance));
  return arrival;
}

}  // namespace lightwell
