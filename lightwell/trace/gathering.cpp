// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/gathering.h"

namespace lightwell {
namespace {

/// Near surfaces that are followed one after the other; in a gap that is narrower they are taken as they are.
constexpr int most_near = 6;

/// Follows one ray from gloss to gloss, and through narrow places.
class Gatherer {
 public:
  Gatherer(const World& world, float near, Random& random, Gathering& gathering)
      : surfaces_(world.surfaces()), lights_(world.lights()), near_(near), random_(random), gathering_(gathering) {}

  void follow(Ray ray) {
    while (gathering_.diffuse_count < Gathering::most_diffuse) {
      Hit hit;
      gathering_.rays++;
      const bool meets = surfaces_.intersect(ray, random_, hit);
      throughput_ *= hit.tint;
      if (gathering_.rays == 1) {
        gathering_.meets_surface = meets;
        gathering_.first = hit;
      }
      if (!meets) {
        see(lights_.environment_luminaire(), lights_.environment().radiance(ray.direction),
            [&] { return lights_.environment_density(ray.direction); });
        break;
      }
      const Surface surface = surfaces_.surface_from_afar(hit);
      see(lights_.luminaire(hit), surfaces_.emission(hit, surface), [&] { return lights_.density(ray.origin, hit); });
      Bsdf followed = surface.bsdf;
      if (hit.distance >= near_ || reflections_ >= most_near) {
        const Bsdf::Albedo albedo = surface.bsdf.albedo(hit.cosine);
        const bool all = surface.bsdf.nearly_diffuse(albedo);
        gathering_.diffuse[gathering_.diffuse_count++] = {hit.position, hit.facing_normal(),
                                                          throughput_ * (all ? albedo.total() : albedo.diffuse)};
        if (all) break;
        followed.diffuse = {};
      }
      if (!reflect(hit, followed, ray)) break;
      reflections_++;
    }
  }

 private:
  /// Light of a luminaire at the end of the ray. After a reflection the luminaires have been sampled too, with
  /// `density`.
  template <typename Density>
  void see(int luminaire, const Vec3f& radiance, const Density& density) {
    if (luminaire < 0 || max_component(radiance) <= 0) return;
    if (reflections_ == 0) {
      gathering_.emitted = throughput_ * radiance;
      gathering_.luminaire = luminaire;
    } else {
      gathering_.mirrored += throughput_ * radiance * power_heuristic(lobe_density_, density());
    }
  }

  /// Turns the ray into one that a surface reflects; false when it ends, as chance has it for what reflects little.
  bool reflect(const Hit& hit, const Bsdf& bsdf, Ray& ray) {
    const float survival = std::min(1.0f, max_component(throughput_ * bsdf.albedo(hit.cosine).total()));
    if (survival <= 0 || random_.uniform() >= survival) return false;
    throughput_ *= 1 / survival;
    const Vec3f normal = hit.facing_normal(), out = -ray.direction;
    sample_lights(hit.position, normal, out, bsdf);
    const Bsdf::Sample sample = bsdf.sample(normal, out, random_);
    if (max_component(sample.weight) <= 0) return false;
    throughput_ *= sample.weight;
    lobe_density_ = sample.density;
    ray = {surfaces_.leave(hit.position, normal), sample.in};
    return true;
  }

  void sample_lights(const Vec3f& position, const Vec3f& normal, const Vec3f& out, const Bsdf& bsdf) {
    const Arrival arrival = lights_.sample(position, random_);
    const float cosine = dot(normal, arrival.direction);
    if (cosine <= 0 || max_component(arrival.radiance) <= 0) return;
    const Bsdf::Evaluation found = bsdf.evaluate(normal, out, arrival.direction);
    gathering_.rays++;
    if (max_component(found.value) <= 0) return;
    const Vec3f seen = visibility(surfaces_, position, normal, arrival, random_);
    const float weight = arrival.extended ? power_heuristic(arrival.density, found.density) : 1.0f;
    gathering_.mirrored += throughput_ * found.value * seen * arrival.radiance * (cosine * weight / arrival.density);
  }

  const TraceScene& surfaces_;
  const Lights& lights_;
  float near_;
  Random& random_;
  Gathering& gathering_;
  Vec3f throughput_ = Vec3f::filled(1);
  float lobe_density_ = 0;  // with which the last surface chose the ray
  int reflections_ = 0;
};

}  // namespace

Gathering gather(const World& world, Ray ray, float near, Random& random) {
  Gathering gathering;
  Gatherer(world, near, random, gathering).follow(ray);
  return gathering;
}

}  // namespace lightwell
