// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "lightwell/base/vector.h"

namespace lightwell {

/// Divides surfaces into cells, without knowing the meshes: a cell holds what lies in one small cube of space and faces
/// about one way. Cubes double in size with the distance from a region, so that a landscape has few of them.
class SurfaceCells {
 public:
  /// Cubes of `size` metres in and near the region.
  SurfaceCells(const Box3f& region, float size) : region_(region), size_(size) {}

  /// Of the smallest cubes, metres.
  float size() const { return size_; }
  /// The cell of a point of a surface whose unit normal on the lit side is `facing`. Never 0.
  uint64_t at(const Vec3f& position, const Vec3f& facing) const;
  /// The cell of twice the size that holds a cell.
  static uint64_t parent(uint64_t cell);
  /// The cell of the same size and facing so many cubes away; `cell` itself at the end of the range.
  static uint64_t beside(uint64_t cell, const Vec3i& step);

 private:
  Box3f region_;
  float size_;
};

}  // namespace lightwell
