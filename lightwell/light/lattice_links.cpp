// SPDX-License-Identifier: Apache-2.0
#include "lightwell/light/lattice_links.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "lightwell/base/model_coder.h"

namespace lightwell {
namespace {

/// Codes the bits of all nodes, x fastest. Blocked links lie in sheets: a link is likely as its neighbours' of the same
/// axis are.
template <typename Coder>
void code(Coder& coder, const Vec3i& nodes, std::vector<uint8_t>& links) {
  std::array<std::array<AdaptiveBit, 8>, 3> models;
  const GridShape shape{.lo = {}, .cell = {}, .nodes = nodes};
  for (size_t i = 0; i < links.size(); i++) {
    const Vec3i n = shape.node(i);
    const uint8_t wanted = links[i];
    links[i] = 0;
    for (int axis = 0; axis < 3; axis++) {
      if (n[axis] + 1 == nodes[axis]) continue;
      size_t around = 0;
      for (int b = 0; b < 3; b++) {
        Vec3i before = n;
        before[b]--;
        const bool blocked = before[b] >= 0 && (links[shape.index(before)] >> axis & 1) != 0;
        around |= static_cast<size_t>(blocked) << b;
      }
      const bool bit = coder.bit(models[static_cast<size_t>(axis)][around], (wanted >> axis & 1) != 0);
      links[i] = static_cast<uint8_t>(links[i] | (bit ? 1 << axis : 0));
    }
  }
}

bool is_blocked(uint8_t links) { return links != 0; }

}  // namespace

std::vector<uint8_t> write_links(const LightGrid& grid) {
  const bool in_bricks = std::ranges::any_of(
      grid.links.bricks, [](const Links::Points& points) { return std::ranges::any_of(points, is_blocked); });
  if (!in_bricks && std::ranges::none_of(grid.links.nodes, is_blocked)) return {};
  std::vector<uint8_t> links = grid.links.nodes;
  ModelWriter writer;
  code(writer, grid.shape.nodes, links);
  return writer.finish();
}

std::vector<uint8_t> read_links(const Vec3i& nodes, Bytes bytes) {
  std::vector<uint8_t> links(node_count(nodes));
  if (bytes.empty()) return links;
  ModelReader reader(bytes);
  code(reader, nodes, links);
  return links;
}

bool blocked_between(const std::vector<uint8_t>& links, const Vec3i& nodes, size_t a, size_t b, int axis) {
  Vec3i unit{};
  unit[axis] = 1;
  const size_t step = node_index(nodes, unit);
  for (size_t node = std::min(a, b); node < std::max(a, b); node += step)
    if ((links[node] >> axis & 1) != 0) return true;
  return false;
}

std::vector<Vec3f> blocked_links(const LightGrid& grid) {
  std::vector<Vec3f> ends;
  const auto add = [&](uint8_t links, int level, const Vec3i& corner) {
    const float scale = std::ldexp(1.0f, -level);
    for (int axis = 0; links != 0 && axis < 3; axis++) {
      if ((links >> axis & 1) == 0) continue;
      const Vec3f from = corner.cast<float>() * scale;
      Vec3f to = from;
      to[axis] += scale;
      const auto finest = grid.tree.empty() ? std::nullopt : grid.tree.finest((from + to) * 0.5f);
      if ((finest ? grid.tree.bricks()[*finest].level : 0) != level) continue;
      ends.push_back(grid.shape.lo + grid.shape.cell * from);
      ends.push_back(grid.shape.lo + grid.shape.cell * to);
    }
  };
  for (size_t i = 0; i < grid.links.nodes.size(); i++) add(grid.links.nodes[i], 0, grid.shape.node(i));
  for (size_t i = 0; i < grid.links.bricks.size(); i++) {
    const Brick& brick = grid.tree.bricks()[i];
    for (int point = 0; point < Brick::points; point++)
      add(grid.links.bricks[i][static_cast<size_t>(point)], brick.level, brick.corner(point));
  }
  return ends;
}

}  // namespace lightwell
