// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/packing/opened_pack.h"

namespace lightwell {

/// Fails when the JSON of a pack contradicts its directory, the parameters of its streams or the BIN chunk; when a
/// light or mesh stream is not named exactly once; when an extension names an element that does not exist; when the
/// document is compressed, sparse or in several buffers, so that other programs would read other data than the streams
/// refine; or when it refers to another file.
Result<void> verify_json(const OpenedPack& pack);

}  // namespace lightwell
