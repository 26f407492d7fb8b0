// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/paths.h"

namespace lightwell {
namespace {

/// The number of bounces before Russian roulette begins.
constexpr int sure_bounces = 2;

/// A path that starts at its receiver and reports the light that it finds.
class Path {
 public:
  Path(const World& world, const Receiver& receiver, int max_bounces, Random& random, ReceivedLight& received)
      : surfaces_(world.surfaces()),
        lights_(world.lights()),
        vertex_(receiver),
        max_bounces_(max_bounces),
        random_(random),
        received_(received) {}

  /// Traces the path; returns the number of rays.
  int trace() {
    for (bounces_ = 0; bounces_ <= max_bounces_; bounces_++) {
      sample_lights();
      if (!extend()) break;
    }
    return rays_;
  }

 private:
  /// Reports light of a luminaire at the current vertex, as it is seen from the receiver.
  void add(int luminaire, const Vec3f& light) { received_.add(luminaire, bounces_, throughput_ * light); }

  void sample_lights() {
    const Arrival arrival = lights_.sample(vertex_.position, random_);
    if (max_component(arrival.radiance) <= 0) return;
    const Shading::Evaluation found = vertex_.shading.evaluate(arrival.direction);
    if (max_component(found.reflectance) <= 0) return;
    rays_++;
    const Vec3f seen = visibility(surfaces_, vertex_.position, vertex_.shading.normal, arrival, random_);
    const float weight = arrival.extended ? power_heuristic(arrival.density, found.density) : 1.0f;
    add(arrival.luminaire, found.reflectance * seen * arrival.radiance * (weight / arrival.density));
  }

  /// Samples a direction of reflection and follows it to the next vertex; false where the path ends.
  bool extend() {
    const Vec3f normal = vertex_.shading.normal;
    const Bsdf::Sample sample = vertex_.shading.sample(random_);
    if (max_component(sample.weight) <= 0 || dot(normal, sample.in) <= 0) return false;
    throughput_ *= sample.weight;
    if (bounces_ == 0) receiver_throughput_ = max_component(throughput_);
    Hit hit;
    rays_++;
    const bool meets = surfaces_.intersect({surfaces_.leave(vertex_.position, normal), sample.in}, random_, hit);
    throughput_ *= hit.tint;
    if (!meets) {
      meet_environment(sample);
      return false;
    }
    const Surface surface = surfaces_.surface(hit);
    meet_surface(sample, hit, surface);
    if (bounces_ >= sure_bounces && !survives()) return false;
    vertex_ = Receiver::seen(surfaces_, hit, surface, sample.in);
    return true;
  }

  void meet_environment(const Bsdf::Sample& sample) {
    if (lights_.environment_luminaire() < 0) return;
    const float weight = power_heuristic(sample.density, lights_.environment_density(sample.in));
    add(lights_.environment_luminaire(), lights_.environment().radiance(sample.in) * weight);
  }

  void meet_surface(const Bsdf::Sample& sample, const Hit& hit, const Surface& surface) {
    const Vec3f emission = surfaces_.emission(hit, surface);
    const int luminaire = lights_.luminaire(hit);
    if (luminaire < 0 || max_component(emission) <= 0) return;
    const float weight = power_heuristic(sample.density, lights_.density(vertex_.position, hit));
    add(luminaire, emission * weight);
  }

  bool survives() {
    const float survival = std::min(1.0f, max_component(throughput_) / receiver_throughput_);
    if (random_.uniform() >= survival) return false;
    throughput_ *= 1 / survival;
    return true;
  }

  const TraceScene& surfaces_;
  const Lights& lights_;
  Receiver vertex_;
  const int max_bounces_;
  Random& random_;
  ReceivedLight& received_;
  Vec3f throughput_ = Vec3f::filled(1);
  float receiver_throughput_ = 1;  // after the receiver: the reference for Russian roulette
  int bounces_ = 0;
  int rays_ = 0;
};

}  // namespace

Receiver Receiver::irradiance(const Vec3f& position, const Vec3f& normal) {
  return {.position = position,
          .shading = {
              .bsdf = Bsdf::lambertian(Vec3f::filled(pi)), .normal = normal, .shading_normal = normal, .out = normal}};
}

Receiver Receiver::seen(const TraceScene& surfaces, const Hit& hit, const Surface& surface, const Vec3f& direction) {
  return {.position = hit.position,
          .shading = {.bsdf = surface.bsdf,
                      .normal = hit.facing_normal(),
                      .shading_normal = surfaces.shading_normal(hit, direction),
                      .out = -direction}};
}

int trace_path(const World& world, const Receiver& receiver, int max_bounces, Random& random, ReceivedLight& received) {
  if (world.lights().dark()) return 0;
  return Path(world, receiver, max_bounces, random, received).trace();
}

}  // namespace lightwell
