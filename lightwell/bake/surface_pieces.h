// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "lightwell/trace/trace_scene.h"

namespace lightwell {

/// Sums over the faces of a piece of surface, in the space of its mesh.
struct PieceExtent {
  double area = 0;
  Vec3d center{};      ///< times the area
  Vec3d normal_sum{};  ///< sum of area vectors
  double moment = 0;   ///< signed volume between the faces and the origin

  void add(const std::array<Vec3d, 3>& corners);
  /// Whether little of a closed surface is missing, such as a scan's holes: the area vectors of a closed one add up to
  /// nothing, those of the rest to what it lacks. An open tube passes too.
  bool nearly_closed() const;
  /// The volume between the surface and its own centre, positive when it faces outwards. For an open surface, which has
  /// no volume of its own, measuring from the centre makes the result independent of its place.
  double volume() const;
};

/// The connected pieces of some primitives of a scene, numbered. An instance's piece is that of its primitive.
class SurfacePieces {
 public:
  /// Of the primitives of the instances for which chosen(instance) holds. The scene must outlive the result.
  SurfacePieces(const TraceScene& scene, const std::function<bool(uint32_t)>& chosen);

  size_t count() const { return extents_.size(); }
  const PieceExtent& extent(size_t piece) const { return extents_[piece]; }
  /// The piece that was hit; nothing when it is of no chosen primitive.
  std::optional<size_t> piece(const Hit& hit) const;
  /// Calls body(face, piece) for the faces of a primitive that belong to a piece.
  void for_each_face(size_t primitive, const std::function<void(size_t, size_t)>& body) const;

 private:
  const TraceScene& scene_;
  std::vector<std::vector<uint32_t>> of_faces_;  // of each primitive; empty unless chosen
  std::vector<size_t> first_;                    // piece of each primitive
  std::vector<PieceExtent> extents_;
};

}  // namespace lightwell
