// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "lightwell/pack/reader.h"

namespace lightwell {

struct Verification {
  uint64_t blocks = 0;              ///< read and decoded
  std::vector<std::string> errors;  ///< none: the pack is right
};

/// Reads every block of a pack, checks and decodes it, and compares with what the directory, the block tables and the
/// JSON say of it.
Verification verify_pack(const PackReader& pack);

}  // namespace lightwell
