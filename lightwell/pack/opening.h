// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "lightwell/base/bytes.h"
#include "lightwell/base/result.h"

namespace lightwell {

constexpr uint32_t glb_magic = 0x46546c67;   ///< "glTF"
constexpr uint32_t chunk_json = 0x4e4f534a;  ///< "JSON"
constexpr uint32_t chunk_bin = 0x004e4942;   ///< "BIN\0"
constexpr uint32_t chunk_lwst = 0x5453574c;  ///< "LWST"
constexpr uint32_t glb_header_bytes = 12;
constexpr uint32_t chunk_header_bytes = 8;

/// What the first bytes of a pack tell of its layout.
struct OpeningSize {
  uint64_t file_length = 0;     ///< as the GLB header states it
  uint64_t opening_length = 0;  ///< bytes before the LWST chunk's data; 0 as long as unknown
  uint64_t needed = 0;  ///< bytes from the start of the file needed to know more, or, once complete, to have all of the
                        ///< opening and the directory
  bool complete = false;  ///< `needed` is the end of the directory
};

/// Follows the chunk headers in the first bytes of a pack. Fails when they are not those of a pack.
Result<OpeningSize> measure_opening(Bytes prefix);

/// The opening as a GLB of its own, for a glTF loader: header, JSON and BIN, with the length in the header set to its
/// end. `opening` is the first opening_length bytes of a pack.
std::vector<uint8_t> opening_as_glb(Bytes opening);

/// The JSON text, and the data of the BIN chunk (empty when there is none), of such a GLB.
struct GlbChunks {
  Bytes json;
  Bytes bin;
};
GlbChunks glb_chunks(Bytes glb);

}  // namespace lightwell
