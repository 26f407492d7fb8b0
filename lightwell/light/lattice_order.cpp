// SPDX-License-Identifier: Apache-2.0
#include "lightwell/light/lattice_order.h"

#include <algorithm>
#include <numeric>

namespace lightwell {
namespace {

/// A number of an axis: when its bisection comes to it, and between which two it lies.
struct AxisNode {
  int level = 0;
  int before = 0, after = 0;
};

std::vector<AxisNode> bisect(int count) {
  std::vector<AxisNode> axis(static_cast<size_t>(count));
  std::vector<std::array<int, 2>> gaps{{0, count - 1}};
  for (int level = 1; !gaps.empty(); level++) {
    std::vector<std::array<int, 2>> finer;
    for (const auto& [before, after] : gaps) {
      if (after - before < 2) continue;
      const int middle = (before + after) / 2;
      axis[static_cast<size_t>(middle)] = {level, before, after};
      finer.push_back({before, middle});
      finer.push_back({middle, after});
    }
    gaps = std::move(finer);
  }
  return axis;
}

/// A step through `count` nodes that comes to each once and scatters them: about the golden section, with no divisor in
/// common.
size_t scattering_step(size_t count) {
  size_t step = count * 5 / 8 | 1;
  while (std::gcd(step, count) != 1) step += 2;
  return step;
}

}  // namespace

std::vector<LatticeNode> lattice_order(const Vec3i& nodes) {
  const std::array<std::vector<AxisNode>, 3> axes{bisect(nodes[0]), bisect(nodes[1]), bisect(nodes[2])};
  const GridShape shape{.lo = {}, .cell = {}, .nodes = nodes};
  const auto level_of = [&](const Vec3i& n) {
    int level = 0;
    for (size_t a = 0; a < 3; a++) level = std::max(level, axes[a][static_cast<size_t>(n.e[a])].level);
    return level;
  };
  // How many nodes each level has with each number of divided axes, then where they begin.
  constexpr size_t kinds = 4;
  const auto divided = [&](const Vec3i& n, int level) {
    size_t count = 0;
    for (size_t a = 0; a < 3; a++) count += level > 0 && axes[a][static_cast<size_t>(n.e[a])].level == level;
    return count;
  };
  std::vector<size_t> begin;
  const size_t count = shape.count();
  for (size_t i = 0; i < count; i++) {
    const Vec3i n = shape.node(i);
    const int level = level_of(n);
    const size_t group = static_cast<size_t>(level) * kinds + divided(n, level);
    if (begin.size() < group + 2) begin.resize(group + 2);
    begin[group + 1]++;
  }
  for (size_t group = 1; group < begin.size(); group++) begin[group] += begin[group - 1];

  std::vector<LatticeNode> order(count);
  const size_t step = scattering_step(count);
  for (size_t k = 0, i = 0; k < count; k++, i = (i + step) % count) {
    const Vec3i n = shape.node(i);
    const int level = level_of(n);
    LatticeNode node{.node = static_cast<uint32_t>(i), .parent_count = 0, .parents = {}};
    for (size_t a = 0; a < 3; a++) {
      const AxisNode& on_axis = axes[a][static_cast<size_t>(n.e[a])];
      if (level == 0 || on_axis.level < level) continue;
      for (const int end : {on_axis.before, on_axis.after}) {
        Vec3i parent = n;
        parent.e[a] = end;
        node.parents[node.parent_count++] = static_cast<uint32_t>(shape.index(parent));
      }
    }
    const size_t group = static_cast<size_t>(level) * kinds + divided(n, level);
    // The corners come x fastest.
    const size_t place = level == 0 ? (n[0] > 0) + 2 * (n[1] > 0) + 4 * (n[2] > 0) : begin[group]++;
    order[place] = node;
  }
  return order;
}

}  // namespace lightwell
