// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace lightwell {

/// The marks of a binary glTF (glTF 2.0, section 4.4), little-endian: of the file, and of its two kinds of chunk.
constexpr uint32_t glb_magic = 0x46546c67;       ///< "glTF"
constexpr uint32_t glb_json_chunk = 0x4e4f534a;  ///< "JSON"
constexpr uint32_t glb_bin_chunk = 0x004e4942;   ///< "BIN\0"

}  // namespace lightwell
