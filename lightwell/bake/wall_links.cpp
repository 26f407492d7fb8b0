// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/wall_links.h"

#include "lightwell/bake/gathered_light.h"
#include "lightwell/bake/lookup_sides.h"
#include "lightwell/base/parallel.h"

namespace lightwell {
namespace {

/// The links of nodes[0] ... that are blocked and join valid nodes. `next` is the distance to the neighbour on an axis.
template <typename Valid>
uint8_t between_valid(uint8_t links, size_t node, const std::array<size_t, 3>& next, const Valid& valid) {
  if (links == 0) return 0;
  uint8_t kept = 0;
  for (size_t axis = 0; axis < 3; axis++)
    if ((links >> axis & 1) != 0 && valid(node) && valid(node + next[axis])) kept |= static_cast<uint8_t>(1 << axis);
  return kept;
}

}  // namespace

bool WallLinks::blocked(const Vec3f& node, const Vec3f& cell, int axis, uint64_t seed) const {
  Vec3f beyond = node;
  beyond[axis] += cell[axis];
  const Vec3f from = viewpoint(box_, node, cell), way = viewpoint(box_, beyond, cell) - from;
  const float length = std::sqrt(dot(way, way));
  Random random(seed, static_cast<uint64_t>(axis));
  Hit hit;
  return scene_.intersect({.origin = from, .direction = way / length, .far = length}, random, hit);
}

void WallLinks::follow(const GridShape& shape, const BrickTree& tree, int threads) {
  const auto trace = [&](const Vec3i& n, const Vec3i& nodes, const Vec3f& node, const Vec3f& cell, uint64_t seed) {
    uint8_t found = 0;
    for (int axis = 0; axis < 3; axis++)
      if (n[axis] + 1 < nodes[axis] && blocked(node, cell, axis, seed)) found |= static_cast<uint8_t>(1 << axis);
    return found;
  };
  if (links_.nodes.empty()) {
    links_.nodes.resize(shape.count());
    parallel_for(shape.count(), 256, threads, [&](size_t begin, size_t end, int) {
      for (size_t i = begin; i < end; i++) {
        const Vec3i n = shape.node(i);
        links_.nodes[i] = trace(n, shape.nodes, shape.position(n), shape.cell, i);
      }
    });
  }
  const size_t known = links_.bricks.size();
  links_.bricks.resize(tree.bricks().size());
  if (links_.bricks.size() <= known) return;
  parallel_for(links_.bricks.size() - known, 4, threads, [&](size_t begin, size_t end, int) {
    for (size_t i = known + begin; i < known + end; i++) {
      const Brick& brick = tree.bricks()[i];
      const Vec3f cell = shape.cell * std::ldexp(1.0f, -brick.level);
      for (int point = 0; point < Brick::points; point++)
        links_.bricks[i][static_cast<size_t>(point)] =
            trace(Brick::local(point), Vec3i::filled(Brick::side), shape.lo + cell * brick.corner(point).cast<float>(),
                  cell, i * Brick::points + static_cast<size_t>(point));
    }
  });
}

void WallLinks::for_each_blocked(const GridShape& shape, const BrickTree& tree,
                                 const std::function<void(uint64_t, uint64_t)>& visit) const {
  const auto visit_links = [&](uint8_t links, int level, const Vec3i& corner) {
    for (int axis = 0; links != 0 && axis < 3; axis++) {
      Vec3i next = corner;
      next[axis]++;
      if ((links >> axis & 1) != 0) visit(lattice_place(level, corner), lattice_place(level, next));
    }
  };
  for (size_t i = 0; i < links_.nodes.size(); i++) visit_links(links_.nodes[i], 0, shape.node(i));
  for (size_t i = 0; i < tree.bricks().size(); i++)
    for (int point = 0; point < Brick::points; point++)
      visit_links(links_.bricks[i][static_cast<size_t>(point)], tree.bricks()[i].level, tree.bricks()[i].corner(point));
}

Links WallLinks::of(const LightGrid& grid) const {
  Links links{.nodes = links_.nodes, .bricks = {}};
  const auto row = static_cast<size_t>(grid.shape.nodes[0]);
  const std::array<size_t, 3> next{1, row, row * static_cast<size_t>(grid.shape.nodes[1])};
  for (size_t i = 0; i < links.nodes.size(); i++)
    links.nodes[i] = between_valid(links.nodes[i], i, next, [&](size_t node) { return grid.valid[node] != 0; });
  constexpr std::array<size_t, 3> next_point{1, Brick::side, size_t(Brick::side) * Brick::side};
  for (size_t brick = 0; brick < grid.bricks.size(); brick++) {
    Links::Points points = links_.bricks[brick];
    for (size_t i = 0; i < points.size(); i++)
      points[i] = between_valid(points[i], i, next_point,
                                [&](size_t point) { return grid.bricks[brick][point].weight > node_weight(false); });
    links.bricks.push_back(points);
  }
  return links;
}

}  // namespace lightwell
