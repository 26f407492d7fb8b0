// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tests/light/light_fields.h"

namespace lightwell {

/// A shape of 2, 4 or 6 cells an axis, away from the origin.
inline GridShape divisible_shape(Random& random) {
  GridShape shape = random_shape(random, 0);
  for (int& n : shape.nodes.e) n = static_cast<int>(3 + 2 * random.below(3));
  return shape;
}

/// Up to `count` bricks at random places, one in another; at least one when any are wanted.
inline BrickTree random_tree(const GridShape& shape, Random& random, int count) {
  BrickTree tree(shape.cells());
  if (count > 0) tree.add({1, {}});
  for (int i = 1; i < count; i++) {
    const int level = 1 + static_cast<int>(random.below(3));
    Brick brick{.level = level, .at = {}};
    for (int a = 0; a < 3; a++)
      brick.at[a] = static_cast<int>(random.below(static_cast<uint32_t>(shape.cells()[a] << (level - 1)) / 2));
    tree.add(brick);
  }
  return tree.ordered();
}

/// The light of a field at every node of a grid and its bricks; light(position) gives moments and validity.
template <typename Field>
LightGrid grid_of_field(const GridShape& shape, const BrickTree& tree, const Field& light) {
  LightGrid grid;
  grid.shape = shape;
  for (size_t i = 0; i < shape.count(); i++) {
    const auto [moments, valid] = light(shape.position(shape.node(i)));
    grid.moments.push_back(moments);
    grid.valid.push_back(valid);
  }
  fill_invalid(grid);
  grid.tree = tree;
  grid.bricks.resize(tree.bricks().size());
  for (uint32_t brick = 0; brick < grid.bricks.size(); brick++) {
    const Brick& cube = tree.bricks()[brick];
    BrickPoints nodes;
    for (int point = 0; point < Brick::points; point++) {
      const Vec3f n = (cube.at * Brick::cells + Brick::local(point)).cast<float>();
      const auto [moments, valid] = light(shape.lo + shape.cell * n * std::ldexp(1.0f, -cube.level));
      nodes[static_cast<size_t>(point)] = {valid ? moments : Moments{}, node_weight(valid)};
    }
    place_brick(grid, brick, nodes);
    fill_invalid(grid.bricks[brick], shape.cell);
  }
  return grid;
}

/// Light of a few lamps; some places are inside of solids.
inline LightGrid bricked_grid(uint64_t seed, int bricks = 12, bool solids = true) {
  Random random(seed, 77);
  const GridShape shape = divisible_shape(random);
  const BrickTree tree = random_tree(shape, random, bricks);
  const Vec3f size = shape.hi() - shape.lo, lamp = shape.lo + size * random_colour(random);
  const Vec3f colour = random_colour(random) + Vec3f::filled(0.1f), solid = shape.lo + size * random_colour(random);
  return grid_of_field(shape, tree, [&](const Vec3f& p) {
    Moments m = uniform_light({{0.2f, 0.15f, 0.1f}});
    const Vec3f to = lamp - p;
    m += parallel_light(normalized(to), colour * (dot(size, size) / (dot(to, to) + 0.05f * dot(size, size))));
    return std::pair(m, !solids || length((p - solid) / size) > 0.3f);
  });
}

}  // namespace lightwell
