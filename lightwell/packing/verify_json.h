// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/packing/opened_pack.h"

namespace lightwell {

/// Fails when the JSON of a pack says anything else than its directory, the parameters of its streams and the BIN
/// chunk; when a light or mesh stream is not named once, so that programs would show different things; when an element
/// that an extension names does not exist; when the document is not in plain form (compressed, sparse or in several
/// buffers), which other programs would read at other places than the streams; or when it refers to another file.
Result<void> verify_json(const OpenedPack& pack);

}  // namespace lightwell
