// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "lightwell/gltf/json.h"
#include "lightwell/light/grid.h"
#include "lightwell/light/light_field.h"

namespace lightwell {

/// LIGHTWELL_light_grids of docs/format.md: the grids of a pack, each carried by a light stream.
inline constexpr const char* grids_extension = "LIGHTWELL_light_grids";

/// What the JSON says of a grid.
struct GridDescription {
  uint32_t stream = 0;
  GridShape shape;
  uint32_t codec = 0;  ///< of the stream
  float normal_offset = 0;
  float estimated_error = 0;  ///< share of the root mean square irradiance
  int priority = 0;           ///< where grids overlap, the one of greater priority is looked up
  GridContents contains;
};

/// The extension's JSON.
Json to_json(std::span<const GridDescription> grids);

/// Reads the extension from the JSON of a pack. Any JSON gives grids or an error that names the element; whether the
/// streams say the same is for verify_json.
Result<std::vector<GridDescription>> read_grids(const Json& json);

/// What any of the grids holds.
GridContents contents_of(std::span<const GridDescription> grids);

}  // namespace lightwell
