// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "lightwell/render/picture.h"
#include "lightwell/scene/client_lamp.h"
#include "lightwell/trace/paths.h"

namespace lightwell {

/// Which lamps light a picture by their shapes, as on the page, and how well.
struct LampSampling {
  std::vector<ClientLamp> lamps;
  int most_points = 0;  ///< of a lamp, for a receiver; 0: all luminaires are sampled at random
  /// How the picture will be shown: a lamp's points end where more of them would not be seen. Without it none is left
  /// out.
  std::optional<Display> shown;
};

/// The light of lamps that surfaces reflect diffusely: what would arrive if nothing were in the way, in closed form,
/// times the ratio of two sums over points of the lamp, of w V and of w (Heitz, Hill and McGuire, Combining Analytic
/// Direct Illumination and Stochastic Shadows, I3D 2018): docs/light.md section 7. A point's weight w is the irradiance
/// by it, V the share of light that a ray finds. Right in the limit of many points, for lamps of the shapes that they
/// are described by. Threads may share it.
class LampLight {
 public:
  /// Of the lamps whose luminaire is in the world and not `left_out`. World, sampling and factors must outlive it.
  LampLight(const World& world, const LampSampling& sampling, const LuminaireSet& left_out,
            const LuminaireFactors& factors);

  /// The luminaires that the lamps stand for.
  const LuminaireSet& luminaires() const { return luminaires_; }

  struct Found {
    Vec3f radiance{};  ///< W/m2/sr, towards the viewer
    int rays = 0;      ///< no more than there are points
  };
  /// `other` is what is known of the receiver's other light, beside which the lamps' is seen. `random` decides which
  /// surfaces that are partly transparent a ray passes.
  Found reflected(const Receiver& receiver, const Vec3f& other, Random& random) const;

 private:
  struct Placed {
    ClientLamp lamp;  // its light multiplied by its factor
    float stray = 0;  // how far the surface that it stands for is from a flat lamp's plane, or a sphere's centre
    float bulb = 0;   // of a lamp without extent: so near to it nothing hides it
    bool extended() const {
      return lamp.kind == ClientLamp::Kind::rectangle || lamp.kind == ClientLamp::Kind::disc ||
             lamp.kind == ClientLamp::Kind::sphere;
    }
  };
  class Estimate;

  static float seen_error(const Display& display, const Estimate& estimate, const Vec3f& whole);

  const World& world_;
  const LampSampling& sampling_;
  std::vector<Placed> lamps_;
  LuminaireSet luminaires_;
};

}  // namespace lightwell
