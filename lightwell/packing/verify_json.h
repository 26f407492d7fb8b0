// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/pack/reader.h"

namespace lightwell {

/// Fails when the JSON of a pack says anything else than its directory and the parameters of its streams, which it
/// repeats for people and other programs; or when it refers to another file. The bounds of a mesh are held against its
/// coarsest level.
Result<void> verify_json(const PackReader& pack);

}  // namespace lightwell
