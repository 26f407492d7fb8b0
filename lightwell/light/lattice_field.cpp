// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "lightwell/base/assert.h"
#include "lightwell/light/lattice_stream.h"

namespace lightwell {
namespace {

std::vector<BrickParent> parents_of(int point) {
  std::vector<BrickParent> parents;
  const Vec3i local = Brick::local(point);
  for (int axis = 0; axis < 3; axis++) {
    if (local[axis] % 2 == 0) continue;
    for (const int step : {-1, 1}) {
      Vec3i place = local;
      place[axis] += step;
      const int parent = Brick::point(place);
      parents.push_back({parent, axis, step < 0 ? parent : point});
    }
  }
  return parents;
}

}  // namespace

LatticeField::LatticeField(const LatticeLayout& layout)
    : record_(layout.make_record()),
      tree_(layout.tree),
      grid_nodes_(layout.shape.nodes),
      order_(lattice_order(layout.shape.nodes)),
      nodes_(layout.tree, layout.regions),
      values_(layout.shape.count(), record_->numbers().size()),
      points_(layout.tree.bricks().size() * Brick::points, record_->numbers().size()),
      finer_(finer_points()) {
  for (size_t i = 0; i < 8; i++) std::ranges::copy(layout.corners[i], node(order_[i].node).begin());
  if (layout.links.empty()) return;
  links_.nodes = read_links(grid_nodes_, layout.links);
  links_.bricks.resize(layout.tree.bricks().size());
}

void LatticeField::fill(LightGrid& grid, size_t known) const {
  for (size_t i = known; i < order_.size(); i++) {
    const LatticeNode& place = order_[i];
    const LatticeParents around = parents(place);
    float weights = 0, every = 0;
    Moments sum, of_all;
    size_t valid = 0;
    const auto add = [&](size_t parent, float weight) {
      const Moments& light = grid.moments[place.parents[parent]];
      const bool is_valid = grid.valid[place.parents[parent]] != 0;
      valid += is_valid;
      of_all += light * weight;
      every += weight;
      if (!is_valid || around.all()[parent].blocked) return;
      sum += light * weight;
      weights += weight;
    };
    // Parents come in pairs, before and after on an axis; the nearer one counts more.
    for (size_t pair = 0; pair < place.parent_count; pair += 2) {
      const auto before = static_cast<float>(place.node - place.parents[pair]);
      const auto after = static_cast<float>(place.parents[pair + 1] - place.node);
      add(pair, after / (before + after));
      add(pair + 1, before / (before + after));
    }
    grid.moments[place.node] = weights > 0 ? sum * (1 / weights) : of_all * (1 / every);
    grid.valid[place.node] = 2 * valid >= place.parent_count;
  }
}

LatticeParents LatticeField::parents(const LatticeNode& node) const {
  LatticeParents parents;
  const auto row = static_cast<uint32_t>(grid_nodes_[0]), layer = row * static_cast<uint32_t>(grid_nodes_[1]);
  for (size_t i = 0; i < node.parent_count; i++) {
    const uint32_t parent = node.parents[i], apart = std::max(parent, node.node) - std::min(parent, node.node);
    const int axis = apart % layer == 0 ? 2 : apart % row == 0 ? 1 : 0;
    const bool blocked = !links_.nodes.empty() && blocked_between(links_.nodes, grid_nodes_, parent, node.node, axis);
    parents.add({values_[parent].data(), static_cast<uint8_t>(axis), blocked});
  }
  return parents;
}

LatticeParents LatticeField::parents(uint32_t brick, int point) const {
  LatticeParents parents;
  for (const BrickParent& parent : brick_parents(point))
    parents.add({points_[place_of(brick, parent.point)].data(), static_cast<uint8_t>(parent.axis), false});
  return parents;
}

void LatticeField::keep_links(uint32_t brick, int point, const LatticeParents& parents) {
  if (links_.bricks.empty()) return;
  const std::vector<BrickParent>& around = brick_parents(point);
  for (size_t i = 0; i < around.size(); i++)
    if (parents.all()[i].blocked)
      links_.bricks[brick][static_cast<size_t>(around[i].first)] |= static_cast<uint8_t>(1 << around[i].axis);
}

const std::vector<BrickParent>& brick_parents(int point) {
  static const std::vector<std::vector<BrickParent>> of_points = [] {
    std::vector<std::vector<BrickParent>> table;
    for (int p = 0; p < Brick::points; p++) table.push_back(parents_of(p));
    return table;
  }();
  return of_points[static_cast<size_t>(point)];
}

void LatticeField::take_corners(uint32_t brick) {
  const Brick& cube = tree_.bricks()[brick];
  const Vec3i around{{cube.at[0] >> 1, cube.at[1] >> 1, cube.at[2] >> 1}};
  const auto coarser = cube.level > 1 ? tree_.find({cube.level - 1, around}) : std::nullopt;
  LW_ASSERT(cube.level == 1 || coarser);
  const Vec3i first = cube.at * 2 - (coarser ? around * Brick::cells : Vec3i{});
  for (int point = 0; point < Brick::points; point++) {
    const Vec3i local = Brick::local(point);
    if ((local[0] | local[1] | local[2]) & 1) continue;
    const Vec3i corner = first + Vec3i{{local[0] / 2, local[1] / 2, local[2] / 2}};
    const auto numbers =
        coarser ? points_[place_of(*coarser, Brick::point(corner))] : values_[node_index(grid_nodes_, corner)];
    std::ranges::copy(numbers, points_[place_of(brick, point)].begin());
  }
}

size_t LatticeBundle::nodes(const LatticeField& field, size_t done) {
  return std::min(wanted, field.order().size() - done);
}

uint32_t LatticeBundle::bricks(const LatticeField& field, const BrickRegion& region, uint32_t done) {
  const auto& first = field.nodes().first();
  const uint32_t begin = region.begin + done;
  uint32_t end = begin;
  while (end < region.end && first[end] - first[begin] < wanted) end++;
  return end - begin;
}

}  // namespace lightwell
