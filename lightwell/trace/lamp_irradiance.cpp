// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/lamp_irradiance.h"

#include <array>
#include <numbers>
#include <span>

#include "lightwell/trace/punctual_light.h"
#include "lightwell/trace/sampling.h"

namespace lightwell {
namespace {

/// What an edge adds to twice the vector irradiance of its polygon; the ends as seen from the receiver.
Vec3d of_edge(const Vec3d& a, const Vec3d& b) {
  const Vec3d across = cross(a, b);
  const double area = length(across);
  return area > 0 ? across * (std::atan2(area, dot(a, b)) / area) : Vec3d{};
}

/// Of a polygon of radiance 1, whichever side shines; its corners as seen from the receiver, to be clipped at its
/// horizon.
double of_polygon(std::span<const Vec3d> corners, const Vec3d& normal) {
  Vec3d sum{}, leaves{}, enters{};
  for (size_t i = 0; i < corners.size(); i++) {
    Vec3d a = corners[i], b = corners[(i + 1) % corners.size()];
    const double height = dot(a, normal), next = dot(b, normal);
    if (height <= 0 && next <= 0) continue;
    const Vec3d on_horizon = height * next < 0 ? a + (b - a) * (height / (height - next)) : height > 0 ? b : a;
    if (height <= 0) enters = a = on_horizon;
    if (next <= 0) leaves = b = on_horizon;
    sum += of_edge(a, b);
  }
  return std::abs(dot(sum + of_edge(leaves, enters), normal)) / 2;
}

double of_rectangle(const ClientLamp& lamp, const Vec3d& position, const Vec3d& normal) {
  const Vec3d center = lamp.center.cast<double>() - position;
  const Vec3d u = lamp.half_u.cast<double>(), v = lamp.half_v.cast<double>();
  return of_polygon(std::array{center + u + v, center - u + v, center - u - v, center + u - v}, normal);
}

/// As a regular polygon of the disc's area.
double of_disc(const ClientLamp& lamp, const Vec3d& position, const Vec3d& normal) {
  constexpr size_t corners = 64;
  constexpr double step = 2 * std::numbers::pi / corners;
  const Frame frame(lamp.normal);
  const Vec3d center = lamp.center.cast<double>() - position;
  const Vec3d u = frame.x.cast<double>(), v = frame.y.cast<double>();
  const double radius = static_cast<double>(lamp.radius) * std::sqrt(step / std::sin(step));
  std::array<Vec3d, corners> rim;
  for (size_t i = 0; i < corners; i++) {
    const double turn = step * static_cast<double>(i);
    rim[i] = center + (u * std::cos(turn) + v * std::sin(turn)) * radius;
  }
  return of_polygon(rim, normal);
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

Vec3f unshadowed_irradiance(const ClientLamp& lamp, const Vec3f& position, const Vec3f& normal) {
  switch (lamp.kind) {
    case ClientLamp::Kind::rectangle:
    case ClientLamp::Kind::disc: {
      const bool behind = dot(position - lamp.center, lamp.normal) <= 0;
      if (behind && !lamp.two_sided) return {};
      const auto of_radiance_1 = lamp.kind == ClientLamp::Kind::disc ? of_disc : of_rectangle;
      return lamp.radiance * static_cast<float>(of_radiance_1(lamp, position.cast<double>(), normal.cast<double>()));
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
