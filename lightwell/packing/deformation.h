// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lightwell/gltf/accessor.h"
#include "lightwell/packing/mesh_extension.h"

namespace lightwell {

/// What bends the vertices of a primitive at rest, row by row: joints and weights of a skin (JOINTS_0, WEIGHTS_0 and so
/// on), and the displacements of positions and normals by morph targets.
class Deformation {
 public:
  /// Reads the rows of a primitive; `rows` is the number of vertices in its accessors. Fails where an array is of a
  /// type or count that it cannot have.
  static Result<Deformation> read(const Document& document, const Json& primitive, size_t rows,
                                  const std::string& name);

  /// Of each row the first one that is equal to it: vertices of equal rows bend alike.
  std::vector<uint32_t> first_alike() const;

  /// Appends accessors that hold the given rows, in that order: sparse ones where that is smaller.
  DeformationAccessors write(Document& document, std::span<const uint32_t> rows) const;

  /// Whether it has an attribute of that name.
  bool has(const std::string& attribute) const;

 private:
  struct Array {
    std::string semantic;
    ElementType type;
    std::vector<uint8_t> elements;  ///< of the rows, tightly packed

    const uint8_t* row(uint32_t index) const { return &elements[index * type.size()]; }
  };

  void shorten_weights();
  bool alike(uint32_t a, uint32_t b) const;
  int write(Document& document, const Array& array, std::span<const uint32_t> rows) const;

  size_t rows_ = 0;
  std::vector<Array> attributes_;
  std::vector<std::vector<Array>> targets_;
};

/// Accessors of the first `vertices` elements of each, with which a level of so many vertices bends.
Result<DeformationAccessors> prefix_of(const DeformationAccessors& accessors, size_t vertices, Document& document);

/// Puts accessors into a primitive's attributes and targets.
void bend_by(const DeformationAccessors& accessors, Json& primitive);

/// Checks that a primitive of a pack has, of `base_vertices` vertices, the first elements of the accessors, and these
/// elements for `vertices`.
Result<void> verify_deformation(const Json& json, const Json& primitive, const DeformationAccessors& accessors,
                                uint32_t base_vertices, uint32_t vertices, const std::string& name);

}  // namespace lightwell
