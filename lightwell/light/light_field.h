// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "lightwell/light/grid.h"

namespace lightwell {

/// The light that a grid holds.
struct GridContents {
  bool indirect = true;      ///< after at least one reflection
  bool environment = false;  ///< direct light of the environment
  bool lamps = false;        ///< direct light of the luminaires that no client computes itself
  std::string group{};       ///< of the luminaires whose light it is; empty: of all

  bool operator==(const GridContents&) const = default;
};

/// The baked light of a scene: a list of grids.
class LightField {
 public:
  struct Layer {
    LightGrid grid;
    GridContents contents;
    int priority = 0;
  };

  LightField() = default;
  explicit LightField(std::vector<Layer> layers);

  bool empty() const { return layers_.empty(); }
  /// The grids by decreasing priority.
  const std::vector<Layer>& layers() const { return layers_; }

  /// Irradiance (W/m2, RGB) as LightGrid::irradiance. Of grids with the same contents, the one of highest priority
  /// whose box contains the point is looked up, or else the one of lowest priority, which reaches farthest. Light of
  /// different contents adds up.
  Vec3f irradiance(const Vec3f& point, const Vec3f& offset_normal, const Vec3f& direction) const;

 private:
  std::vector<Layer> layers_;
};

}  // namespace lightwell
