// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "lightwell/mesh/collapse.h"
#include "lightwell/mesh/quadric.h"
#include "lightwell/mesh/refinement.h"

namespace lightwell {

/// A mesh under simplification: its faces, the faces at each point, each point's quadric, and what a collapse costs.
/// Costs take the longest side of the bounding box as the unit of length; errors are in the mesh's own units.
class CollapseState {
 public:
  CollapseState(const QuantizedMesh& mesh, const Points& points);

  struct Choice {
    uint32_t target = no_vertex;
    float cost = std::numeric_limits<float>::infinity();
    float error = 0;
  };

  /// Unlocks all points and begins to bound their fans by the current sizes; faces that vanish during the round are not
  /// subtracted, since a pass may undo the round's collapses in any order.
  void begin_round(std::span<const uint32_t> live);
  bool locked(uint32_t v) const { return locked_in_[v] == round_ || removed(v); }
  bool removed(uint32_t v) const { return order_.target[v] != v; }
  bool isolated(uint32_t v) const { return fan_[v] == 0; }
  /// Whether a collapse onto v that adds no faces can be undone: the fan of v is at most max_fan.
  bool can_be_split(uint32_t v) const { return fan_bound_[v] <= max_fan; }

  /// A lower bound on the cost of the cheapest collapse of v; 0 when it is isolated.
  float least_cost(uint32_t v);
  /// The cheapest collapse of v, which must not be isolated. The cost is infinite when every collapse would make a fan
  /// above max_fan or remove the last face of a region.
  Choice choose(uint32_t v);
  /// Collapses v onto u; locks and returns the points whose faces changed.
  std::span<const uint32_t> collapse(uint32_t v, uint32_t u);

  CollapseOrder release(std::vector<CollapseOrder::Round> rounds);

 private:
  struct Corners {
    Face points, vertices;
    std::array<uint32_t, 3> next;  // next corner of the same point; a corner is 3 * face + place
  };
  struct Neighbour {
    uint32_t point = 0;
    uint32_t faces = 0;  // shared with the point being examined
    float cost = 0;      // of quadric and edge length alone
  };

  void link_faces(const QuantizedMesh& mesh);
  void add_quadrics();
  void add_edge_planes(uint32_t v);
  float edge_weight(const Spoke& spoke, uint32_t x) const;
  uint16_t region_of(uint32_t face) const { return mesh_.regions.empty() ? uint16_t(0) : mesh_.regions[face]; }
  bool ends_region(uint32_t u) const;
  bool torn_between(uint32_t vertex, uint32_t other) const;

  void gather(uint32_t v, std::vector<Spoke>& star);
  void gather_ring(uint32_t v);
  float longest_edge(uint32_t v) const;
  Choice assess(uint32_t v, const Neighbour& u, float longest);
  bool keeps_border(const Neighbour& u) const;
  bool keeps_links(uint32_t v, uint32_t u);
  bool in_ring(uint32_t x) const;
  bool keeps_orientation(uint32_t v, uint32_t u) const;
  float match_vertices(uint32_t v, uint32_t u);
  float attribute_distance(uint32_t vertex, uint32_t other) const;

  const QuantizedMesh& mesh_;
  const Points& points_;
  float size_ = 0;  // the longest side, in the mesh's units
  std::vector<Vec3f> position_;
  std::vector<Quadric> quadric_;
  std::vector<Corners> faces_;
  std::vector<uint32_t> first_corner_, fan_, fan_bound_, locked_in_;
  std::vector<uint16_t> vertex_region_;  // where vertices of different regions stay apart
  uint32_t round_ = 0;
  std::vector<uint32_t> live_faces_;  // of each region
  CollapseOrder order_;

  // Scratch data of the point being examined, kept to save allocations.
  std::vector<Spoke> star_, target_star_;
  std::vector<Neighbour> ring_;
  std::vector<uint32_t> changed_;
  std::vector<uint32_t> mates_;  // of each of its vertices: the target's vertex that replaces it
};

}  // namespace lightwell
