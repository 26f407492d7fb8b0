// SPDX-License-Identifier: Apache-2.0
#include "lightwell/light/push_pull.h"

#include <algorithm>
#include <array>
#include <vector>

#include "lightwell/base/assert.h"

namespace lightwell {
namespace {

// The 27 numbers of a node, and the fraction of valid nodes among those that they derive from.
constexpr size_t channels = 28;
constexpr size_t share_channel = 27;
using Value = std::array<float, channels>;

// A level of the pyramid. It has half as many nodes an axis as the level below, rounded up: node c covers the nodes 2c
// and 2c + 1 below.
struct Level {
  Vec3i nodes;
  std::vector<Value> values;
  std::vector<float> weights;  // 0 where unknown

  explicit Level(Vec3i n) : nodes(n), values(node_count(n)), weights(values.size(), 0.0f) {}
  size_t index(int x, int y, int z) const { return node_index(nodes, {{x, y, z}}); }
  bool single() const { return nodes == Vec3i::filled(1); }
};

template <typename Body>
void for_each_node(Vec3i nodes, const Body& body) {
  for (int z = 0; z < nodes[2]; z++) {
    for (int y = 0; y < nodes[1]; y++) {
      for (int x = 0; x < nodes[0]; x++) body(x, y, z);
    }
  }
}

// a + t (b - a), which is exactly a where both are equal.
void blend(Value& a, const Value& b, float t) {
  for (size_t c = 0; c < channels; c++) a[c] += t * (b[c] - a[c]);
}

Level finest(const LightGrid& grid, std::span<const uint8_t> known) {
  Level level(grid.shape.nodes);
  for (size_t i = 0; i < level.values.size(); i++) {
    if (!known[i]) continue;
    for (size_t c = 0; c < share_channel; c++) level.values[i][c] = grid.moments[i].m[c / 3][static_cast<int>(c % 3)];
    level.values[i][share_channel] = grid.valid[i] ? 1.0f : 0.0f;
    level.weights[i] = node_weight(grid.valid[i]);
  }
  return level;
}

// The weighted mean of the known values below each node, with the largest of their weights. Validity is averaged
// without weights.
Level pull(const Level& fine) {
  Level coarse((fine.nodes + Vec3i::filled(1)) / Vec3i::filled(2));
  std::vector<float> totals(coarse.values.size(), 0.0f);
  std::vector<float> counts(coarse.values.size(), 0.0f);
  for_each_node(fine.nodes, [&](int x, int y, int z) {
    const size_t from = fine.index(x, y, z);
    const float weight = fine.weights[from];
    if (weight == 0) return;
    const size_t to = coarse.index(x / 2, y / 2, z / 2);
    totals[to] += weight;
    counts[to] += 1;
    const float share = coarse.values[to][share_channel];
    // The running mean keeps equal values exactly as they are.
    blend(coarse.values[to], fine.values[from], weight / totals[to]);
    coarse.values[to][share_channel] = share + (fine.values[from][share_channel] - share) / counts[to];
    coarse.weights[to] = std::max(coarse.weights[to], weight);
  });
  return coarse;
}

// The two coarse nodes around a fine one on an axis: its parent, weighted by 3/4, and the parent's neighbour on the
// child's side, by 1/4.
struct Parents {
  int near, far;
};

Parents parents(int fine, int coarse_nodes) {
  const int near = fine / 2;
  return {near, std::clamp(fine % 2 == 0 ? near - 1 : near + 1, 0, coarse_nodes - 1)};
}

// Interpolates unknown nodes trilinearly from the coarser level, which is known everywhere.
void push(const Level& coarse, Level& fine) {
  for_each_node(fine.nodes, [&](int x, int y, int z) {
    const size_t to = fine.index(x, y, z);
    if (fine.weights[to] != 0) return;
    const Parents px = parents(x, coarse.nodes[0]), py = parents(y, coarse.nodes[1]), pz = parents(z, coarse.nodes[2]);
    const auto along_x = [&](int cy, int cz) {
      Value value = coarse.values[coarse.index(px.near, cy, cz)];
      blend(value, coarse.values[coarse.index(px.far, cy, cz)], 0.25f);
      return value;
    };
    const auto along_xy = [&](int cz) {
      Value value = along_x(py.near, cz);
      blend(value, along_x(py.far, cz), 0.25f);
      return value;
    };
    fine.values[to] = along_xy(pz.near);
    blend(fine.values[to], along_xy(pz.far), 0.25f);
  });
}

// Replaces each filled value by the mean of itself and the average of its six neighbours.
void smooth(Level& level) {
  const std::vector<Value> before = level.values;
  for_each_node(level.nodes, [&](int x, int y, int z) {
    const size_t at = level.index(x, y, z);
    if (level.weights[at] != 0) return;
    const Vec3i last = level.nodes - Vec3i::filled(1);
    const std::array<size_t, 6> neighbours{
        level.index(std::max(x - 1, 0), y, z), level.index(std::min(x + 1, last[0]), y, z),
        level.index(x, std::max(y - 1, 0), z), level.index(x, std::min(y + 1, last[1]), z),
        level.index(x, y, std::max(z - 1, 0)), level.index(x, y, std::min(z + 1, last[2]))};
    const Value& own = before[at];
    Value difference{};
    for (const size_t n : neighbours) {
      for (size_t c = 0; c < channels; c++) difference[c] += before[n][c] - own[c];
    }
    for (size_t c = 0; c < channels; c++) level.values[at][c] = own[c] + difference[c] * (1.0f / 12);
  });
}

void darken(LightGrid& grid, std::span<const uint8_t> known) {
  for (size_t i = 0; i < known.size(); i++) {
    if (known[i]) continue;
    grid.moments[i] = {};
    grid.valid[i] = 1;
  }
}

void publish(const Level& level, LightGrid& grid) {
  for (size_t i = 0; i < level.values.size(); i++) {
    if (level.weights[i] != 0) continue;
    for (size_t c = 0; c < share_channel; c++) grid.moments[i].m[c / 3][static_cast<int>(c % 3)] = level.values[i][c];
    grid.valid[i] = level.values[i][share_channel] >= 0.5f;
  }
}

}  // namespace

void push_pull(LightGrid& grid, std::span<const uint8_t> known, Fill fill) {
  LW_ASSERT(known.size() == grid.shape.count());
  const bool anything = std::any_of(known.begin(), known.end(), [](uint8_t k) { return k != 0; });
  if (fill == Fill::none || !anything) return darken(grid, known);

  std::vector<Level> pyramid{finest(grid, known)};
  while (!pyramid.back().single()) pyramid.push_back(pull(pyramid.back()));
  for (size_t l = pyramid.size() - 1; l > 0; l--) {
    push(pyramid[l], pyramid[l - 1]);
    if (fill == Fill::push_pull_smooth) smooth(pyramid[l - 1]);
  }
  publish(pyramid.front(), grid);
}

}  // namespace lightwell
