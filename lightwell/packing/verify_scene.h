// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/packing/opened_pack.h"

namespace lightwell {

/// Fails when the scene of a pack cannot be imported at its coarsest or final level, when final positions of a mesh lie
/// outside the bounds stated in the JSON, or when an image does not have the size and format stated there.
Result<void> verify_scene(const OpenedPack& pack);

}  // namespace lightwell
