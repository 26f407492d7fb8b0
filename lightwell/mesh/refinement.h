// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "lightwell/mesh/stream.h"

namespace lightwell {

/// The most faces at a vertex that splits, so that a hostile stream cannot make a single split expensive.
inline constexpr uint32_t max_fan = 64;

/// A face at a vertex: its other two corners in order, and the place of this corner in the index buffer.
struct Spoke {
  uint32_t a = 0, b = 0, corner = 0;

  bool has(uint32_t v) const { return a == v || b == v; }
};

/// A face that comes with a new vertex: its other two corners in order, and its region. Only the encoder uses `source`.
struct NewFace {
  uint32_t a = 0, b = 0, source = 0;
  uint16_t region = 0;
};

/// A vertex that a split adds: some of its parent's faces move to it, others are new.
struct NewVertex {
  uint32_t parent = 0;
  std::vector<Spoke> fan;      ///< the parent's faces, each next to its neighbour where possible
  std::vector<uint8_t> moves;  ///< of each face of the fan: whether it moves to the new vertex
  std::vector<NewFace> faces;
  Vec3i position;
  NormalCode normal;  ///< of the level to which it is added
  std::array<Vec<int, 2>, 2> texcoords;
  ColorCode color{};
};

/// A mesh between its coarsest and its final level, with the faces at each vertex. Encoder and decoder keep equal
/// copies.
class Refinement {
 public:
  /// Begins with the coarsest level. Fails when the arrays do not fit the layout.
  static Result<Refinement> open(MeshLayout layout, const MeshArrays& base);

  const MeshLayout& layout() const { return layout_; }
  uint32_t vertices() const { return static_cast<uint32_t>(position_buffer.size()); }
  uint32_t faces() const { return faces_; }
  /// Point i has the vertices [first_of_point(i), first_of_point(i + 1)).
  uint32_t points() const { return static_cast<uint32_t>(first_of_point_.size()); }
  uint32_t first_of_point(uint32_t point) const { return point < points() ? first_of_point_[point] : vertices(); }
  uint32_t fan_size(uint32_t vertex) const { return fan_size_[vertex]; }
  /// Gathers the faces at a vertex, ordered so that a face follows its neighbour. The order depends only on the splits
  /// so far.
  void gather_fan(uint32_t vertex, std::vector<Spoke>& fan) const;

  /// The region of the face with a corner at that place of the index buffer.
  uint16_t region_of(uint32_t corner) const;
  /// The indices of the faces of a region, in the order in which they came.
  std::span<const uint32_t> indices(size_t region) const {
    if (faces(region) == 0) return {};
    return std::span(index_buffer).subspan(regions_[region].first, 3 * size_t(faces(region)));
  }
  uint32_t faces(size_t region) const { return regions_[region].faces; }

  Vec3i position(uint32_t vertex) const {
    const Vec3f& p = position_buffer[vertex];
    const auto code = [&](float value) { return static_cast<int32_t>(value * steps_per_unit_); };
    return {{code(p[0]), code(p[1]), code(p[2])}};
  }
  Vec<int, 2> texcoord(int set, uint32_t vertex) const;
  ColorCode color(uint32_t vertex) const;

  /// Of each vertex the sum of its faces' area normals, modulo 2^64.
  std::vector<Vec<uint64_t, 3>> area_normals() const;

  /// Adds a vertex and rewires its faces. Its parent, its fan and the other corners of its new faces must be those of
  /// this mesh.
  void add(const NewVertex& vertex, bool begins_point);
  /// The vertices whose normals are those of the final level: the coarsest level's, and those after it that
  /// set_next_normal() was called for, in order.
  uint32_t final_normals() const { return final_normals_; }
  /// Gives the next of them its normal of the final level.
  void set_next_normal(NormalCode normal);
  /// Adds a face that no split will ever touch. add() must not be called after it.
  void add_loose(const Face& face, uint16_t region);

  std::vector<Vec3f> position_buffer;
  std::vector<Normal16> normal_buffer;
  std::array<std::vector<Vec2f>, 2> texcoord_buffers;
  std::vector<Color16> color_buffer;
  std::vector<uint32_t> index_buffer;  ///< of a region those of as many faces as it will have, then of the next

  MeshChanges take_changes();

 private:
  explicit Refinement(MeshLayout&& layout);
  void add_base(const MeshArrays& base);
  void reserve_vertices(size_t count);
  void reserve_faces(size_t count);
  void add_attributes(const NewVertex& vertex);
  void add_linked(const Face& face, uint16_t region);
  uint32_t add_indices(const Face& face, uint16_t region);
  void link(uint32_t corner);

  MeshLayout layout_;
  float steps_per_unit_;  // of positions, exactly
  std::vector<uint32_t> first_of_point_;
  // Linked lists of the corners at each vertex; a corner is a place in the index buffer.
  std::vector<uint32_t> first_corner_, next_corner_, fan_size_;
  /// Of the index buffer.
  struct Region {
    uint32_t first = 0;                      // its first index
    uint32_t faces = 0, reported_faces = 0;  // there now, and those that take_changes() has reported
  };

  std::vector<Region> regions_;
  uint32_t faces_ = 0;
  // The counts that take_changes() has reported, and the reported places that have been rewired since.
  uint32_t reported_vertices_ = 0;
  uint32_t final_normals_ = 0, reported_normals_ = 0;
  std::vector<uint32_t> rewired_;
};

}  // namespace lightwell
