// SPDX-License-Identifier: Apache-2.0
#include "lightwell/render/direct_light.h"

namespace lightwell {

DirectLight::DirectLight(const World& world, const IntegratorOptions& options, LuminaireSet left_out)
    : world_(world), options_(options), left_out_(std::move(left_out)) {
  if (options.sampling.most_points == 0) return;
  lamps_ = std::make_unique<const LampLight>(world, options.sampling, left_out_, options.factors);
  LuminaireSet others = LuminaireSet::all(world.lights().luminaires().size());
  for (int i = 0; i < lamps_->luminaires().size(); i++)
    if (lamps_->luminaires().contains(i)) others.erase(i);
  lit_by_lamps_ = world.lit_by(lamps_->luminaires());
  lit_by_others_ = world.lit_by(others);
}

ReflectedLight DirectLight::sample(const Receiver& receiver, const Vec3f& known, Random& random) const {
  ReflectedLight light;
  if (!by_lamps()) {
    add_random(world_, receiver, random, light);
    return light;
  }
  add_random(*lit_by_others_, receiver, random, light);
  Receiver facets = receiver;
  facets.shading.bsdf = receiver.shading.bsdf.facets_alone();
  if (facets.shading.bsdf.glossy()) add_random(*lit_by_lamps_, facets, random, light);
  const LampLight::Found found = lamps_->reflected(receiver, known, random);
  light.radiance += found.radiance;
  light.rays += found.rays;
  return light;
}

void DirectLight::add_random(const World& world, const Receiver& receiver, Random& random,
                             ReflectedLight& light) const {
  DirectAndIndirect found(left_out_, options_.factors);
  light.rays += trace_path(world, receiver, 0, random, found);
  light.radiance += found.direct;
}

}  // namespace lightwell
