// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/emissive_face.h"

#include "lightwell/trace/sampling.h"

namespace lightwell {
namespace {

/// Samples of the emission of a face on which it varies.
constexpr int samples = 64;

}  // namespace

EmissiveFace::EmissiveFace(const TraceScene& scene, uint32_t instance, uint32_t face)
    : instance_(instance), face_(face), double_sided_(scene.material(instance).double_sided) {
  const std::array<Vec3f, 3> c = scene.corners(instance, face);
  corner_ = c[0];
  edge_u_ = c[1] - c[0];
  edge_v_ = c[2] - c[0];
  normal_ = scene.face_normal(instance, c);
  area_ = length(cross(edge_u_, edge_v_)) / 2;
}

float EmissiveFace::spread() const { return pi * area_ * (double_sided_ ? 2.0f : 1.0f); }

Vec3f EmissiveFace::emission(const TraceScene& scene, Vec2f uv) const {
  const Surface surface = scene.surface(instance_, face_, uv[0], uv[1]);
  return surface.emission * surface.coverage;
}

Vec3f EmissiveFace::mean_emission(const TraceScene& scene) const {
  if (scene.is_uniform(instance_)) return emission(scene, {{1.0f / 3, 1.0f / 3}});
  Random random(instance_, face_);
  Vec3f sum{};
  for (int i = 0; i < samples; i++) sum += emission(scene, sample_triangle(random));
  return sum / samples;
}

float EmissiveFace::least_weight(const TraceScene& scene) const {
  if (scene.is_uniform(instance_)) return 0;
  return mean_of_channels(scene.material(instance_).emission) / (4 * samples) * spread();
}

Emission EmissiveFace::emit(const TraceScene& scene, Random& random) const {
  const Vec3f normal = double_sided_ && random.uniform() < 0.5f ? -normal_ : normal_;
  const Vec2f uv = sample_triangle(random);
  Emission emission;
  emission.ray.origin = scene.leave(at(uv), normal);
  emission.ray.direction = sample_cosine_hemisphere(normal, random);
  emission.flux = this->emission(scene, uv) * spread();
  return emission;
}

Arrival EmissiveFace::arrive(const TraceScene& scene, const Vec3f& point, Random& random) const {
  const Vec2f uv = sample_triangle(random);
  Arrival arrival;
  const Vec3f way = at(uv) - point;
  arrival.distance = length(way);
  if (arrival.distance <= 0) return arrival;
  arrival.direction = way / arrival.distance;
  float cosine = -dot(arrival.direction, normal_);
  if (double_sided_) cosine = std::abs(cosine);
  if (cosine <= 0) return arrival;
  arrival.density = arrival.distance * arrival.distance / (cosine * area_);
  arrival.radiance = emission(scene, uv);
  return arrival;
}

float EmissiveFace::density(const Vec3f& point, const Hit& hit) const {
  const Vec3f way = hit.position - point;
  const float distance2 = dot(way, way);
  const float cosine = std::abs(dot(way, hit.normal)) / std::sqrt(distance2);
  return cosine * area_ > 0 ? distance2 / (cosine * area_) : 0;
}

}  // namespace lightwell
