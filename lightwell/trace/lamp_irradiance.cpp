// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/lamp_irradiance.h"

#include <numbers>

#include "lightwell/base/assert.h"
#include "lightwell/trace/punctual_light.h"

namespace lightwell {
namespace {

/// What an edge adds to twice the vector irradiance of its polygon; the ends as seen from the receiver.
Vec3d of_edge(const Vec3d& a, const Vec3d& b) {
  const Vec3d across = cross(a, b);
  const double area = length(across);
  return area > 0 ? across * (std::atan2(area, dot(a, b)) / area) : Vec3d{};
}

/// Of radiance 1, whichever side shines.
double of_rectangle(const ClientLamp& lamp, const Vec3d& position, const Vec3d& normal) {
  const Vec3d center = lamp.center.cast<double>() - position;
  const Vec3d u = lamp.half_u.cast<double>(), v = lamp.half_v.cast<double>();
  const Vec3d corners[] = {center + u + v, center - u + v, center - u - v, center + u - v};
  Vec3d sum{}, leaves{}, enters{};
  for (int i = 0; i < 4; i++) {
    Vec3d a = corners[i], b = corners[(i + 1) % 4];
    const double height = dot(a, normal), next = dot(b, normal);
    if (height <= 0 && next <= 0) continue;
    const Vec3d on_horizon = height * next < 0 ? a + (b - a) * (height / (height - next)) : height > 0 ? b : a;
    if (height <= 0) enters = a = on_horizon;
    if (next <= 0) leaves = b = on_horizon;
    sum += of_edge(a, b);
  }
  return std::abs(dot(sum + of_edge(leaves, enters), normal)) / 2;
}

/// Of radiance 1. `cosine` of the angle to its centre, `share`: (radius / distance)^2.
double of_sphere(double cosine, double share) {
  if (cosine * cosine >= share) return std::numbers::pi * share * std::max(cosine, 0.0);
  const double sine = std::sqrt(1 - cosine * cosine);
  const double x = std::sqrt(1 / share - 1);
  const double y = -x * cosine / sine;
  const double z = sine * std::sqrt(std::max(0.0, 1 - y * y));
  return std::max(0.0, (cosine * std::acos(std::clamp(y, -1.0, 1.0)) - x * z) * share + std::atan(z / x));
}

}  // namespace

Lamp punctual_lamp(const ClientLamp& lamp) {
  LW_ASSERT(lamp.kind != ClientLamp::Kind::rectangle && lamp.kind != ClientLamp::Kind::sphere);
  Lamp source;
  source.kind = lamp.kind == ClientLamp::Kind::sun    ? Lamp::Kind::sun
                : lamp.kind == ClientLamp::Kind::spot ? Lamp::Kind::spot
                                                      : Lamp::Kind::point;
  source.position = lamp.center;
  source.direction = lamp.normal;
  source.intensity = lamp.intensity;
  source.range = lamp.range;
  source.inner_cone = lamp.inner_cone;
  source.outer_cone = lamp.outer_cone;
  return source;
}

Vec3f unshadowed_irradiance(const ClientLamp& lamp, const Vec3f& position, const Vec3f& normal) {
  switch (lamp.kind) {
    case ClientLamp::Kind::rectangle: {
      const bool behind = dot(position - lamp.center, lamp.normal) <= 0;
      if (behind && !lamp.two_sided) return {};
      return lamp.radiance * static_cast<float>(of_rectangle(lamp, position.cast<double>(), normal.cast<double>()));
    }
    case ClientLamp::Kind::sphere: {
      const Vec3d way = (lamp.center - position).cast<double>();
      const double squared = std::max(dot(way, way), 1e-30);
      // Who is inside of the sphere is as near to it as can be.
      const double share =
          std::min(static_cast<double>(lamp.radius) * static_cast<double>(lamp.radius) / squared, 0.999);
      const double cosine = dot(way, normal.cast<double>()) / std::sqrt(squared);
      return lamp.radiance * static_cast<float>(of_sphere(cosine, share));
    }
    case ClientLamp::Kind::point:
    case ClientLamp::Kind::spot:
    case ClientLamp::Kind::sun: break;
  }
  const Arrival arrival = arrive_punctual(punctual_lamp(lamp), position);
  return arrival.radiance * std::max(dot(arrival.direction, normal), 0.0f);
}

}  // namespace lightwell
