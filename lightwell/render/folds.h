// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/base/vector.h"

namespace lightwell {

/// How the sky's light at a place is found in two ways. Each colour by itself.
struct SkyInFold {
  Vec3f open{};      ///< irradiance where nothing would hide the sky
  Vec3f mean{};      ///< the mean of that over all normals
  Vec3f in_cells{};  ///< irradiance as the cells of a grid have it
  Vec3f share{};     ///< of `open`, that gets there past what rays meet
};

/// The irradiance E of a place where the `sky`'s light is found by rays, and what surfaces reflect in cells, which blur
/// what is smaller than they are, such as a fold. What surfaces within the cell hide more than it knows, or less, is
/// `hidden`, the share of the sky's light that its own cells have less `share`. Those surfaces are as bright as the
/// place itself, so that E = sky + reflected + albedo hidden E; never less than the sky's light alone. In a hollow ball
/// under a uniform sky, of which the cells know nothing, that is exact. Where little of the sky's light would come from
/// at all, shares of it tell nothing: `hidden` is 0 there. What is whiter than 0.95, and closed, is nothing that cells
/// can tell.
Vec3f irradiance_in_fold(const Vec3f& albedo, const Vec3f& sky, const Vec3f& reflected, const SkyInFold& shares);

}  // namespace lightwell
