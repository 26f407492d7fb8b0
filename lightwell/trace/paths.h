// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/trace/shading.h"
#include "lightwell/trace/world.h"

namespace lightwell {

/// Where light is received: a surface point seen from a direction.
struct Receiver {
  Vec3f position{};  ///< on the surface, or in free space
  Shading shading;   ///< its normals are on the side that receives

  /// A receiver whose reflected radiance equals the irradiance of a surface with this normal.
  static Receiver irradiance(const Vec3f& position, const Vec3f& normal);
  /// The surface that a ray along `direction` has hit.
  static Receiver seen(const TraceScene& surfaces, const Hit& hit, const Surface& surface, const Vec3f& direction);
};

/// Collects the light that a receiver reflects towards the viewer, in the portions that a path finds.
class ReceivedLight {
 public:
  virtual ~ReceivedLight() = default;
  /// Adds light of a luminaire (an index into Lights::luminaires()) after `bounces` reflections before the receiver; 0
  /// is straight from the source.
  virtual void add(int luminaire, int bounces, const Vec3f& light) = 0;
};

/// Received light in two sums: direct, and after at least one reflection. Direct light of the luminaires `left_out`,
/// such as those whose light a grid holds, is in neither. The light of each luminaire is multiplied by its factor.
class DirectAndIndirect : public ReceivedLight {
 public:
  /// Set and factors must outlive this.
  explicit DirectAndIndirect(const LuminaireSet& left_out, const LuminaireFactors& factors = as_they_are)
      : left_out_(left_out), factors_(factors) {}
  void add(int luminaire, int bounces, const Vec3f& light) override {
    if (bounces > 0)
      indirect += light * factors_.of(luminaire);
    else if (!left_out_.contains(luminaire))
      direct += light * factors_.of(luminaire);
  }

  Vec3f direct{}, indirect{};

 private:
  const LuminaireSet& left_out_;
  const LuminaireFactors& factors_;
};

/// Received light, summed by the luminaire that it comes from.
class LightByLuminaire : public ReceivedLight {
 public:
  struct Sums {
    Vec3f direct{}, indirect{};
  };

  explicit LightByLuminaire(const Lights& lights) : sums(lights.luminaires().size()) {}
  void add(int luminaire, int bounces, const Vec3f& light) override {
    Sums& of_luminaire = sums[static_cast<size_t>(luminaire)];
    (bounces > 0 ? of_luminaire.indirect : of_luminaire.direct) += light;
  }

  std::vector<Sums> sums;  ///< one for each luminaire
};

/// Traces a path from the receiver. Every vertex takes one sample of the lights and one of the surface, weighted by the
/// power heuristic (Veach and Guibas, Optimally Combining Sampling Techniques, SIGGRAPH 1995). Unbiased for light with
/// up to `max_bounces` reflections before the receiver; 0 is direct light only. Returns the number of rays traced.
int trace_path(const World& world, const Receiver& receiver, int max_bounces, Random& random, ReceivedLight& received);

}  // namespace lightwell
