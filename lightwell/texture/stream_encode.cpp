// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "lightwell/texture/stream.h"

namespace lightwell {

std::vector<uint8_t> encode_texture_parameters(const TextureParameters& parameters) {
  ByteWriter writer;
  writer.u32(parameters.bytes);
  writer.u8(static_cast<uint8_t>(parameters.format));
  writer.u32(parameters.width);
  writer.u32(parameters.height);
  return writer.release();
}

std::vector<Bytes> texture_blocks(Bytes file) {
  std::vector<Bytes> blocks;
  for (size_t at = 0; at < file.size(); at += texture_block_bytes)
    blocks.push_back(file.subspan(at, std::min(texture_block_bytes, file.size() - at)));
  return blocks;
}

}  // namespace lightwell
