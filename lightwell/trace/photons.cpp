// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/photons.h"

namespace lightwell {
namespace {

/// Ends photons that albedos of 1 in a closed room would keep flying for ever.
constexpr int max_bounces = 1000;

}  // namespace

PhotonWalk::PhotonWalk(const World& world, uint64_t seed, uint64_t index)
    : surfaces_(world.surfaces()), lights_(world.lights()), random_(seed, index) {}

bool PhotonWalk::next(Flight& flight) {
  float far = std::numeric_limits<float>::infinity();
  if (!started_) {
    const Emission emission = lights_.emit(random_);
    flight = {.origin = emission.ray.origin,
              .direction = emission.ray.direction,
              .flux = emission.flux,
              .luminaire = emission.luminaire};
    far = emission.ray.far;
    started_ = true;
  } else if (!at_surface_ || !reflect(flight)) {
    return false;
  }
  at_surface_ = surfaces_.intersect({flight.origin, flight.direction, far}, random_, hit_);
  flight.length = at_surface_ ? hit_.distance : far;
  return max_component(flight.flux) > 0;
}

bool PhotonWalk::reflect(Flight& flight) {
  if (flight.bounces == max_bounces) return false;
  const Vec3f normal = hit_.facing_normal();
  const Bsdf bsdf = surfaces_.surface(hit_).bsdf;
  const Bsdf::Albedo albedo = bsdf.albedo(hit_.cosine);
  const Bsdf::Sample sample = (bsdf.nearly_diffuse(albedo) ? Bsdf::lambertian(albedo.total()) : bsdf)
                                  .sample(normal, -flight.direction, random_);
  const Vec3f reflected = flight.flux * hit_.tint * sample.weight;
  const float survival = std::min(1.0f, max_component(reflected) / max_component(flight.flux));
  if (random_.uniform() >= survival) return false;
  flight.flux = reflected / survival;
  flight.origin = surfaces_.leave(hit_.position, normal);
  flight.direction = sample.in;
  flight.from_back = !hit_.front && !surfaces_.material(hit_.instance).double_sided;
  flight.bounces++;
  return true;
}

}  // namespace lightwell
