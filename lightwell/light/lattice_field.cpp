// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "lightwell/base/assert.h"
#include "lightwell/light/lattice_stream.h"

namespace lightwell {

LatticeField::LatticeField(const LatticeLayout& layout)
    : tree_(layout.tree),
      grid_nodes_(layout.shape.nodes),
      order_(lattice_order(layout.shape.nodes)),
      nodes_(layout.tree),
      values_(layout.shape.count()),
      bricks_(layout.tree.bricks().size()),
      finer_(finer_points()) {
  for (size_t i = 0; i < layout.corners.size(); i++) values_[order_[i].node] = layout.corners[i];
}

std::vector<LatticeValue> LatticeField::values(size_t known) const {
  std::vector<LatticeValue> values = values_;
  for (size_t i = known; i < order_.size(); i++) values[order_[i].node] = expect(values, order_[i]).value();
  return values;
}

LatticeExpectation LatticeField::expect(const std::vector<LatticeValue>& values, const LatticeNode& node) {
  std::array<const LatticeValue*, 6> parents;
  for (size_t i = 0; i < node.parent_count; i++) parents[i] = &values[node.parents[i]];
  return LatticeExpectation({parents.data(), node.parent_count});
}

LatticeExpectation LatticeField::expect(const Points& points, int point) {
  std::array<const LatticeValue*, 6> parents;
  size_t count = 0;
  const Vec3i local = Brick::local(point);
  for (int a = 0; a < 3; a++) {
    if (local[a] % 2 == 0) continue;
    for (const int step : {-1, 1}) {
      Vec3i parent = local;
      parent[a] += step;
      parents[count++] = &points[static_cast<size_t>(Brick::point(parent))];
    }
  }
  return LatticeExpectation({parents.data(), count});
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
    bricks_[brick][static_cast<size_t>(point)] = coarser ? bricks_[*coarser][static_cast<size_t>(Brick::point(corner))]
                                                         : values_[node_index(grid_nodes_, corner)];
  }
}

LatticeBundle LatticeBundle::next(const LatticeField& field, size_t base_done, uint32_t bricks_done) {
  LatticeBundle bundle;
  if (base_done < field.order().size()) {
    bundle.base = std::min(wanted, field.order().size() - base_done);
    return bundle;
  }
  const auto& first = field.nodes().first();
  while (bricks_done + bundle.bricks + 1 < first.size() &&
         first[bricks_done + bundle.bricks] - first[bricks_done] < wanted)
    bundle.bricks++;
  return bundle;
}

}  // namespace lightwell
