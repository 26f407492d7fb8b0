// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/gltf/document.h"

namespace lightwell {

/// How many bytes the expansion of a document may still make, so that a small hostile file cannot exhaust memory.
class Budget {
 public:
  explicit Budget(double bytes) : left_(bytes) {}
  /// Takes `bytes`, or fails in the name of `element` when fewer are left.
  Result<void> take(double bytes, const std::string& element) {
    if (!(bytes <= left_))
      return fail(ErrorKind::limit, element, "expands to more than is sensible for a file of this size");
    left_ -= bytes;
    return {};
  }

 private:
  double left_;
};

/// Decodes the buffer views compressed after EXT_meshopt_compression or KHR_meshopt_compression into buffers of their
/// own.
Result<void> expand_meshopt(Document& document, Budget& budget);

/// Decodes the primitives compressed after KHR_draco_mesh_compression: their accessors get buffer views of their own.
Result<void> expand_draco(Document& document, Budget& budget);

/// Gives the sparse accessors that primitives and instances refer to, and those without a buffer view (all zeros),
/// buffer views of their own. Those of morph targets and animations are left as they are.
Result<void> expand_sparse(Document& document, Budget& budget);

}  // namespace lightwell
