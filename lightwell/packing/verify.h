// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "lightwell/packing/opened_pack.h"

namespace lightwell {

struct Verification {
  uint64_t blocks = 0;              ///< read and decoded
  std::vector<std::string> errors;  ///< empty for a valid pack
};

/// Verifies a pack: checks and decodes every block, compares it with the directory, the block tables and the JSON, and
/// imports the scene. A pack without errors can be shown, rendered and exported by all programs of this project, and a
/// glTF loader that follows the JSON sees exactly what the streams refine.
Verification verify_pack(const OpenedPack& pack);

}  // namespace lightwell
