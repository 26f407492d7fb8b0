// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/light_region.h"

namespace lightwell {
namespace {

/// The margin as a share of the scene's longest side: about a cell of the usual grid.
constexpr float open_margin = 0.04f;

}  // namespace

LightRegion::LightRegion(const Box3f& bounds, bool open_air) : box_(bounds) {
  if (open_air) {
    const auto margin = Vec3f::filled(open_margin * max_component(box_.size()));
    box_.lo -= margin;
    box_.hi += margin;
  }
  center_ = box_.center();
  radius_ = length(box_.size()) / 2;
}

Ray LightRegion::beam_ray(const Vec3f& direction, Random& random) const {
  return {.origin = center_ + (Frame(direction).to_world(sample_disc(random)) - direction) * radius_,
          .direction = direction};
}

}  // namespace lightwell
