// SPDX-License-Identifier: Apache-2.0
#include "lightwell/render/grid_integrator.h"

namespace lightwell {
namespace {

class GridIntegrator : public Integrator {
 public:
  GridIntegrator(const World& world, const IntegratorOptions& options) : world_(world), options_(options) {
    for (int i = 0; i < static_cast<int>(world.lights().luminaires().size()); i++)
      if (options.held.contains(i) || options.left_out.contains(i)) not_direct_.insert(i);
  }

  bool samples() const override { return wants_direct(options_.part); }

  ReflectedLight sample(const Receiver& receiver, Random& random) const override {
    if (!samples()) return {};
    DirectAndIndirect light(not_direct_, options_.factors);
    const int rays = trace_path(world_, receiver, 0, random, light);
    return {light.direct, rays};
  }

  Vec3f known(const Receiver& receiver) const override {
    return wants_indirect(options_.part) ? reflected_from_field(*options_.field, receiver) : Vec3f{};
  }

 private:
  const World& world_;
  const IntegratorOptions& options_;
  LuminaireSet not_direct_;
};

}  // namespace

std::unique_ptr<Integrator> make_grid_integrator(const World& world, const IntegratorOptions& options) {
  return std::make_unique<GridIntegrator>(world, options);
}

Vec3f reflected_from_field(const LightField& field, const Receiver& receiver) {
  const Shading& shading = receiver.shading;
  const Vec3f& normal = shading.shading_normal;
  const float cosine = dot(normal, shading.out);
  const Bsdf::Albedo albedo = shading.bsdf.albedo(cosine);
  Vec3f light = (albedo.diffuse + albedo.repeated) * field.irradiance(receiver.position, normal, normal);
  if (max_component(albedo.gloss) > 0) {
    const Vec3f mirrored = normalized(normal * (2 * cosine) - shading.out);
    light += albedo.gloss * field.irradiance(receiver.position, normal, mirrored);
  }
  return light / pi;
}

}  // namespace lightwell
