// SPDX-License-Identifier: Apache-2.0
#include "lightwell/render/grid_integrator.h"

#include "lightwell/light/add_radiance.h"
#include "lightwell/render/direct_light.h"
#include "lightwell/render/folds.h"

namespace lightwell {
namespace {

class GridIntegrator : public Integrator {
 public:
  GridIntegrator(const World& world, const IntegratorOptions& options)
      : world_(world), options_(options), direct_(world, options, not_direct(options)) {
    if (options.sky != nullptr) see_open_sky();
  }

  bool samples() const override { return wants_direct(options_.part) || finds_folds(); }

  ReflectedLight sample(const Receiver& receiver, Random& random) const override {
    ReflectedLight reflected;
    if (wants_direct(options_.part))
      reflected = direct_.sample(receiver, direct_.by_lamps() ? known(receiver) : Vec3f{}, random);
    if (finds_folds()) add_folds(receiver, random, reflected);
    return reflected;
  }

  Vec3f known(const Receiver& receiver) const override {
    return wants_indirect(options_.part) ? reflected_from_field(*options_.field, receiver) : Vec3f{};
  }

 private:
  /// The luminaires whose direct light is in the grids, or in nothing.
  static LuminaireSet not_direct(const IntegratorOptions& options) {
    LuminaireSet set = options.held;
    for (int i = 0; i < options.left_out.size(); i++)
      if (options.left_out.contains(i)) set.insert(i);
    return set;
  }

  /// The irradiance of the sky where nothing hides it, in the moments that its grid has.
  void see_open_sky() {
    constexpr size_t count = 16'384;
    const EnvironmentLight& sky = world_.lights().environment();
    const Vec3f scale =
        options_.factors.of(world_.lights().environment_luminaire()) * (4 * pi / static_cast<float>(count));
    for (size_t i = 0; i < count; i++) {
      const Vec3f direction = sphere_direction(i, count, 0.5f, 0.5f);
      add_radiance(open_sky_, direction, sky.radiance(direction) * scale);
    }
    for (size_t axis = 0; axis < 6; axis++) mean_of_sky_ += open_sky_.m[axis] / 6;
  }

  bool finds_folds() const { return options_.sky != nullptr && wants_indirect(options_.part); }

  /// Adds what the surfaces within a cell reflect onto one another beyond what the grids know, since rays, not grids,
  /// find the sky's light. It is no linear function of that: what the rays' noise adds is taken out by what it adds to
  /// two halves of them (Quenouille's jackknife, 1949).
  void add_folds(const Receiver& receiver, Random& random, ReflectedLight& light) const {
    const Shading& shading = receiver.shading;
    const Vec3f& normal = shading.shading_normal;
    const Vec3f albedo = shading.bsdf.albedo(dot(normal, shading.out)).diffuse;
    if (max_component(albedo) <= 0) return;
    const Vec3f open = open_sky_.irradiance(normal);
    const Vec3f reflected = options_.field->irradiance(receiver.position, normal, normal);
    SkyInFold shares{
        .open = open, .mean = mean_of_sky_, .in_cells = options_.sky->irradiance(receiver.position, normal, normal)};
    const auto in_fold = [&](const Vec3f& share) {
      shares.share = share;
      return irradiance_in_fold(albedo, share * open, reflected, shares) - share * open;
    };
    const Vec3f one = share_of_sky(receiver, random), other = share_of_sky(receiver, random);
    const Vec3f whole = in_fold((one + other) / 2) * 2 - (in_fold(one) + in_fold(other)) / 2;
    light.radiance += albedo * (whole - reflected) / pi;
    light.rays += 2 * static_cast<int>(sky_rays);
  }

  /// Of what would come from the sky, by a few rays.
  Vec3f share_of_sky(const Receiver& receiver, Random& random) const {
    const Shading& shading = receiver.shading;
    const Frame frame(shading.shading_normal);
    const float u = random.uniform(), v = random.uniform();
    Vec3f all{}, seen{};
    for (size_t i = 0; i < sky_rays; i++) {
      Vec3f direction = frame.to_world(cosine_direction(i, sky_rays, u, v));
      // Folded up as the reflection of Shading is.
      direction += shading.normal * (2 * std::max(0.0f, -dot(direction, shading.normal)));
      const Vec3f radiance = world_.lights().environment().radiance(direction);
      const Arrival arrival{.direction = direction, .distance = std::numeric_limits<float>::infinity()};
      all += radiance;
      seen += radiance * visibility(world_.surfaces(), receiver.position, shading.normal, arrival, random);
    }
    Vec3f share = Vec3f::filled(1);
    for (size_t c = 0; c < 3; c++)
      if (all[c] > 0) share[c] = seen[c] / all[c];
    return share;
  }

  static constexpr size_t sky_rays = 4;

  const World& world_;
  const IntegratorOptions& options_;
  Moments open_sky_;
  Vec3f mean_of_sky_{};
  const DirectLight direct_;
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
