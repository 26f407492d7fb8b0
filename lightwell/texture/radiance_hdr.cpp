// SPDX-License-Identifier: Apache-2.0
#include "lightwell/texture/radiance_hdr.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

namespace lightwell {
namespace {

constexpr size_t max_side = size_t(1) << 15;  // what the new run-length coding can say
constexpr size_t longest_line = 4096;

using Rgbe = std::array<uint8_t, 4>;

struct Header {
  size_t width = 0, height = 0;
  bool bottom_up = false, right_to_left = false;
  double exposure = 1;
};

/// The next line without its end; none when the text ends or goes on for too long.
Result<std::string> next_line(ByteReader& reader) {
  std::string line;
  while (line.size() < longest_line) {
    const auto c = static_cast<char>(reader.u8());
    if (!reader.ok()) break;
    if (c == '\n') return line;
    if (c != '\r') line += c;
  }
  return fail("HDR", "the header does not end");
}

template <typename T>
bool parse(std::string_view text, T& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

/// One line of the header: the format and the exposure matter, of several exposures the product.
Result<void> read_variable(std::string_view line, Header& header) {
  if (line.starts_with("FORMAT=") && line != "FORMAT=32-bit_rle_rgbe")
    return fail(ErrorKind::unsupported, "HDR", "unsupported " + std::string(line.substr(0, 40)));
  if (!line.starts_with("EXPOSURE=")) return {};
  line.remove_prefix(line.find_first_not_of(" \t", 9) == line.npos ? line.size() : line.find_first_not_of(" \t", 9));
  double exposure = 0;
  if (!parse(line, exposure) || !(exposure > 0) || !std::isfinite(exposure)) return fail("HDR", "bad EXPOSURE");
  header.exposure *= exposure;
  return {};
}

/// "-Y 512 +X 1024": rows from top to bottom, columns from left to right.
Result<void> read_resolution(const std::string& line, ImageLimit limit, Header& header) {
  std::array<std::string, 4> words;
  size_t word = 0;
  for (const char c : line) {
    if (c != ' ') words[word] += c;
    if (c == ' ' && !words[word].empty() && ++word == words.size()) break;
  }
  const bool rows_first = words[0] == "-Y" || words[0] == "+Y";
  const bool columns_next = words[2] == "-X" || words[2] == "+X";
  if (!rows_first || !columns_next || !parse(words[1], header.height) || !parse(words[3], header.width))
    return fail(ErrorKind::unsupported, "HDR", "unsupported resolution \"" + line.substr(0, 40) + "\"");
  if (header.width == 0 || header.height == 0) return fail("HDR", "an empty image");
  if (header.width >= max_side || header.height >= max_side || header.width * header.height > limit.pixels)
    return fail(
        ErrorKind::limit, "HDR",
        words[3] + " x " + words[1] + " pixels are more than " + std::to_string(limit.pixels >> 20) + " million");
  header.bottom_up = words[0] == "+Y";
  header.right_to_left = words[2] == "-X";
  return {};
}

Result<Header> read_header(ByteReader& reader, ImageLimit limit) {
  LW_TRY(magic, next_line(reader));
  if (!magic.starts_with("#?")) return fail("HDR", "is no Radiance picture");
  Header header;
  while (true) {
    LW_TRY(line, next_line(reader));
    if (line.empty()) break;
    LW_CHECK(read_variable(line, header));
  }
  LW_TRY(resolution, next_line(reader));
  LW_CHECK(read_resolution(resolution, limit, header));
  return header;
}

/// A row in the new coding: the four components one after another, each in runs (above 128) and literal spans.
bool read_components(ByteReader& reader, std::vector<Rgbe>& row) {
  for (size_t component = 0; component < 4; component++) {
    for (size_t x = 0; x < row.size();) {
      const uint8_t code = reader.u8();
      const bool run = code > 128;
      const size_t count = run ? code - 128u : code;
      if (count == 0 || count > row.size() - x) return false;
      uint8_t value = run ? reader.u8() : 0;
      for (size_t i = 0; i < count; i++) {
        if (!run) value = reader.u8();
        row[x++][component] = value;
      }
      if (!reader.ok()) return false;
    }
  }
  return true;
}

/// A row in the old coding, its first pixel already read: pixels, among them (1, 1, 1, n), which repeats the one before
/// n times, n << 8 times directly after another such, and so on.
bool read_pixels(ByteReader& reader, Rgbe pixel, std::vector<Rgbe>& row) {
  int shift = 0;
  for (size_t x = 0;;) {
    if (pixel[0] == 1 && pixel[1] == 1 && pixel[2] == 1) {
      const size_t count = shift < 24 ? size_t(pixel[3]) << shift : row.size();
      if (x == 0 || count > row.size() - x) return false;
      std::fill_n(row.begin() + static_cast<ptrdiff_t>(x), count, row[x - 1]);
      x += count;
      shift += 8;
    } else {
      row[x++] = pixel;
      shift = 0;
    }
    if (x == row.size()) return true;
    for (uint8_t& byte : pixel) byte = reader.u8();
    if (!reader.ok()) return false;
  }
}

bool read_row(ByteReader& reader, std::vector<Rgbe>& row) {
  Rgbe first;
  for (uint8_t& byte : first) byte = reader.u8();
  if (!reader.ok()) return false;
  const bool new_coding = row.size() >= 8 && row.size() < max_side && first[0] == 2 && first[1] == 2 && first[2] < 128;
  if (!new_coding) return read_pixels(reader, first, row);
  return (size_t(first[2]) << 8 | first[3]) == row.size() && read_components(reader, row);
}

void append_radiance(const Rgbe& pixel, double exposure, std::vector<float>& out) {
  const double scale = pixel[3] == 0 ? 0 : std::ldexp(1 / exposure, pixel[3] - 136);
  for (size_t c = 0; c < 3; c++) out.push_back(static_cast<float>(pixel[c] * scale));
}

void flip_rows(RadianceImage& image) {
  const auto stride = static_cast<ptrdiff_t>(image.width) * 3;
  for (int y = 0; y < image.height / 2; y++) {
    std::swap_ranges(image.pixels.begin() + y * stride, image.pixels.begin() + (y + 1) * stride,
                     image.pixels.begin() + (image.height - 1 - y) * stride);
  }
}

}  // namespace

Result<RadianceImage> read_radiance_hdr(Bytes file, ImageLimit limit) {
  ByteReader reader(file);
  LW_TRY(header, read_header(reader, limit));
  RadianceImage image{static_cast<int>(header.width), static_cast<int>(header.height), {}};
  std::vector<Rgbe> row(header.width);
  for (size_t y = 0; y < header.height; y++) {
    if (!read_row(reader, row)) return fail("HDR row " + std::to_string(y), "damaged, or the file ends too early");
    if (header.right_to_left) std::reverse(row.begin(), row.end());
    for (const Rgbe& pixel : row) append_radiance(pixel, header.exposure, image.pixels);
  }
  if (!std::all_of(image.pixels.begin(), image.pixels.end(), [](float v) { return std::isfinite(v); }))
    return fail("HDR", "a radiance beyond what a float holds");
  if (header.bottom_up) flip_rows(image);
  return image;
}

}  // namespace lightwell
