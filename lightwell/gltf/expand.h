// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/gltf/document.h"

namespace lightwell {

/// The bytes that expanding a document may still produce, so that a small hostile file cannot exhaust memory.
class Budget {
 public:
  explicit Budget(double bytes) : left_(bytes) {}
  /// Takes `bytes`, or fails, naming `element`, when fewer are left.
  Result<void> take(double bytes, const std::string& element) {
    if (!(bytes <= left_))
      return fail(ErrorKind::limit, element, "expands to more than is sensible for a file of this size");
    left_ -= bytes;
    return {};
  }

 private:
  double left_;
};

/// Decodes buffer views compressed with EXT_meshopt_compression or KHR_meshopt_compression into buffers of their own.
Result<void> expand_meshopt(Document& document, Budget& budget);

/// Decodes primitives compressed with KHR_draco_mesh_compression. Their accessors get buffer views of their own.
Result<void> expand_draco(Document& document, Budget& budget);

/// Expands accessors of primitives and instances that are sparse or lack a buffer view (all zeros) into buffer views of
/// their own. Accessors of morph targets and animations are left as they are, but for a place in no buffer, which some
/// files state and glTF forbids.
Result<void> expand_sparse(Document& document, Budget& budget);

}  // namespace lightwell
