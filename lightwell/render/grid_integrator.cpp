// SPDX-License-Identifier: Apache-2.0
#include "lightwell/render/grid_integrator.h"

#include "lightwell/render/folds.h"

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
    if (options_.sky == nullptr || !wants_indirect(options_.part)) return {light.direct, rays};
    return {light.direct + reflected_in_folds(receiver, random), rays + static_cast<int>(sky_rays)};
  }

  Vec3f known(const Receiver& receiver) const override {
    return wants_indirect(options_.part) ? reflected_from_field(*options_.field, receiver) : Vec3f{};
  }

 private:
  /// By which the share of the sky that is seen is found, in two halves.
  static constexpr size_t sky_rays = 8;

  /// Irradiance of the sky where nothing would hide it, and where it is seen.
  struct SkyLight {
    Vec3f open{}, seen{};

    SkyLight operator+(const SkyLight& other) const { return {open + other.open, seen + other.seen}; }
    SkyLight operator*(float share) const { return {open * share, seen * share}; }
  };

  /// What the surfaces within a cell reflect onto one another beyond what the grids know, since rays, not grids, find
  /// the sky's light. It is no linear function of that: what its noise adds is taken out by what it adds to the halves
  /// (Quenouille's jackknife, 1949).
  Vec3f reflected_in_folds(const Receiver& receiver, Random& random) const {
    const Shading& shading = receiver.shading;
    const Vec3f& normal = shading.shading_normal;
    const Vec3f albedo = shading.bsdf.albedo(dot(normal, shading.out)).diffuse;
    if (max_component(albedo) <= 0) return {};
    const Vec3f in_cells = options_.sky->irradiance(receiver.position, normal, normal);
    const Vec3f reflected = options_.field->irradiance(receiver.position, normal, normal);
    const auto in_folds = [&](const SkyLight& sky) {
      const Vec3f share_in_cells = share_of(in_cells, sky.open), share = share_of(sky.seen, sky.open);
      return irradiance_in_folds(albedo, sky.seen, reflected, share_in_cells, share) - sky.seen - reflected;
    };
    const std::array<SkyLight, 2> halves = sky_light(receiver, random);
    const Vec3f of_both = in_folds((halves[0] + halves[1]) * 0.5f);
    return albedo * (of_both * 2 - (in_folds(halves[0]) + in_folds(halves[1])) * 0.5f) / pi;
  }

  /// By each half of the rays.
  std::array<SkyLight, 2> sky_light(const Receiver& receiver, Random& random) const {
    const Shading& shading = receiver.shading;
    const float of_a_ray = 2 * pi / static_cast<float>(sky_rays);
    const Vec3f scale = options_.factors.of(world_.lights().environment_luminaire()) * of_a_ray;
    const Frame frame(shading.shading_normal);
    const float u = random.uniform(), v = random.uniform();
    std::array<SkyLight, 2> halves;
    for (size_t i = 0; i < sky_rays; i++) {
      SkyLight& light = halves[i % 2];
      Vec3f direction = frame.to_world(cosine_direction(i, sky_rays, u, v));
      // Folded up as the reflection of Shading is.
      direction += shading.normal * (2 * std::max(0.0f, -dot(direction, shading.normal)));
      const Vec3f radiance = scale * world_.lights().environment().radiance(direction);
      light.open += radiance;
      const Arrival arrival{.direction = direction, .distance = std::numeric_limits<float>::infinity()};
      light.seen += radiance * visibility(world_.surfaces(), receiver.position, shading.normal, arrival, random);
    }
    return halves;
  }

  static Vec3f share_of(const Vec3f& light, const Vec3f& all) {
    Vec3f share = Vec3f::filled(1);
    for (size_t c = 0; c < 3; c++)
      if (all[c] > 0) share[c] = light[c] / all[c];
    return share;
  }

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
