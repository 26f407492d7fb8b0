// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "lightwell/base/bytes.h"
#include "lightwell/light/grid.h"

namespace lightwell {

/// The links of a grid's own nodes (Links::nodes) as a run of the range coder. Nothing where all are open, those of
/// bricks too.
std::vector<uint8_t> write_links(const LightGrid& grid);
/// What write_links() gives; safe for any bytes. All open when there are none.
std::vector<uint8_t> read_links(const Vec3i& nodes, Bytes bytes);

/// Whether a link between two nodes on a line of the grid along an axis is blocked.
bool blocked_between(const std::vector<uint8_t>& links, const Vec3i& nodes, size_t a, size_t b, int axis);

/// Both ends of each blocked link, one after the other, in the grid's space: of the grid's own nodes and of bricks,
/// each where no finer cells lie.
std::vector<Vec3f> blocked_links(const LightGrid& grid);

}  // namespace lightwell
