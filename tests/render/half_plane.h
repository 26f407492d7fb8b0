// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "lightwell/render/lamp_light.h"
#include "tests/trace/scenes.h"

namespace lightwell {

/// A rectangle as the lamp that stands for a world's luminaire.
inline ClientLamp rectangle_lamp(const World& world, size_t luminaire, const Vec3f& half_u, const Vec3f& half_v,
                                 float radiance) {
  const Luminaire& source = world.lights().luminaires().at(luminaire);
  ClientLamp lamp;
  lamp.kind = ClientLamp::Kind::rectangle;
  lamp.center = source.center;
  lamp.normal = normalized(cross(half_u, half_v));
  lamp.half_u = half_u;
  lamp.half_v = half_v;
  lamp.radiance = Vec3f::filled(radiance);
  lamp.two_sided = source.double_sided;
  lamp.luminaire = source.id;
  return lamp;
}

/// A square lamp of 1 m2 and radiance 1, 2 m above a floor, and a half-plane midway that hides from the middle of the
/// floor what is of the lamp on one side of a line through its middle.
class HalfPlane {
 public:
  /// `angle` of the way from what is hidden to what is not, radians.
  explicit HalfPlane(float angle) : across_{{std::cos(angle), 0, std::sin(angle)}} {
    add(*scene_, quad({{-0.5f, 2, -0.5f}}, {{1, 0, 0}}, {{0, 0, 1}}), lambertian(0, 1));
    const Vec3f along = cross(across_, Vec3f{{0, 1, 0}});
    add(*scene_, quad(Vec3f{{0, 1, 0}} - along * 3.0f, along * 6.0f, across_ * -3.0f), lambertian(0));
    world_ = world_of(*scene_);
    sampling_.lamps = {rectangle_lamp(*world_, 0, {{0.5f, 0, 0}}, {{0, 0, 0.5f}}, 1)};
  }

  const World& world() const { return *world_; }
  /// The lamp's, without points so far.
  const LampSampling& sampling() const { return sampling_; }

  /// A receiver on the floor, so far from its middle that a strip of the lamp as wide is seen or hidden beyond half.
  Receiver receiver(float offset) const { return Receiver::irradiance(across_ * offset, {{0, 1, 0}}); }

  /// Its irradiance: Lambert's formula for the polygon that is seen.
  double irradiance(float offset) const {
    const Vec3d place = (across_ * offset).cast<double>(), across = across_.cast<double>();
    const Vec3d corners[] = {{{-0.5, 2, -0.5}}, {{-0.5, 2, 0.5}}, {{0.5, 2, 0.5}}, {{0.5, 2, -0.5}}};
    std::vector<Vec3d> seen;
    for (size_t i = 0; i < 4; i++) {
      const Vec3d &a = corners[i], &b = corners[(i + 1) % 4];
      const double of_a = dot(a + place, across), of_b = dot(b + place, across);
      if (of_a > 0) seen.push_back(a - place);
      if (of_a * of_b < 0) seen.push_back(a + (b - a) * (of_a / (of_a - of_b)) - place);
    }
    double sum = 0;
    for (size_t i = 0; i < seen.size(); i++) {
      const Vec3d a = normalized(seen[i]), b = normalized(seen[(i + 1) % seen.size()]);
      sum += std::acos(std::min(dot(a, b), 1.0)) * normalized(cross(a, b))[1] / 2;
    }
    return std::abs(sum);
  }

 private:
  std::unique_ptr<Scene> scene_ = std::make_unique<Scene>();  // the world refers to it
  Vec3f across_;
  std::unique_ptr<const World> world_;
  LampSampling sampling_;
};

}  // namespace lightwell
