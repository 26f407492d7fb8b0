// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "lightwell/base/bytes.h"

namespace lightwell {

/// A number for bytes, as good as unique: XXH3, 64 bits.
uint64_t fingerprint(Bytes bytes, uint64_t seed = 0);

}  // namespace lightwell
