// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "lightwell/gltf/document.h"

namespace lightwell {

/// glTF's numbers for the types of an accessor's components.
enum class Component { i8 = 5120, u8 = 5121, i16 = 5122, u16 = 5123, u32 = 5125, f32 = 5126 };

/// Bytes of one component; 0 for a number that is no component type.
size_t size_of(Component component);

/// What an accessor says about its elements. `rows` and `columns` of a vector are N and 1.
struct ElementType {
  Component component = Component::f32;
  int rows = 0;  ///< 0: the accessor's type is unknown
  int columns = 1;
  bool normalized = false;

  /// Bytes from an element to the next where they are packed tightly; columns of matrices are padded to four bytes.
  size_t size() const;
  /// Bytes from an element's begin to the end of its last component.
  size_t extent() const;
};
ElementType element_type(const Json& accessor);

/// Where the elements of an accessor in plain form lie.
struct AccessorData {
  ElementType type;
  Bytes bytes;  ///< from the first element on
  size_t stride = 0;
  size_t count = 0;
};
/// The place of `accessor`, with all ranges checked. Fails for accessors without a buffer view and for sparse ones.
Result<AccessorData> locate(const Document& document, int accessor);
/// The same of an accessor's JSON, as if it had no sparse values. `name` is for the error.
Result<AccessorData> locate_base(const Document& document, const Json& accessor, const std::string& name);
/// The bytes that a buffer view, or an extension that is written like one (buffer, byteOffset, byteLength), means.
Result<Bytes> locate_range(const Document& document, const Json& range, const std::string& name);

/// The elements at `only` (all when it is null; indices below the accessor's count) as N floats each, normalised
/// integers divided by their largest value. The accessor must have N rows, or fewer: the rest is `filler` then.
template <int N>
std::vector<Vec<float, N>> read_vectors(const AccessorData& data, const std::vector<uint32_t>* only = nullptr,
                                        float filler = 0);

/// The elements of scalars of unsigned integers; empty when they are of another type.
std::vector<uint32_t> widen_indices(const AccessorData& data);
/// The same of an accessor; fails when it is of another type.
Result<std::vector<uint32_t>> read_indices(const Document& document, int accessor);

/// Sets an accessor's min and max by its elements, as glTF asks of positions.
void update_bounds(Document& document, int accessor);

/// Appends a buffer and a view of all of it. Returns the view's index. References into the JSON may dangle after it.
int append_buffer_view(Document& document, std::vector<uint8_t> bytes, size_t stride, int target);

}  // namespace lightwell
