// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "lightwell/base/vector.h"

namespace lightwell {

/// Sunlight in clear air and the haze in it, in all orders of scattering, over a round earth. Colours are the
/// wavelengths 680, 550 and 440 nm. Lengths are kilometres; places are counted from the middle of the earth, and the
/// sun stands in the plane of x and y. Light is that of a sun whose irradiance is 1 outside of the air.
///
/// Scattering and its constants: E. Bruneton, F. Neyret, "Precomputed Atmospheric Scattering", EGSR 2008, equations 1
/// to 4 and 10. Ozone, and the light that was scattered more than once: S. Hillaire, "A Scalable and Production Ready
/// Sky and Atmosphere Rendering Technique", EGSR 2020, table 1 and equations 5 to 10. Haze by turbidity: A. J.
/// Preetham, P. Shirley, B. Smits, "A Practical Analytic Model for Daylight", SIGGRAPH 1999, appendix A.1.
class Atmosphere {
 public:
  /// `sun_cosine` is the cosine of the sun's angle to the zenith, over the place on the ground from which the sky is
  /// seen.
  Atmosphere(double turbidity, double sun_cosine);

  /// Of the ground all around: what it reflects, evenly (Bruneton and Neyret).
  static constexpr double ground_albedo = 0.1;
  /// The place on the ground from which the sky is seen.
  static Vec3d ground();
  /// The unit direction towards a sun at this cosine to the zenith.
  static Vec3d towards(double cosine);
  /// What is left of the light that comes to a place from outer space; black where the earth is in the way.
  Vec3d transmittance(const Vec3d& place, const Vec3d& direction) const;

  /// The light that the air sends to the ground from a direction above the horizon, by the kind of its last scattering.
  struct Scattered {
    Vec3d by_air{}, by_haze{};  ///< of sunlight, without the phase function
    Vec3d again{};              ///< of light that had been scattered before: radiance
  };
  Scattered scattered(const Vec3d& direction) const;
  /// The radiance of scattered light whose direction has this cosine to the sun's.
  static Vec3d radiance(const Scattered& light, double cosine);

 private:
  struct Densities;

  Vec3d extinction(const Densities& densities) const;
  Vec3d scattering(const Densities& densities) const;
  template <typename Step>
  Vec3d march(const Vec3d& from, const Vec3d& direction, double length, const Step& step) const;
  Vec3d scattered_before(double height) const;
  Vec3d mean_of_scattered_before(double height) const;

  static constexpr size_t heights = 16;

  Vec3d haze_;  ///< extinction at sea level, 1/km
  Vec3d sun_;
  std::array<Vec3d, heights> before_{};  ///< mean radiance of light that has been scattered, by height
};

}  // namespace lightwell
