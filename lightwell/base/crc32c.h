// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/base/bytes.h"

namespace lightwell {

/// CRC-32C (Castagnoli, RFC 3720 appendix B.4) of bytes, continuing from `seed` (the CRC of the bytes before, 0 at the
/// start). crc32c("123456789") is 0xe3069283.
uint32_t crc32c(Bytes bytes, uint32_t seed = 0);

}  // namespace lightwell
