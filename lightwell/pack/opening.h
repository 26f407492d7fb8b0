// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "lightwell/base/bytes.h"
#include "lightwell/base/glb.h"
#include "lightwell/base/result.h"

namespace lightwell {

constexpr uint32_t chunk_lwst = 0x5453574c;  ///< "LWST"
constexpr uint32_t glb_header_bytes = 12;
constexpr uint32_t chunk_header_bytes = 8;

/// The layout of a pack, as far as its first bytes tell.
struct OpeningSize {
  uint64_t file_length = 0;     ///< as stated in the GLB header
  uint64_t opening_length = 0;  ///< bytes before the LWST chunk's data; 0 while unknown
  uint64_t needed = 0;    ///< bytes from the start of the file that are needed to learn more; once complete, the length
                          ///< of opening and directory
  bool complete = false;  ///< `needed` is the end of the directory
};

/// Follows the chunk headers in the first bytes of a pack. Fails when they are not those of a pack.
Result<OpeningSize> measure_opening(Bytes prefix);

/// The opening as a standalone GLB for a glTF loader: header, JSON and BIN, with the length in the header corrected.
/// `opening` is the first opening_length bytes of a pack.
std::vector<uint8_t> opening_as_glb(Bytes opening);

/// The JSON text and the data of the BIN chunk (empty when there is none) of such a GLB.
struct GlbChunks {
  Bytes json;
  Bytes bin;
};
GlbChunks glb_chunks(Bytes glb);

}  // namespace lightwell
