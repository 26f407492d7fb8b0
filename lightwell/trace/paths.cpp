// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/paths.h"

namespace lightwell {
namespace {

/// How many bounces a path keeps all of its light before Russian roulette begins.
constexpr int sure_bounces = 2;

/// A path that grows from its receiver, and what it found so far.
class Path {
 public:
  Path(const TraceScene& scene, const Receiver& receiver, const PathOptions& options, Random& random)
      : scene_(scene), lights_(scene.lights()), vertex_(receiver), options_(options), random_(random) {}

  ReceivedLight trace() {
    for (bounces_ = 0; bounces_ <= options_.max_bounces; bounces_++) {
      sample_lights();
      if (!go_on()) break;
    }
    return light_;
  }

 private:
  /// Light that a luminaire sends to the present vertex, seen from the receiver.
  void add(int luminaire, const Vec3f& light) {
    const size_t index = static_cast<size_t>(luminaire);
    const bool apart = index < options_.apart.size() && options_.apart[index];
    (bounces_ > 0 ? light_.indirect : apart ? light_.apart : light_.direct) += throughput_ * light;
  }

  void sample_lights() {
    const Lights::Arrival arrival = lights_.sample(vertex_.position, random_);
    const float cosine = dot(vertex_.shading_normal, arrival.direction);
    if (cosine <= 0 || dot(vertex_.normal, arrival.direction) <= 0 || max_component(arrival.radiance) <= 0) return;
    const Bsdf& bsdf = vertex_.bsdf;
    const Vec3f value = bsdf.value(vertex_.shading_normal, vertex_.out, arrival.direction);
    if (max_component(value) <= 0 || hidden(arrival)) return;
    const float other = bsdf.density(vertex_.shading_normal, vertex_.out, arrival.direction);
    const float weight = arrival.density > 0 ? power_heuristic(arrival.density, other) : 1.0f;
    add(arrival.luminaire, value * arrival.radiance * (cosine * weight));
  }

  bool hidden(const Lights::Arrival& arrival) {
    Ray ray{.origin = scene_.leave(vertex_.position, vertex_.normal), .direction = arrival.direction};
    if (std::isfinite(arrival.distance)) {
      // The ray ends short of the source, as seen from where it really starts.
      const Vec3f source = vertex_.position + arrival.direction * arrival.distance;
      const Vec3f way = source - ray.origin;
      const float whole = length(way);
      if (whole == 0) return false;
      ray.direction = way / whole;
      ray.far = whole * (1 - 1e-4f);
    }
    light_.rays++;
    return scene_.occluded(ray, random_);
  }

  /// Follows a direction of the vertex's reflection to the next vertex; false where the path ends.
  bool go_on() {
    const Bsdf::Sample sample = vertex_.bsdf.sample(vertex_.shading_normal, vertex_.out, random_);
    if (max_component(sample.weight) <= 0 || dot(vertex_.normal, sample.in) <= 0) return false;
    throughput_ *= sample.weight;
    if (bounces_ == 0) whole_ = max_component(throughput_);
    Hit hit;
    light_.rays++;
    if (!scene_.intersect({scene_.leave(vertex_.position, vertex_.normal), sample.in}, random_, hit)) {
      meet_environment(sample);
      return false;
    }
    const Surface surface = scene_.surface(hit);
    meet_surface(sample, hit, surface);
    if (bounces_ >= sure_bounces && !survives()) return false;
    vertex_ = {.position = hit.position,
               .normal = hit.facing_normal(),
               .shading_normal = hit.facing_normal(),
               .out = -sample.in,
               .bsdf = surface.bsdf};
    return true;
  }

  void meet_environment(const Bsdf::Sample& sample) {
    if (lights_.environment().black()) return;
    const float weight = power_heuristic(sample.density, lights_.environment_density(sample.in));
    add(lights_.environment_luminaire(), lights_.environment().radiance(sample.in) * weight);
  }

  void meet_surface(const Bsdf::Sample& sample, const Hit& hit, const Surface& surface) {
    const Vec3f emission = scene_.emission(hit, surface);
    if (max_component(emission) <= 0) return;
    const float weight = power_heuristic(sample.density, lights_.density(vertex_.position, hit));
    add(lights_.luminaire(hit), emission * weight);
  }

  bool survives() {
    const float survival = std::min(1.0f, max_component(throughput_) / whole_);
    if (random_.uniform() >= survival) return false;
    throughput_ *= 1 / survival;
    return true;
  }

  const TraceScene& scene_;
  const Lights& lights_;
  Receiver vertex_;
  const PathOptions& options_;
  Random& random_;
  Vec3f throughput_ = Vec3f::filled(1);
  float whole_ = 1;  // the throughput after the receiver, which survival is measured against
  int bounces_ = 0;
  ReceivedLight light_;
};

}  // namespace

Receiver Receiver::irradiance(const Vec3f& position, const Vec3f& normal) {
  return {.position = position,
          .normal = normal,
          .shading_normal = normal,
          .out = normal,
          .bsdf = Bsdf::lambertian(Vec3f::filled(pi))};
}

ReceivedLight trace_path(const TraceScene& scene, const Receiver& receiver, const PathOptions& options,
                         Random& random) {
  if (scene.lights().dark()) return {};
  return Path(scene, receiver, options, random).trace();
}

}  // namespace lightwell
