// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "lightwell/gltf/json.h"
#include "lightwell/light/error_estimate.h"
#include "lightwell/light/grid.h"
#include "lightwell/light/light_field.h"

namespace lightwell {

/// The LIGHTWELL_light_grids extension (docs/format.md): the light grids of a pack, each carried by a light stream.
inline constexpr const char* grids_extension = "LIGHTWELL_light_grids";

/// A stream of bricks of a light grid, and a box that holds them, in the grid's space.
struct BricksDescription {
  uint32_t stream = 0;
  Vec3f lo{}, hi{};

  bool operator==(const BricksDescription&) const = default;
};

/// The box of a region of a grid's bricks.
BricksDescription describe_bricks(const GridShape& shape, const BrickRegion& region, uint32_t stream);

/// A light grid as the JSON describes it.
struct GridDescription {
  uint32_t stream = 0;
  GridShape shape;
  uint32_t codec = 0;  ///< of that stream
  float normal_offset = 0;
  float estimated_error = 0;  ///< root mean square error as a share of the mean irradiance
  ErrorEstimate estimate{};
  int priority = 0;  ///< where grids of the same contents overlap, the highest priority is looked up
  GridContents contains;
  std::vector<BricksDescription> bricks{};  ///< of each region, where regions have streams of their own

  bool operator==(const GridDescription&) const = default;
};

/// The grids as the extension's JSON.
Json to_json(std::span<const GridDescription> grids);

/// Reads the extension from a pack's JSON. Invalid input yields an error naming the element. verify_json checks that
/// the streams agree.
Result<std::vector<GridDescription>> read_grids(const Json& json);

/// The union of the contents of all grids.
GridContents contents_of(std::span<const GridDescription> grids);

}  // namespace lightwell
