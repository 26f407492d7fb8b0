// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/thin_walls.h"

#include "lightwell/bake/sheets.h"
#include "lightwell/bake/tracks.h"
#include "lightwell/light/stream.h"

namespace lightwell {
namespace {

/// In a coarser grid two layers would be a large part of all nodes.
constexpr int least_with_layers = 10;
constexpr int lines = 24;                              // probe lines along an axis, counted on each of the two others
constexpr int most_walls = 64;                         // on a line
constexpr double worth_a_node = 0.05 * lines * lines;  // walls that must gain a node before an axis gets more nodes

/// Where a line enters and leaves a solid, in metres from the region's face; the same at a sheet.
struct Wall {
  float from, to;
};

/// Adds the walls on a line that are thinner than `thickness`.
void add_walls(const TraceScene& scene, const FreeSpace& space, Ray line, float thickness, std::vector<Wall>& walls) {
  Random random(0, 0);
  float travelled = 0;
  float entered = -1;
  for (int i = 0; i < 2 * most_walls; i++) {
    Hit hit;
    if (!scene.intersect(line, random, hit)) return;
    const float at = travelled + hit.distance;
    if (!hit.front && entered >= 0 && at - entered < thickness) walls.push_back({entered, at});
    if (is_sheet(scene, space, hit, line.direction, random)) walls.push_back({at, at});
    entered = hit.front ? at : -1;
    travelled = at + scene.offset();
    line.origin += line.direction * (hit.distance + scene.offset());
    line.far -= hit.distance + scene.offset();
    if (line.far <= 0) return;
  }
}

/// The thin walls on lines along an axis that are spread evenly over the region.
std::vector<Wall> walls_across(const TraceScene& scene, const FreeSpace& space, const Box3f& region, int axis,
                               float thickness) {
  std::vector<Wall> walls;
  const int side = (axis + 1) % 3, other = (axis + 2) % 3;
  for (int i = 0; i < lines * lines; i++) {
    Ray line{.far = region.size()[axis]};
    line.direction[axis] = 1;
    line.origin = region.lo;
    const int column = i % lines, row = i / lines;
    line.origin[side] += region.size()[side] * (static_cast<float>(column) + 0.5f) / lines;
    line.origin[other] += region.size()[other] * (static_cast<float>(row) + 0.5f) / lines;
    add_walls(scene, space, line, thickness, walls);
  }
  return walls;
}

/// How many walls no node keeps apart, for nodes a distance of `cell` apart: one in which, or on which, a node lies
/// counts nothing, a sheet half-way between two nodes one, others by their distance from the next node.
double missed(const std::vector<Wall>& walls, float cell) {
  double count = 0;
  for (const auto& [from, to] : walls) {
    const float margin = 1e-3f * cell;
    const bool has_node = std::ceil((from + margin) / cell) * cell <= to - margin;
    const float middle = (from + to) / 2 / cell;
    if (!has_node) count += static_cast<double>(2 * std::abs(middle - std::round(middle)));
  }
  return count;
}

}  // namespace

GridShape grid_of_walls(const World& world, const FreeSpace& space, const Box3f& region, int longest) {
  GridShape shape = GridShape::over(region, longest);
  const Vec3f size = shape.hi() - shape.lo;
  for (int axis = 0; axis < 3; axis++) {
    const std::vector<Wall> walls = walls_across(world.surfaces(), space, region, axis, shape.cell[axis]);
    const auto missed_by = [&](int nodes) { return missed(walls, size[axis] / static_cast<float>(nodes - 1)); };
    const int fewest = shape.nodes[axis];
    const size_t in_a_layer = shape.count() / static_cast<size_t>(fewest);
    const int most = std::min({fewest + (fewest + 7) / 8, LightLayout::most_nodes_an_axis,
                               static_cast<int>(LightLayout::most_nodes / in_a_layer)});
    int best = fewest;
    for (int nodes = fewest + 1; nodes <= most; nodes++)
      if (missed_by(nodes) + worth_a_node <= missed_by(best)) best = nodes;
    shape.nodes[axis] = best;
    shape.cell[axis] = size[axis] / static_cast<float>(best - 1);
  }
  return shape;
}

std::vector<GridShape> possible_grids(const World& world, const FreeSpace& space, const Box3f& box, int longest) {
  const bool open = !world.lights().environment().black() || box != world.surfaces().bounds();
  std::vector<GridShape> grids{grid_of_walls(world, space, LightRegion(box, open).box(), longest)};
  if (!open || longest < least_with_layers) return grids;
  GridShape& layered = grids.emplace_back(grid_of_walls(world, space, box, longest - 2));
  layered.lo -= layered.cell;
  layered.nodes += Vec3i::filled(2);
  return grids;
}

bool is_in_thin_wall(const TraceScene& scene, const FreeSpace& space, const GridShape& shape, size_t node) {
  const Vec3f position = node_box(shape, node).center();  // inside the region, also for a node on its face
  Random random(0, node);
  const auto meets_back = [&](int axis, float way) {
    Ray ray{.origin = position, .far = shape.cell[axis] / 2};
    ray.direction[axis] = way;
    Hit hit;
    return scene.intersect(ray, random, hit) && space.from_inside(hit);
  };
  for (int axis = 0; axis < 3; axis++)
    if (meets_back(axis, 1) && meets_back(axis, -1)) return true;
  return false;
}

}  // namespace lightwell
