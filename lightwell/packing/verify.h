// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "lightwell/packing/opened_pack.h"

namespace lightwell {

struct Verification {
  uint64_t blocks = 0;              ///< read and decoded
  std::vector<std::string> errors;  ///< none: the pack is right
};

/// Reads every block of a pack, checks and decodes it, compares with what the directory, the block tables and the JSON
/// say of it, and imports the scene. A pack without errors can be shown, rendered and exported by every program here,
/// and a glTF loader that follows the JSON sees what the streams refine.
Verification verify_pack(const OpenedPack& pack);

}  // namespace lightwell
