// SPDX-License-Identifier: Apache-2.0
#include "lightwell/texture/orientation.h"

#include <zlib.h>

#include <algorithm>
#include <string_view>

#include "lightwell/texture/image_format.h"

namespace lightwell {
namespace {

using Span = std::span<uint8_t>;

std::string_view text_of(Bytes bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

/// A part of the file from a place on; empty where the file does not reach.
Span part(Span file, size_t at, size_t length) {
  if (at > file.size() || length > file.size() - at) return {};
  return file.subspan(at, length);
}

/// Numbers of a TIFF file in its byte order.
class Tiff {
 public:
  explicit Tiff(Span bytes) : bytes_(bytes) {
    big_ = text_of(bytes).starts_with(std::string_view("MM\0*", 4));
    known_ = big_ || text_of(bytes).starts_with(std::string_view("II*\0", 4));
  }

  bool known() const { return known_; }
  uint64_t number(size_t at, size_t size) const {
    const Span field = part(bytes_, at, size);
    uint64_t value = 0;
    for (size_t i = 0; i < field.size(); i++) value |= uint64_t(field[big_ ? field.size() - 1 - i : i]) << (8 * i);
    return value;
  }
  /// Writes a number of two bytes.
  void set(size_t at, uint8_t value) {
    const Span field = part(bytes_, at, 2);
    if (field.empty()) return;
    field[big_ ? 1 : 0] = value;
    field[big_ ? 0 : 1] = 0;
  }

 private:
  Span bytes_;
  bool big_ = false, known_ = false;
};

/// Exif data are a TIFF file, whose first directory may hold the orientation (Exif 2.32, section 4.6.4).
bool turn_upright(Span exif) {
  constexpr uint64_t orientation = 0x0112;
  constexpr uint8_t upright = 1;
  constexpr size_t entry_size = 12, place_of_value = 8;
  Tiff tiff(exif);
  if (!tiff.known()) return false;
  const size_t directory = tiff.number(4, 4), entries = tiff.number(directory, 2);
  for (size_t i = 0; i < entries; i++) {
    const size_t entry = directory + 2 + i * entry_size;
    if (part(exif, entry, entry_size).empty()) return false;
    if (tiff.number(entry, 2) != orientation) continue;
    const size_t value = entry + place_of_value;
    const bool turned = tiff.number(value, 2) != upright;
    if (turned) tiff.set(value, upright);
    return turned;
  }
  return false;
}

bool make_jpeg_upright(Span file) {
  constexpr std::string_view mark("Exif\0\0", 6);
  constexpr uint8_t app1 = 0xe1, start_of_scan = 0xda;
  bool turned = false;
  for (size_t at = 2; at + 4 <= file.size() && file[at] == 0xff && file[at + 1] != start_of_scan;) {
    if (file[at + 1] == 0xff) {  // a fill byte
      at++;
      continue;
    }
    const size_t length = size_t(file[at + 2]) << 8 | file[at + 3];
    if (length < 2) break;
    const Span segment = part(file, at + 4, length - 2);
    if (file[at + 1] == app1 && text_of(segment).starts_with(mark))
      turned |= turn_upright(segment.subspan(mark.size()));
    at += 2 + length;
  }
  return turned;
}

bool make_webp_upright(Span file) {
  bool turned = false;
  for (size_t at = 12; at + 8 <= file.size();) {
    size_t length = 0;
    for (size_t i = 0; i < 4; i++) length |= size_t(file[at + 4 + i]) << (8 * i);
    if (text_of(file.subspan(at, 4)) == "EXIF") turned |= turn_upright(part(file, at + 8, length));
    at += 8 + length + length % 2;
  }
  return turned;
}

bool make_png_upright(Span file) {
  const auto big_endian = [&](size_t at) {
    size_t value = 0;
    for (size_t i = 0; i < 4; i++) value = value << 8 | file[at + i];
    return value;
  };
  bool turned = false;
  for (size_t at = 8; at + 12 <= file.size();) {
    const size_t length = big_endian(at);
    if (length > file.size() - at - 12) break;
    const Span chunk = file.subspan(at + 4, 4 + length);  // with its name, as the checksum has it
    if (text_of(chunk).starts_with("eXIf") && turn_upright(chunk.subspan(4))) {
      turned = true;
      const auto check = static_cast<uint32_t>(crc32(0, chunk.data(), static_cast<uInt>(chunk.size())));
      for (size_t i = 0; i < 4; i++) file[at + 8 + length + i] = static_cast<uint8_t>(check >> (24 - 8 * i));
    }
    at += 12 + length;
  }
  return turned;
}

}  // namespace

bool make_upright(Span file) {
  const auto format = image_format(file);
  if (!format) return false;
  switch (*format) {
    case ImageFormat::png: return make_png_upright(file);
    case ImageFormat::jpeg: return make_jpeg_upright(file);
    case ImageFormat::webp: return make_webp_upright(file);
  }
  return false;
}

}  // namespace lightwell
