// SPDX-License-Identifier: Apache-2.0
#include "lightwell/render/exposure.h"

#include <algorithm>

#include "lightwell/base/parallel.h"
#include "lightwell/render/camera.h"
#include "lightwell/trace/paths.h"

namespace lightwell {
namespace {

constexpr int width = 96, height = 72, samples = 8;

/// How a white surface in mean light is shown: a scene of common reflectances, around 0.36, gets a mean of 0.18.
constexpr float white_surface = 0.5f;
/// The limit for 95 % of the picture. The tone curve still resolves values a little above 1.
constexpr float brightest = 1.5f;

/// The readings of a light meter from a camera, one for each pixel that shows a lit surface.
struct Readings {
  std::vector<float> incident;   ///< the radiance that a white surface would have there
  std::vector<float> reflected;  ///< the radiance of the surface itself
};

/// Rec. 709 luminance.
float luminance(const Vec3f& c) { return 0.2126f * c[0] + 0.7152f * c[1] + 0.0722f * c[2]; }

Readings read_meter(const World& world, const Camera& camera, const LightField& field, const LuminaireSet& held,
                    int threads) {
  const TraceScene& surfaces = world.surfaces();
  std::vector<Vec2f> pixels(size_t(width) * height);
  parallel_for(pixels.size(), width, threads, [&](size_t begin, size_t end, int) {
    for (size_t pixel = begin; pixel < end; pixel++) {
      Random random(1, pixel);
      const size_t column = pixel % width, row = pixel / width;
      for (int i = 0; i < samples; i++) {
        const float x = (static_cast<float>(column) + random.uniform()) / width;
        const float y = (static_cast<float>(row) + random.uniform()) / height;
        const Ray ray = camera_ray(camera, float(width) / height, x, y);
        Hit hit;
        if (!surfaces.intersect(ray, random, hit)) continue;
        const Receiver receiver = Receiver::irradiance(hit.position, hit.facing_normal());
        DirectAndIndirect light(held);
        trace_path(world, receiver, 0, random, light);
        const Vec3f normal = surfaces.shading_normal(hit, ray.direction);
        const Vec3f white = (light.direct + field.irradiance(hit.position, normal, normal)) / pi;
        const Vec3f albedo = surfaces.surface(hit).bsdf.albedo(-dot(normal, ray.direction)).total();
        pixels[pixel] += Vec2f{{luminance(white), luminance(hit.tint * white * albedo)}} / float(samples);
      }
    }
  });
  Readings readings;
  for (const Vec2f& pixel : pixels) {
    if (!(pixel[0] > 0) || !is_finite(pixel)) continue;  // black, infinite or NaN
    readings.incident.push_back(pixel[0]);
    readings.reflected.push_back(pixel[1]);
  }
  return readings;
}

/// The mean of the base 2 logarithms.
double mean_stops(const std::vector<float>& values) {
  double stops = 0;
  for (const float value : values) stops += std::log2(static_cast<double>(value));
  return stops / static_cast<double>(values.size());
}

float percentile(std::vector<float> values, double share) {
  const auto found = values.begin() + static_cast<ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), found, values.end());
  return *found;
}

}  // namespace

float choose_exposure(const World& world, const Camera& camera, const LightField& field, const LuminaireSet& held,
                      int threads) {
  const Readings readings = read_meter(world, camera, field, held, threads);
  if (readings.incident.empty()) return 0;
  double stops = std::log2(static_cast<double>(white_surface)) - mean_stops(readings.incident);
  const auto bright = static_cast<double>(percentile(readings.reflected, 0.95));
  if (bright > 0) stops = std::min(stops, std::log2(static_cast<double>(brightest) / bright));
  return static_cast<float>(std::round(stops * 10) / 10);
}

}  // namespace lightwell
