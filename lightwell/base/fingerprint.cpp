// SPDX-License-Identifier: Apache-2.0
#include "lightwell/base/fingerprint.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace lightwell {

uint64_t fingerprint(Bytes bytes, uint64_t seed) { return XXH3_64bits_withSeed(bytes.data(), bytes.size(), seed); }

}  // namespace lightwell
