// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "lightwell/base/bytes.h"
#include "lightwell/base/result.h"

namespace lightwell {

/// The bytes as a gzip file (RFC 1952) of one member; as they are, in it, where they are not to be compressed.
std::vector<uint8_t> gzip(Bytes bytes, bool compressed = true);

/// What a gzip file inflates to: all its members, one after another. Fails for damaged data, and beyond `limit` bytes
/// before more are made.
Result<std::vector<uint8_t>> gunzip(Bytes packed, size_t limit);

}  // namespace lightwell
