// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "lightwell/base/vector.h"
#include "lightwell/light/brick_regions.h"

namespace lightwell {

/// The number of nodes of a grid, and the index of node n: x fastest, z slowest. `nodes` is their number on each axis.
inline size_t node_count(Vec3i nodes) {
  return static_cast<size_t>(nodes[0]) * static_cast<size_t>(nodes[1]) * static_cast<size_t>(nodes[2]);
}
inline size_t node_index(Vec3i nodes, Vec3i n) {
  return static_cast<size_t>(n[0]) +
         static_cast<size_t>(nodes[0]) *
             (static_cast<size_t>(n[1]) + static_cast<size_t>(nodes[1]) * static_cast<size_t>(n[2]));
}

/// The nodes of a regular grid over an axis-parallel box: node (i, j, k) is at lo + (i, j, k) * cell. At least two
/// nodes an axis; indices run x fastest, z slowest.
struct GridShape {
  Vec3f lo{};
  Vec3f cell = Vec3f::filled(1);  ///< distance between neighbours on each axis, metres
  Vec3i nodes{{2, 2, 2}};

  size_t count() const { return node_count(nodes); }
  size_t index(Vec3i n) const { return node_index(nodes, n); }
  Vec3i node(size_t index) const;
  Vec3f position(Vec3i n) const { return lo + cell * n.cast<float>(); }
  Vec3f hi() const { return position(nodes - Vec3i::filled(1)); }
  Vec3i cells() const { return nodes - Vec3i::filled(1); }
  /// A position in cells from the first node, clamped to the grid.
  Vec3f place_of(const Vec3f& position) const;
  bool operator==(const GridShape&) const = default;

  /// The grid over `box` with `longest` nodes on its longest axis and max(2, round(size / longest size * (longest - 1))
  /// + 1) on the others. A flat box is thickened to a cell.
  static GridShape over(const Box3f& box, int longest);
};

/// The irradiance at a node for every direction, as nine moments for each colour (docs/light.md section 1):
/// E for +x, -x, +y, -y, +z, -z (W/m2), then S for xy, xz, yz.
struct Moments {
  std::array<Vec3f, 9> m{};  ///< each entry is an RGB triple

  Moments& operator+=(const Moments& other) {
    for (size_t i = 0; i < m.size(); i++) m[i] += other.m[i];
    return *this;
  }
  friend Moments operator*(Moments a, float s) {
    for (Vec3f& v : a.m) v *= s;
    return a;
  }

  /// Irradiance (W/m2, RGB) on a surface of unit normal n: half of F.n + sum M_a n_a^2 + sum S_ab n_a n_b, never
  /// negative. Exact for normals along an axis, and for radiance of degree up to two. Differs from the papers cited at
  /// LightGrid: see docs/decisions/002-moments.md.
  Vec3f irradiance(const Vec3f& n) const;
};

/// The light at a point of a brick, and its weight in lookups: see node_weight.
struct BrickPoint {
  Moments moments;
  float weight = 1;
};
using BrickPoints = std::array<BrickPoint, Brick::points>;

/// How the light between nodes is found: the mean of the eight around, or the B-spline of third degree over the 64
/// around, which has no creases on the borders of cells, but sees farther through thin walls.
enum class LightLookup : uint8_t { trilinear, tricubic };

/// Between which neighbours of a grid a surface stands: what is known of a node beyond it says nothing of this one.
/// A node has a bit for +x, +y and +z, 1 << axis, set where its link to the next node of its level is blocked; links of
/// invalid nodes are open. Both lists are empty where nothing is known.
struct Links {
  using Points = std::array<uint8_t, Brick::points>;
  std::vector<uint8_t> nodes;  ///< of the grid's own
  std::vector<Points> bricks;  ///< of the points of bricks, those to other points of the brick
};

/// The irradiance vector grid of S08 (Pacanowski, Granier et al., "Efficient Streaming of 3D Scenes with Complex
/// Geometry and Complex Lighting", Web3D 2008, section 3) and R09 (Pacanowski et al., "Volumetric Vector-Based
/// Representation for Indirect Illumination Caching", INRIA RR-6983, 2009), stored as moments, with the validity of
/// each node. Where the light changes quickly the grid may be divided into bricks (R09's "multiresolution and adaptive
/// structure").
struct LightGrid {
  GridShape shape;
  std::vector<Moments> moments;  ///< shape.count()
  std::vector<uint8_t> valid;    ///< 1 for a node in free space, 0 inside a solid
  float normal_offset = 0.5f;    ///< lookups are shifted by this many of its own cells along the normal (docs/light.md
                                 ///< section 5), in bricks too: light goes over from one into the other without a seam
  BrickTree tree;                ///< empty in a regular grid
  std::vector<BrickPoints> bricks;  ///< the points of the tree's bricks: see place_brick
  Links links;
  LightLookup lookup = LightLookup::trilinear;
  float noise = 0;  ///< that its nodes are likely to have, root mean square, a share of the light; 0: not known

  /// Irradiance (W/m2, RGB) for a unit direction at a point of a surface of unit normal `offset_normal`. Interpolates
  /// between the nodes around point + normal_offset * cell * offset_normal, those of the finest brick there, by
  /// `lookup`, weighted by node_weight. The direction is the normal for diffuse reflection and the mirrored view
  /// direction for specular reflection. Points outside are clamped to the grid.
  Vec3f irradiance(const Vec3f& point, const Vec3f& offset_normal, const Vec3f& direction) const;
  /// The same for diffuse reflection, in the direction of the normal.
  Vec3f irradiance(const Vec3f& point, const Vec3f& normal) const { return irradiance(point, normal, normal); }

 private:
  struct Sum;
  Sum trilinear(const Vec3f& place) const;
  Sum tricubic(const Vec3f& place) const;
};

/// The weight of a node in lookups and averages: 1 when it is valid, else 2^-13. That is small enough for the inside of
/// a solid not to leak, and large enough for a half float, so that a lookup between invalid nodes only still finds
/// their fill.
constexpr float node_weight(bool valid) { return valid ? 1.0f : 0x1p-13f; }

/// Sets the points of a brick, of which all coarser bricks are placed: its finer_points() are those of `nodes`; on the
/// corners of coarser cells it has their light, and on their borders, where a neighbour is not as fine as the brick,
/// what lookups in that neighbour give. So light is continuous wherever finer cells end.
void place_brick(LightGrid& grid, uint32_t brick, const BrickPoints& nodes);

/// The points of a brick between the corners of coarser cells: first those on their edges, then those in their faces,
/// then those in their middle.
std::vector<int> finer_points();

/// A node that bricks add to a grid: the brick that has it first, and its point there.
struct BrickNode {
  uint32_t brick = 0;
  int point = 0;
};

/// The nodes that bricks add to a grid: the points for which place_brick asks.
class BrickNodes {
 public:
  explicit BrickNodes(const BrickTree& tree);
  /// As if each region were alone but for what hangs: a node on the border of two is one of both.
  BrickNodes(const BrickTree& tree, std::span<const BrickRegion> regions);
  /// In the order of the bricks, in a brick in that of finer_points().
  std::span<const BrickNode> nodes() const { return nodes_; }
  /// The number of the first node of each brick, and at the end the number of all.
  std::span<const uint32_t> first() const { return first_; }
  /// The number of the node at one of the finer_points() of a brick, which may be another brick's; `none` where it
  /// hangs on the border of a coarser cell.
  uint32_t at(uint32_t brick, int point) const { return numbers_[brick][static_cast<size_t>(point)]; }
  static constexpr uint32_t none = ~uint32_t(0);

 private:
  void number(const BrickTree& tree, const BrickRegion& region);

  std::vector<BrickNode> nodes_;
  std::vector<uint32_t> first_;
  std::vector<std::array<uint32_t, Brick::points>> numbers_;
};

/// Fills invalid nodes with the light of the free space around them (docs/light.md section 5): E_d is the mean of the
/// neighbours on the d side, weighted by cos^2 / distance^2, and S the mean of all neighbours, weighted by 1 /
/// distance^2. Nodes deep inside solids are filled from those filled before them. Valid nodes never change, nor does a
/// grid without any. Bricks are left alone.
void fill_invalid(LightGrid& grid);
/// The same for the points of a brick, whose valid ones are placed.
void fill_invalid(BrickPoints& points, const Vec3f& cell);

}  // namespace lightwell
