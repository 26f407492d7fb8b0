// SPDX-License-Identifier: Apache-2.0
#include "lightwell/texture/image_size.h"

#include "lightwell/texture/image_format.h"

namespace lightwell {
namespace {

std::optional<ImageSize> if_read(const ByteReader& reader, uint32_t width, uint32_t height) {
  return reader.ok() ? std::optional(ImageSize{width, height}) : std::nullopt;
}

/// The next `count` bytes as a number, the most significant first.
uint32_t big_endian(ByteReader& reader, int count) {
  uint32_t number = 0;
  for (int i = 0; i < count; i++) number = number << 8 | reader.u8();
  return number;
}

uint32_t little_endian_24(ByteReader& reader) {
  const uint32_t low = reader.u16();
  return low | uint32_t(reader.u8()) << 16;
}

/// W3C PNG, section 11.2.1: IHDR is the first chunk.
std::optional<ImageSize> png_size(Bytes file) {
  constexpr size_t before = 8 + 4 + 4;  // signature, length and name of the chunk
  ByteReader reader(file);
  reader.take(before);
  const uint32_t width = big_endian(reader, 4), height = big_endian(reader, 4);
  return if_read(reader, width, height);
}

/// Whether a marker begins a frame: SOF0 to SOF15 without DHT, JPG and DAC (ITU-T T.81, table B.1).
bool begins_frame(uint8_t marker) {
  return marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
}

/// Whether a marker stands alone, without a segment behind it: TEM, RST0 to RST7, SOI.
bool stands_alone(uint8_t marker) { return marker == 0x01 || (marker >= 0xd0 && marker <= 0xd8); }

std::optional<ImageSize> jpeg_size(Bytes file) {
  ByteReader reader(file);
  while (reader.ok()) {
    while (reader.ok() && reader.u8() != 0xff) continue;
    uint8_t marker = 0xff;
    while (reader.ok() && marker == 0xff) marker = reader.u8();
    if (marker == 0 || stands_alone(marker)) continue;
    const uint32_t length = big_endian(reader, 2);
    if (begins_frame(marker)) {
      reader.u8();  // precision
      const uint32_t height = big_endian(reader, 2), width = big_endian(reader, 2);
      return if_read(reader, width, height);
    }
    reader.take(length < 2 ? reader.remaining() + 1 : length - 2);
  }
  return std::nullopt;
}

/// RFC 9649, sections 2.5 to 2.7: a canvas, or a lossless or lossy image alone.
std::optional<ImageSize> webp_size(Bytes file) {
  ByteReader reader(file);
  reader.take(12);
  const Bytes name = reader.take(4);
  const std::string_view chunk(reinterpret_cast<const char*>(name.data()), name.size());
  reader.u32();  // the chunk's length
  if (chunk == "VP8X") {
    reader.u32();  // flags
    const uint32_t width = little_endian_24(reader) + 1, height = little_endian_24(reader) + 1;
    return if_read(reader, width, height);
  }
  constexpr uint32_t side = (1u << 14) - 1;
  if (chunk == "VP8L") {
    reader.u8();  // signature
    const uint32_t sides = reader.u32();
    return if_read(reader, (sides & side) + 1, (sides >> 14 & side) + 1);
  }
  if (chunk != "VP8 ") return std::nullopt;
  reader.take(3 + 3);  // frame tag and start code
  const uint32_t width = reader.u16() & side, height = reader.u16() & side;
  return if_read(reader, width, height);
}

}  // namespace

std::optional<ImageSize> image_size(Bytes file) {
  const auto format = image_format(file);
  if (!format) return std::nullopt;
  switch (*format) {
    case ImageFormat::png: return png_size(file);
    case ImageFormat::jpeg: return jpeg_size(file);
    case ImageFormat::webp: return webp_size(file);
  }
  return std::nullopt;
}

}  // namespace lightwell
