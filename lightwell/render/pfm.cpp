// SPDX-License-Identifier: Apache-2.0
#include <charconv>
#include <cmath>
#include <string>

#include "lightwell/render/float_picture.h"
#include "lightwell/texture/image_file.h"

namespace lightwell {
namespace {

// Reads the next word of the header and the single white space after it.
std::string_view word(ByteReader& reader, Bytes file) {
  const auto is_space = [](uint8_t c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; };
  const size_t begin = reader.position();
  while (reader.ok() && !is_space(reader.u8())) continue;
  if (!reader.ok()) return {};
  return {reinterpret_cast<const char*>(file.data()) + begin, reader.position() - 1 - begin};
}

template <typename T>
bool parse(std::string_view text, T& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

}  // namespace

bool is_pfm(Bytes file) {
  return file.size() > 2 && file[0] == 'P' && (file[1] == 'F' || file[1] == 'f') && (file[2] == '\n' || file[2] == ' ');
}

std::vector<uint8_t> write_pfm(const Picture& picture) {
  ByteWriter writer;
  writer.append(as_bytes("PF\n" + std::to_string(picture.width) + " " + std::to_string(picture.height) + "\n-1.0\n"));
  const auto row = static_cast<size_t>(picture.width) * 3;
  for (size_t y = static_cast<size_t>(picture.height); y-- > 0;) {
    for (size_t i = 0; i < row; i++) writer.f32(picture.pixels[y * row + i]);
  }
  return writer.release();
}

Result<Picture> read_pfm(Bytes file) {
  ByteReader reader(file);
  const size_t channels = word(reader, file) == "PF" ? 3 : 1;
  uint32_t width = 0, height = 0;
  float scale = 0;  // its sign tells the byte order
  if (!parse(word(reader, file), width) || !parse(word(reader, file), height) || !parse(word(reader, file), scale) ||
      scale == 0) {
    return fail("PFM", "broken header");
  }
  LW_CHECK(check_image_size(width, height));
  if (reader.remaining() < uint64_t(width) * height * channels * 4) return fail("PFM", "ends too early");

  Picture picture{static_cast<int>(width), static_cast<int>(height), {}};
  picture.pixels.resize(size_t(width) * height * 3);
  for (size_t y = height; y-- > 0;) {
    for (size_t x = 0; x < width; x++) {
      float* pixel = &picture.pixels[(y * width + x) * 3];
      for (size_t c = 0; c < channels; c++) {
        const uint32_t bits = reader.u32();
        pixel[c] = std::bit_cast<float>(scale < 0 ? bits : __builtin_bswap32(bits));
      }
      if (channels == 1) pixel[1] = pixel[2] = pixel[0];
    }
  }
  return picture;
}

}  // namespace lightwell
