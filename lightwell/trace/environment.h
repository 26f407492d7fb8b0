// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/scene/scene.h"
#include "lightwell/trace/light_region.h"
#include "lightwell/trace/light_sample.h"
#include "lightwell/trace/sampling.h"

namespace lightwell {

/// The environment as a source of light: constant, or a latitude-longitude map sampled in proportion to its radiance.
class EnvironmentLight {
 public:
  EnvironmentLight() = default;
  /// The environment must outlive this.
  explicit EnvironmentLight(const Environment& environment);

  bool black() const { return max_component(mean_) <= 0; }
  /// The mean radiance over all directions, W/m2/sr.
  const Vec3f& mean() const { return mean_; }
  /// Radiance that arrives from a unit direction (pointing towards the environment).
  Vec3f radiance(const Vec3f& direction) const;
  /// The same as a picture shows it, without the borders of pixels: between their middles it changes linearly.
  Vec3f seen(const Vec3f& direction) const;
  struct Sample {
    Vec3f direction{};  ///< unit, towards the environment
    Vec3f radiance{};   ///< W/m2/sr, never black
    float density = 0;  ///< 1/sr
  };
  /// Samples a direction in proportion to its radiance. The environment must not be black.
  Sample sample(Random& random) const;
  /// The density with which sample() chooses a direction, 1/sr.
  float density(const Vec3f& direction) const;

  /// A photon that the environment sends into the region.
  Emission emit(const LightRegion& region, Random& random) const;
  /// The light that arrives from a sampled direction.
  Arrival arrive(Random& random) const;

 private:
  size_t pixel(const Vec3f& direction) const;

  Vec3f scale_{};
  Vec3f mean_{};
  const RadianceImage* map_ = nullptr;
  Distribution pixels_;
};

}  // namespace lightwell
