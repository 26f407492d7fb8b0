// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "lightwell/trace/environment.h"

namespace lightwell {

/// The irradiance of an environment that nothing hides, by the first nine spherical harmonics, as the web viewer has it
/// (R. Ramamoorthi, P. Hanrahan, An Efficient Representation for Irradiance Environment Maps, 2001).
class OpenSky {
 public:
  explicit OpenSky(const EnvironmentLight& environment);

  /// Of a surface with a unit normal, W/m2; not negative.
  Vec3f irradiance(const Vec3f& normal) const;
  /// Its mean over all normals.
  Vec3f mean() const;

 private:
  /// Of n = (x, y, z, 1): the irradiance is n M n.
  std::array<std::array<Vec3f, 4>, 4> matrix_{};
};

}  // namespace lightwell
