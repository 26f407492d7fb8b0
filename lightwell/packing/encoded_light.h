// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "lightwell/pack/writer.h"
#include "lightwell/packing/grids_extension.h"
#include "lightwell/packing/pack_light.h"

namespace lightwell {

/// The streams of light grids.
struct EncodedLight {
  std::vector<PackStream> streams;                     ///< of the grids, then of the bricks that are apart
  std::vector<std::vector<BricksDescription>> bricks;  ///< of each grid
};

/// Encodes grids as the first streams of a pack. Fails for grids that a stream cannot hold.
Result<EncodedLight> encode_light(std::span<const PackGrid> grids);

}  // namespace lightwell
