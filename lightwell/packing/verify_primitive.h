// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/packing/opened_pack.h"

namespace lightwell {

/// Fails when the JSON of a refined primitive says anything else than the parameters of its stream: of the final level
/// and its error; and of the coarsest level which arrays there are, their types, counts and places in the BIN chunk,
/// and the bounds of its positions. So a glTF loader begins with the very arrays that the stream refines.
Result<void> verify_primitive(const OpenedPack& pack, const RefinedPrimitive& refined);

}  // namespace lightwell
