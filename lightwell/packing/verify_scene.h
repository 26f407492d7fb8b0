// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/packing/opened_pack.h"

namespace lightwell {

/// Fails when the scene of a pack cannot be imported at its coarsest or at its final level, so that a program could not
/// show it; when the final positions of a mesh lie outside of the bounds that the JSON states; or when an image is not
/// of the size and format that its stream states.
Result<void> verify_scene(const OpenedPack& pack);

}  // namespace lightwell
