// SPDX-License-Identifier: Apache-2.0
#include "lightwell/texture/stream.h"

namespace lightwell {

Result<TextureParameters> decode_texture_parameters(Bytes bytes) {
  ByteReader reader(bytes);
  TextureParameters parameters;
  parameters.bytes = reader.u32();
  const uint8_t format = reader.u8();
  parameters.width = reader.u32();
  parameters.height = reader.u32();
  if (!reader.ok() || reader.remaining() > 0) return fail("texture parameters", "wrong length");
  if (format > static_cast<uint8_t>(ImageFormat::webp))
    return fail(ErrorKind::unsupported, "texture parameters", "unknown image format");
  if (parameters.bytes == 0 || parameters.width == 0 || parameters.height == 0)
    return fail("texture parameters", "an empty image");
  parameters.format = static_cast<ImageFormat>(format);
  return parameters;
}

}  // namespace lightwell
