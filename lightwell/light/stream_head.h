// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/base/bytes.h"
#include "lightwell/base/result.h"
#include "lightwell/light/grid.h"

namespace lightwell {

// What the parameters of all light streams have in common (docs/format.md).

void write_shape(ByteWriter& writer, const GridShape& shape);
/// Not checked yet.
GridShape read_shape(ByteReader& reader);

/// Fails for a grid, a normal offset or a scale that no encoder writes.
Result<void> check_head(const GridShape& shape, float normal_offset, float scale);

}  // namespace lightwell
