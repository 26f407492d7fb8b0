// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/bake/free_space.h"
#include "lightwell/light/grid.h"

namespace lightwell {

/// The grid over a box with `longest` nodes on its longest axis (GridShape::over), and up to an eighth
/// more, rounded up, on each axis where that puts nodes into walls, or onto sheets, that would otherwise lie between
/// nodes. A wall thinner than a cell leaks where floors and ceilings meet it: a lookup beside it interpolates between
/// the nodes of the two rooms, and only a node inside the wall, which is invalid, keeps them apart
/// (docs/decisions/010-thin-walls.md).
GridShape grid_of_walls(const World& world, const FreeSpace& space, const Box3f& box, int longest);

/// The grids that may suit a part of a scene, to be chosen from by how much each errs: over its box, and where there is
/// light outside of it, of a sky or of the rest of the scene, over the box with a margin, or with nodes on its faces
/// and a layer of them outside: then no cell holds both sides of a sheet that stands on a face, as the walls of rooms
/// without thickness do.
std::vector<GridShape> possible_grids(const World& world, const FreeSpace& space, const Box3f& box, int longest);

/// True for a node inside a wall thinner than a cell: along some axis, rays both ways hit the back of a solid within
/// half a cell. Its box would mix the light of both sides.
bool is_in_thin_wall(const TraceScene& scene, const FreeSpace& space, const GridShape& shape, size_t node);

}  // namespace lightwell
