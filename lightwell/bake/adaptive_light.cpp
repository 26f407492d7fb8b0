// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/adaptive_light.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "lightwell/base/parallel.h"

namespace lightwell {
namespace {

/// Rounds of dividing, each by what the one before has left; and the finest level.
constexpr int rounds = 6;
constexpr int finest_level = 3;
/// Nodes that a brick adds, about.
constexpr size_t nodes_a_brick = 64;

Vec3i lattice_point(const Brick& brick, int point) { return brick.at * Brick::cells + Brick::local(point); }

/// The number of a node's place: its level and its corner there.
uint64_t key_of(const Brick& brick, int point) {
  uint64_t key = static_cast<uint64_t>(brick.level);
  for (const int c : lattice_point(brick, point).e) key = key << 20 | static_cast<uint64_t>(c);
  return key;
}

/// The brick that would divide the cells at a place; nothing where they are as fine as they may be.
std::optional<Brick> dividing(const BrickTree& tree, const Vec3f& place) {
  const auto finest = tree.finest(place);
  Brick brick{.level = finest ? tree.bricks()[*finest].level + 1 : 1, .at = {}};
  if (brick.level > finest_level) return std::nullopt;
  const float bricks_a_cell = std::ldexp(1.0f, brick.level) / Brick::cells;
  for (int a = 0; a < 3; a++) {
    const int last = (tree.cells()[a] << brick.level) / Brick::cells - 1;
    brick.at[a] = std::clamp(static_cast<int>(place[a] * bricks_a_cell), 0, last);
  }
  return brick;
}

}  // namespace

LightGrid AdaptiveLight::grid(float most_insides) const {
  LightGrid grid;
  grid.shape = shape_;
  grid.moments = nodes_.moments;
  for (size_t node = 0; node < nodes_.insides.size(); node++) {
    grid.valid.push_back(nodes_.insides[node] <= most_insides);
    if (!grid.valid.back()) grid.moments[node] = {};
  }
  fill_invalid(grid);
  grid.tree = tree_;
  grid.bricks.resize(tree_.bricks().size());
  for (uint32_t brick = 0; brick < grid.bricks.size(); brick++) {
    BrickPoints nodes;
    for (const int point : finer_points()) {
      const Node& node = gathered_.at(key_of(tree_.bricks()[brick], point));
      const bool valid = node.insides <= most_insides;
      nodes[static_cast<size_t>(point)] = {valid ? node.moments : Moments{}, node_weight(valid)};
    }
    place_brick(grid, brick, nodes);
    fill_invalid(grid.bricks[brick], shape_.cell);
  }
  return grid;
}

Result<bool> AdaptiveLight::divide(const std::vector<Brick>& bricks, Progress& progress) {
  for (const Brick& brick : bricks) tree_.add(brick);
  const BrickNodes nodes(tree_);
  std::vector<BrickNode> missing;
  for (const BrickNode& node : nodes.nodes())
    if (!gathered_.contains(key_of(tree_.bricks()[node.brick], node.point))) missing.push_back(node);
  std::vector<GatheredLight::Surroundings> found(missing.size());
  parallel_for(
      missing.size(), 16, options_.threads,
      [&](size_t begin, size_t end, int) {
        for (size_t i = begin; i < end; i++) {
          const Brick& brick = tree_.bricks()[missing[i].brick];
          const Vec3f cell = shape_.cell * std::ldexp(1.0f, -brick.level);
          const Vec3f position = shape_.lo + cell * lattice_point(brick, missing[i].point).cast<float>();
          Random random(options_.seed, key_of(brick, missing[i].point));
          found[i] = light_.at_node(position, cell, random);
        }
      },
      [&] { return progress.cancelled(); });
  if (progress.cancelled()) return fail(ErrorKind::cancelled, "light", "cancelled");
  for (size_t i = 0; i < missing.size(); i++) {
    gathered_[key_of(tree_.bricks()[missing[i].brick], missing[i].point)] = {found[i].moments, found[i].insides};
    nodes_.rays += found[i].rays;
  }
  brick_nodes_ = nodes.nodes().size();
  return !missing.empty();
}

/// The bricks that could be added where the grid errs most, summed over the points in each.
std::vector<Brick> AdaptiveLight::worst_bricks(const TestPoints& points, const LightGrid& grid, size_t count) const {
  struct Candidate {
    Brick brick;
    double error = 0;
  };
  std::map<std::array<int, 4>, Candidate> candidates;  // in an order that does not depend on the points'
  for (const TestPoints::Excess& excess : points.excess(grid)) {
    const auto brick = excess.error > 0 ? dividing(tree_, shape_.place_of(excess.position)) : std::nullopt;
    if (!brick) continue;
    Candidate& candidate = candidates[{brick->level, brick->at[0], brick->at[1], brick->at[2]}];
    candidate.brick = *brick;
    candidate.error += static_cast<double>(excess.error);
  }
  std::vector<Candidate> worst;
  for (const auto& [place, candidate] : candidates) worst.push_back(candidate);
  std::stable_sort(worst.begin(), worst.end(),
                   [](const Candidate& a, const Candidate& b) { return a.error > b.error; });
  std::vector<Brick> bricks;
  for (size_t i = 0; i < std::min(count, worst.size()); i++) bricks.push_back(worst[i].brick);
  return bricks;
}

Result<void> AdaptiveLight::refine(const TestPoints& points, const RefinementOptions& options, Progress& progress) {
  const size_t coarse = count();
  const size_t addable = options.most_nodes - std::min(coarse, options.most_nodes);
  progress.stage("finer light", static_cast<double>(options.most_nodes), "nodes");
  for (int round = 1; round <= rounds; round++) {
    LightGrid grid = this->grid(options.most_insides);
    grid.normal_offset = options.normal_offset;
    if (points.mean_error(grid) <= options.target_error) break;
    const size_t allowed = coarse + addable * static_cast<size_t>(round) / rounds;
    if (allowed <= count()) continue;
    const size_t bricks = (allowed - count() + nodes_a_brick - 1) / nodes_a_brick;
    LW_TRY(any, divide(worst_bricks(points, grid, bricks), progress));
    if (!any) break;
    progress.advance(static_cast<double>(count()));
  }
  return {};
}

}  // namespace lightwell
