// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lightwell/light/grid.h"

namespace lightwell {

/// A node in the lattice order, and the nodes before it between which it lies: two on each axis that its level divides.
struct LatticeNode {
  uint32_t node = 0;
  uint8_t parent_count = 0;
  std::array<uint32_t, 6> parents{};
};

/// The nodes of a grid from coarse to fine. Each axis is bisected until it is full; a node's level is the greatest of
/// its three axes'. First the eight corners, x fastest, which have no parents; then level by level those that lie on an
/// edge between coarser ones, in a face, in a cell, each in an order that scatters them over the grid.
std::vector<LatticeNode> lattice_order(const Vec3i& nodes);

}  // namespace lightwell
