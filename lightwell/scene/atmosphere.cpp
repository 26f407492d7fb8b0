// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/atmosphere.h"

#include <numbers>

namespace lightwell {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double earth = 6360, air = 100;  // the earth's radius, the height of its air
constexpr double air_scale = 8, haze_scale = 1.2;
constexpr double ozone_middle = 25, ozone_half = 15;

const Vec3d wavelength{{0.680, 0.550, 0.440}};  // micrometres
const Vec3d rayleigh{{5.802e-3, 13.558e-3, 33.1e-3}}, ozone{{0.650e-3, 1.881e-3, 0.085e-3}};
constexpr double haze_albedo = 0.9;      // what it scatters of what it takes
constexpr double haze_asymmetry = 0.76;  // g of Cornette and Shanks

double cube(double a) { return a * a * a; }

Vec3d exponential(const Vec3d& a) { return {{std::exp(a[0]), std::exp(a[1]), std::exp(a[2])}}; }

/// Of the whole air, above each square of the ground, by Angstrom's formula.
Vec3d optical_thickness_of_haze(double turbidity) {
  const double beta = std::max(0.0, 0.04608 * turbidity - 0.04586);
  Vec3d thickness;
  for (int c = 0; c < 3; c++) thickness[c] = beta * std::pow(wavelength[c], -1.3);
  return thickness;
}

/// The distance to where a ray from within leaves a sphere.
double distance_out(const Vec3d& from, const Vec3d& direction, double radius) {
  const double along = dot(from, direction);
  return -along + std::sqrt(std::max(0.0, along * along - dot(from, from) + radius * radius));
}

/// The distance to the earth; negative where a ray passes by.
double distance_to_earth(const Vec3d& from, const Vec3d& direction) {
  const double along = dot(from, direction);
  const double square = along * along - dot(from, from) + earth * earth;
  return along < 0 && square >= 0 ? std::max(0.0, -along - std::sqrt(square)) : -1;
}

}  // namespace

/// Of air, haze and ozone at a height, relative to where each is densest.
struct Atmosphere::Densities {
  explicit Densities(double height)
      : air(std::exp(-height / air_scale)),
        haze(std::exp(-height / haze_scale)),
        ozone(std::max(0.0, 1 - std::abs(height - ozone_middle) / ozone_half)) {}

  double air, haze, ozone;
};

Atmosphere::Atmosphere(double turbidity, double sun_cosine)
    : haze_(optical_thickness_of_haze(turbidity) / haze_scale), sun_(towards(sun_cosine)) {
  for (size_t i = 0; i < heights; i++)
    before_[i] = mean_of_scattered_before(air * cube(static_cast<double>(i) / (heights - 1)));
}

Vec3d Atmosphere::ground() { return {{0, earth, 0}}; }

Vec3d Atmosphere::towards(double cosine) { return {{std::sqrt(std::max(0.0, 1 - cosine * cosine)), cosine, 0}}; }

Vec3d Atmosphere::extinction(const Densities& densities) const {
  return rayleigh * densities.air + haze_ * densities.haze + ozone * densities.ozone;
}

Vec3d Atmosphere::scattering(const Densities& densities) const {
  return rayleigh * densities.air + haze_ * (haze_albedo * densities.haze);
}

/// Calls step(place, densities, reach) for pieces of a ray, `reach` being the integral over the piece of what is left
/// on its way to `from`; returns what is left of all the way. Pieces grow with the cube, as the air is dense near the
/// ground; within a piece the air is alike, so that no thickness of it gives more light than there is.
template <typename Step>
Vec3d Atmosphere::march(const Vec3d& from, const Vec3d& direction, double length, const Step& step) const {
  constexpr int pieces = 32;
  Vec3d left = Vec3d::filled(1);
  for (int i = 0; i < pieces; i++) {
    const double begin = cube(double(i) / pieces), end = cube(double(i + 1) / pieces);
    const Vec3d place = from + direction * (length * (begin + end) / 2);
    const Densities densities(std::max(0.0, lightwell::length(place) - earth));
    const Vec3d rate = extinction(densities);
    const Vec3d after = left * exponential(rate * (length * (begin - end)));
    step(place, densities, (left - after) / rate);
    left = after;
  }
  return left;
}

Vec3d Atmosphere::transmittance(const Vec3d& place, const Vec3d& direction) const {
  if (distance_to_earth(place, direction) >= 0) return {};
  return march(place, direction, distance_out(place, direction, earth + air),
               [](const Vec3d&, const Densities&, const Vec3d&) {});
}

Atmosphere::Scattered Atmosphere::scattered(const Vec3d& direction) const {
  Scattered light;
  march(ground(), direction, distance_out(ground(), direction, earth + air),
        [&](const Vec3d& place, const Densities& densities, const Vec3d& reach) {
          const Vec3d sunlight = transmittance(place, sun_) * reach;
          light.by_air += sunlight * rayleigh * densities.air;
          light.by_haze += sunlight * haze_ * (haze_albedo * densities.haze);
          light.again += scattered_before(length(place) - earth) * scattering(densities) * reach;
        });
  return light;
}

Vec3d Atmosphere::radiance(const Scattered& light, double cosine) {
  constexpr double g = haze_asymmetry;
  const double of_air = 3 / (16 * pi) * (1 + cosine * cosine);
  const double of_haze =
      3 / (8 * pi) * (1 - g * g) * (1 + cosine * cosine) / ((2 + g * g) * std::pow(1 + g * g - 2 * g * cosine, 1.5));
  return light.by_air * of_air + light.by_haze * of_haze + light.again;
}

Vec3d Atmosphere::scattered_before(double height) const {
  const double at = std::cbrt(std::clamp(height / air, 0.0, 1.0)) * (heights - 1);
  const size_t below = std::min(static_cast<size_t>(at), heights - 2);
  const double share = at - static_cast<double>(below);
  return before_[below] * (1 - share) + before_[below + 1] * share;
}

/// Hillaire's estimate: light is scattered evenly from the second time on, and each time by the same fraction.
Vec3d Atmosphere::mean_of_scattered_before(double height) const {
  constexpr int circles = 16, places = 8;
  const Vec3d from = ground() + Vec3d{{0, height, 0}};
  Vec3d once{}, fraction{};
  for (int i = 0; i < circles * places; i++) {
    const int circle = i / places, step = i % places;
    const double cosine = 2 * (circle + 0.5) / circles - 1;
    const double sine = std::sqrt(1 - cosine * cosine), angle = pi * (step + 0.5) / places;
    const Vec3d direction{{sine * std::cos(angle), cosine, sine * std::sin(angle)}};
    const double to_earth = distance_to_earth(from, direction);
    const double way = to_earth >= 0 ? to_earth : distance_out(from, direction, earth + air);
    const Vec3d left =
        march(from, direction, way, [&](const Vec3d& place, const Densities& densities, const Vec3d& reach) {
          once += transmittance(place, sun_) * scattering(densities) * reach / (4 * pi);
          fraction += scattering(densities) * reach;
        });
    if (to_earth < 0) continue;
    const Vec3d up = normalized(from + direction * way);
    once += left * transmittance(up * earth, sun_) * (std::max(0.0, dot(up, sun_)) * ground_albedo / pi);
  }
  constexpr double count = circles * places;
  return once / count / (Vec3d::filled(1) - fraction / count);
}

}  // namespace lightwell
