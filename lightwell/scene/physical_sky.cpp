// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/physical_sky.h"

#include <numbers>

#include "lightwell/scene/atmosphere.h"
#include "lightwell/scene/noted_sky.h"
#include "lightwell/scene/sky_map.h"

namespace lightwell {
namespace {

constexpr int width = 1024, height = width / 2, horizon = height / 2;  // of the picture
constexpr int azimuths = 17;  // from the sun's to the one opposite, between which the light changes slowly
const double lowest_sun = std::sin(std::numbers::pi / 36);  // five degrees
constexpr float half_turn = std::numbers::pi_v<float>;

template <typename T>
T luminance(const Vec<T, 3>& light) {
  return dot(light, Vec3d{{0.2126, 0.7152, 0.0722}}.cast<T>());
}

class SkyPainter {
 public:
  SkyPainter(const Lamp& sun, float turbidity)
      : towards_sun_(normalized(-sun.direction)),
        sun_angle_(std::atan2(towards_sun_[0], -towards_sun_[2])),
        sun_height_(std::clamp(static_cast<double>(towards_sun_[1]), -1.0, 1.0)),
        air_(turbidity, sun_height_),
        strength_(luminance(sun.intensity.cast<double>()) / luminance(sunlight(std::max(sun_height_, lowest_sun)))) {}

  RadianceImage paint() const {
    RadianceImage map{width, height, std::vector<float>(size_t(3) * width * height)};
    Vec3d of_sky{};
    for (int row = 0; row < horizon; row++) of_sky += paint_row(row, map);
    const Vec3d of_sun = sunlight(sun_height_) * (strength_ * std::max(0.0, sun_height_));
    const Vec3d ground = (of_sky + of_sun) * (Atmosphere::ground_albedo / std::numbers::pi);
    for (size_t pixel = size_t(horizon) * width; pixel < size_t(height) * width; pixel++) set(map, pixel, ground);
    return map;
  }

 private:
  static void set(RadianceImage& map, size_t pixel, const Vec3d& radiance) {
    for (int c = 0; c < 3; c++) map.pixels[3 * pixel + static_cast<size_t>(c)] = static_cast<float>(radiance[c]);
  }

  /// Facing a sun at this height, at the ground.
  Vec3d sunlight(double cosine) const { return air_.transmittance(Atmosphere::ground(), Atmosphere::towards(cosine)); }

  /// The light of a row by its angle from the sun's azimuth.
  std::vector<Atmosphere::Scattered> scattered_in(int row) const {
    const double polar = std::numbers::pi * (row + 0.5) / height;
    std::vector<Atmosphere::Scattered> row_light;
    for (int i = 0; i < azimuths; i++) {
      const double angle = std::numbers::pi * i / (azimuths - 1);
      row_light.push_back(
          air_.scattered({{std::sin(polar) * std::cos(angle), std::cos(polar), std::sin(polar) * std::sin(angle)}}));
    }
    return row_light;
  }

  /// Paints a row and returns its share of the irradiance of the ground.
  Vec3d paint_row(int row, RadianceImage& map) const {
    const std::vector<Atmosphere::Scattered> light = scattered_in(row);
    Vec3d irradiance{};
    for (int column = 0; column < width; column++) {
      const size_t pixel = size_t(row) * width + static_cast<size_t>(column);
      const Vec3f direction = pixel_direction(map, pixel);
      const float turn = std::remainder(std::atan2(direction[0], -direction[2]) - sun_angle_, 2 * half_turn);
      const float at = std::abs(turn) / half_turn * (azimuths - 1);
      const size_t before = std::min(static_cast<size_t>(at), size_t(azimuths) - 2);
      const double share = at - static_cast<float>(before), cosine = dot(direction, towards_sun_);
      const Vec3d radiance = (Atmosphere::radiance(light[before], cosine) * (1 - share) +
                              Atmosphere::radiance(light[before + 1], cosine) * share) *
                             strength_;
      set(map, pixel, radiance);
      irradiance += radiance * static_cast<double>(direction[1] * solid_angle(row, map));
    }
    return irradiance;
  }

  Vec3f towards_sun_;
  float sun_angle_;
  double sun_height_;
  Atmosphere air_;
  double strength_;  // the irradiance of the sun outside of the air
};

}  // namespace

Environment physical_sky(const Lamp& sun, float turbidity) {
  return {Vec3f::filled(1), std::make_shared<RadianceImage>(SkyPainter(sun, turbidity).paint())};
}

const Lamp* strongest_sun(const Scene& scene) {
  const Lamp* strongest = nullptr;
  for (const Lamp& lamp : scene.lamps)
    if (lamp.kind == Lamp::Kind::sun && (!strongest || luminance(lamp.intensity) > luminance(strongest->intensity)))
      strongest = &lamp;
  return strongest;
}

Result<void> light_by_sky(Scene& scene, float turbidity) {
  const Lamp* sun = strongest_sun(scene);
  if (sun == nullptr)
    return fail("--sky", "the scene has no sun, a lamp of type \"directional\", around which a sky could be");
  scene.environment = physical_sky(*sun, turbidity);
  note_sky(scene.document.json, {.radiance = {}, .turbidity = turbidity});
  return {};
}

}  // namespace lightwell
