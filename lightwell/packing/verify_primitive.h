// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/packing/opened_pack.h"

namespace lightwell {

/// Fails when the JSON of a refined primitive contradicts the parameters of its stream: in the size of the final level,
/// the error, or the arrays of the coarsest level (attributes, types, counts, places in the BIN chunk, bounds of the
/// positions). A glTF loader thus starts from exactly the arrays that the stream refines.
Result<void> verify_primitive(const OpenedPack& pack, const RefinedPrimitive& refined);

}  // namespace lightwell
