// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "lightwell/gltf/document.h"

namespace lightwell {

/// The type of an accessor's components, with glTF's numbers.
enum class Component { i8 = 5120, u8 = 5121, i16 = 5122, u16 = 5123, u32 = 5125, f32 = 5126 };

/// Bytes of one component; 0 for an invalid type.
size_t size_of(Component component);

/// The type of an accessor's elements. A vector of size N has N rows and 1 column.
struct ElementType {
  Component component = Component::f32;
  int rows = 0;  ///< 0: the accessor's type is unknown
  int columns = 1;
  bool normalized = false;

  /// Bytes from one tightly packed element to the next; columns of matrices are padded to four bytes.
  size_t size() const;
  /// Bytes from the start of an element to the end of its last component.
  size_t extent() const;
};
ElementType element_type(const Json& accessor);

/// The place of an accessor's elements in plain form.
struct AccessorData {
  ElementType type;
  Bytes bytes;  ///< from the first element on
  size_t stride = 0;
  size_t count = 0;
};
/// Locates the data of `accessor` and checks all ranges. Fails for accessors without a buffer view and for sparse ones.
Result<AccessorData> locate(const Document& document, int accessor);
/// The same for an accessor's JSON, ignoring its sparse values. `name` is used in errors.
Result<AccessorData> locate_base(const Document& document, const Json& accessor, const std::string& name);
/// The bytes of a buffer view, or of an extension with the same members (buffer, byteOffset, byteLength).
Result<Bytes> locate_range(const Document& document, const Json& range, const std::string& name);

/// The elements with indices `only` (null: all) as N floats each; normalised integers are divided by their largest
/// value. The indices must be below the accessor's count. Rows that the accessor does not have are `filler`.
template <int N>
std::vector<Vec<float, N>> read_vectors(const AccessorData& data, const std::vector<uint32_t>* only = nullptr,
                                        float filler = 0);

/// The elements of an accessor of `count` times three numbers that may be sparse, or all zeros for want of a buffer
/// view.
Result<std::vector<Vec3f>> read_sparse_vectors(const Document& document, int accessor, size_t count);

/// Appends an accessor of the first `count` elements of another, which may be sparse in ascending order, on the same
/// bytes, and returns its index. Where the other states bounds, it states its own; fails where those cannot be read.
/// Invalidates references into the JSON.
Result<int> append_prefix(Document& document, int accessor, size_t count);

/// The elements of an accessor of unsigned scalars; empty for other types.
std::vector<uint32_t> widen_indices(const AccessorData& data);
/// The same for an accessor; fails for other types.
Result<std::vector<uint32_t>> read_indices(const Document& document, int accessor);

/// Sets an accessor's min and max from its elements, as glTF requires for positions.
void update_bounds(Document& document, int accessor);

/// Appends a buffer and a view of all of it, and returns the view's index. A `stride` or `target` of 0 is left out.
/// Invalidates references into the JSON.
int append_buffer_view(Document& document, std::vector<uint8_t> bytes, size_t stride, int target);

}  // namespace lightwell
