// SPDX-License-Identifier: Apache-2.0
#include "lightwell/light/grid.h"

#include <algorithm>
#include <cmath>

#include "lightwell/base/assert.h"

namespace lightwell {

Vec3i GridShape::node(size_t index) const {
  const auto nx = static_cast<size_t>(nodes[0]), ny = static_cast<size_t>(nodes[1]);
  return {{static_cast<int>(index % nx), static_cast<int>(index / nx % ny), static_cast<int>(index / nx / ny)}};
}

GridShape GridShape::over(const Box3f& box, int longest) {
  LW_ASSERT(longest >= 2);
  GridShape shape;
  if (box.empty()) return shape;
  const Vec3f size = box.size();
  const float extent = max_component(size) > 0 ? max_component(size) : 1.0f;
  const float wanted = extent / static_cast<float>(longest - 1);
  for (int a = 0; a < 3; a++) {
    const bool flat = size[a] < 0.01f * wanted;
    const float thickness = flat ? wanted : size[a];
    shape.nodes[a] = std::max(2, static_cast<int>(std::floor(thickness / wanted + 0.5f)) + 1);
    shape.cell[a] = thickness / static_cast<float>(shape.nodes[a] - 1);
    shape.lo[a] = flat ? box.center()[a] - 0.5f * thickness : box.lo[a];
  }
  return shape;
}

Vec3f Moments::irradiance(const Vec3f& n) const {
  Vec3f sum{};
  for (int a = 0; a < 3; a++) {
    const float square = n[a] * n[a];
    sum += m[static_cast<size_t>(2 * a)] * (square + n[a]) + m[static_cast<size_t>(2 * a + 1)] * (square - n[a]);
  }
  sum += m[6] * (n[0] * n[1]) + m[7] * (n[0] * n[2]) + m[8] * (n[1] * n[2]);
  return max(sum * 0.5f, Vec3f{});
}

Vec3f GridShape::place_of(const Vec3f& position) const {
  return max(Vec3f{}, min((position - lo) / cell, cells().cast<float>()));
}

/// Light times its weight.
struct LightGrid::Sum {
  Moments moments;
  float weight = 0;

  void add(const Moments& light, float share) {
    moments += light * share;
    weight += share;
  }
  void add(const Sum& sum, float share) {
    moments += sum.moments * share;
    weight += sum.weight * share;
  }
};

namespace {

/// Goes through the eight points around a place: add(n, weight) for point n, of 0 ... last.
template <typename Add>
void interpolate(const Vec3f& place, const Vec3i& last, const Add& add) {
  Vec3i first;
  Vec3f fraction;
  for (int a = 0; a < 3; a++) {
    const float inside = place[a] > 0 ? std::min(place[a], static_cast<float>(last[a])) : 0.0f;
    first[a] = std::min(static_cast<int>(inside), last[a] - 1);
    fraction[a] = inside - static_cast<float>(first[a]);
  }
  for (int corner = 0; corner < 8; corner++) {
    Vec3i n = first;
    float weight = 1;
    for (int a = 0; a < 3; a++) {
      const bool upper = corner >> a & 1;
      n[a] += upper;
      weight *= upper ? fraction[a] : 1 - fraction[a];
    }
    add(n, weight);
  }
}

}  // namespace

LightGrid::Sum LightGrid::trilinear(const Vec3f& place) const {
  Sum sum;
  if (const auto brick = tree.empty() ? std::nullopt : tree.finest(place)) {
    const Brick& cube = tree.bricks()[*brick];
    const Vec3f local = place * std::ldexp(1.0f, cube.level) - (cube.at * Brick::cells).cast<float>();
    interpolate(local, Vec3i::filled(Brick::cells), [&](const Vec3i& n, float weight) {
      const BrickPoint& point = bricks[*brick][static_cast<size_t>(Brick::point(n))];
      sum.add(point.moments, weight * point.weight);
    });
  } else {
    interpolate(place, shape.cells(), [&](const Vec3i& n, float weight) {
      const size_t node = shape.index(n);
      sum.add(moments[node], weight * node_weight(valid[node]));
    });
  }
  return sum;
}

LightGrid::Sum LightGrid::tricubic(const Vec3f& place) const {
  const auto brick = tree.empty() ? std::nullopt : tree.finest(place);
  const float cells = brick ? std::ldexp(1.0f, tree.bricks()[*brick].level) : 1.0f;
  // On each axis two lookups stand for two nodes each (Sigg and Hadwiger, Fast Third-Order Texture Filtering, GPU Gems
  // 2, 2005).
  std::array<Vec3f, 2> places, shares;
  for (int a = 0; a < 3; a++) {
    const float node = std::floor(place[a] * cells), f = place[a] * cells - node;
    const float w0 = (1 - f) * (1 - f) * (1 - f) / 6, w1 = (4 - 3 * f * f * (2 - f)) / 6, w3 = f * f * f / 6;
    shares[0][a] = w0 + w1;
    shares[1][a] = 1 - shares[0][a];
    places[0][a] = (node - 1 + w1 / shares[0][a]) / cells;
    places[1][a] = (node + 1 + w3 / shares[1][a]) / cells;
  }
  Sum sum;
  for (size_t corner = 0; corner < 8; corner++) {
    Vec3f at;
    float share = 1;
    for (int a = 0; a < 3; a++) {
      const size_t upper = corner >> a & 1;
      at[a] = places[upper][a];
      share *= shares[upper][a];
    }
    sum.add(trilinear(at), share);
  }
  return sum;
}

Vec3f LightGrid::irradiance(const Vec3f& point, const Vec3f& offset_normal, const Vec3f& direction) const {
  const Vec3f place = (point - shape.lo) / shape.cell + offset_normal * normal_offset;
  const Sum sum = lookup == LightLookup::tricubic ? tricubic(place) : trilinear(place);
  return (sum.moments * (1 / sum.weight)).irradiance(direction);
}

namespace {

/// The weighted means of the nine moments around an invalid node.
struct Surroundings {
  Moments sum;       // E from the neighbours on the side that it faces
  Moments any_side;  // from all neighbours: S, and E where that side has none
  std::array<float, 6> weight{};
  float total = 0;

  void add(const Moments& neighbour, const Vec3f& towards) {
    const float nearness = 1 / dot(towards, towards);
    any_side += neighbour * nearness;
    total += nearness;
    for (size_t d = 0; d < 6; d++) {
      const float along = (d % 2 == 0 ? 1.0f : -1.0f) * towards[static_cast<int>(d / 2)];
      if (along <= 0) continue;
      const float w = along * along * nearness * nearness;
      sum.m[d] += neighbour.m[d] * w;
      weight[d] += w;
    }
  }
  Moments mean() const {
    Moments result = any_side * (1 / total);
    for (size_t d = 0; d < 6; d++) {
      if (weight[d] > 0) result.m[d] = sum.m[d] / weight[d];
    }
    return result;
  }
};

/// Adds up those of the 26 neighbours of a node of a box of nodes that are filled.
Surroundings look_around(const Vec3i& nodes, const Vec3f& cell, std::span<const Moments> moments,
                         const std::vector<uint8_t>& filled, size_t index) {
  const GridShape shape{.nodes = nodes};
  const Vec3i n = shape.node(index);
  Surroundings around;
  for (int offset = 0; offset < 27; offset++) {
    const Vec3i step{{offset % 3 - 1, offset / 3 % 3 - 1, offset / 9 - 1}};
    const Vec3i other = n + step;
    if (offset == 13 || min(other, Vec3i{}) != Vec3i{} || max(other, shape.cells()) != shape.cells()) continue;
    const size_t neighbour = shape.index(other);
    if (filled[neighbour]) around.add(moments[neighbour], cell * step.cast<float>());
  }
  return around;
}

/// Fills what is not filled, ring by ring inwards; nodes of the same ring do not affect each other.
void fill_rings(const Vec3i& nodes, const Vec3f& cell, std::span<Moments> moments, std::vector<uint8_t> filled) {
  std::vector<size_t> missing;
  for (size_t i = 0; i < filled.size(); i++) {
    if (!filled[i]) missing.push_back(i);
  }
  while (!missing.empty()) {
    std::vector<size_t> later;
    std::vector<std::pair<size_t, Moments>> ring;
    for (const size_t i : missing) {
      const Surroundings around = look_around(nodes, cell, moments, filled, i);
      if (around.total > 0)
        ring.emplace_back(i, around.mean());
      else
        later.push_back(i);
    }
    if (ring.empty()) return;
    for (const auto& [i, mean] : ring) {
      moments[i] = mean;
      filled[i] = 1;
    }
    missing = std::move(later);
  }
}

}  // namespace

void fill_invalid(LightGrid& grid) { fill_rings(grid.shape.nodes, grid.shape.cell, grid.moments, grid.valid); }

void fill_invalid(BrickPoints& points, const Vec3f& cell) {
  std::vector<Moments> moments;
  std::vector<uint8_t> valid;
  for (const BrickPoint& point : points) {
    moments.push_back(point.moments);
    valid.push_back(point.weight > node_weight(false));
  }
  fill_rings(Vec3i::filled(Brick::side), cell, moments, std::move(valid));
  for (size_t i = 0; i < points.size(); i++) points[i].moments = moments[i];
}

}  // namespace lightwell
