// SPDX-License-Identifier: Apache-2.0
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

}  // namespace lightwell
