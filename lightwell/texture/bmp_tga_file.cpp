// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <climits>
#include <cstdlib>
#include <memory>

#include "lightwell/texture/image_file.h"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#define STBI_NO_STDIO
#define STBI_NO_LINEAR
#define STBI_NO_FAILURE_STRINGS
#include <stb_image.h>

namespace lightwell {
namespace {

// What a file or its palette lacks, the library takes from memory that nobody has set. So the length of every file is
// checked here before the library reads one, and palettes are made whole.

bool is_bmp(Bytes file) { return file.size() >= 2 && file[0] == 'B' && file[1] == 'M'; }

/// The fields of a BMP header that tell how long the file is (BITMAPFILEHEADER and BITMAPINFOHEADER).
struct BmpHeader {
  size_t pixels_at = 0, info_bytes = 0, bits = 0;

  size_t palette_at() const { return 14 + info_bytes; }
  size_t palette_bytes() const { return bits < 16 ? size_t(4) << bits : 0; }
};

BmpHeader bmp_header(ByteReader reader) {
  BmpHeader header;
  reader.take(10);
  header.pixels_at = reader.u32();
  header.info_bytes = reader.u32();
  reader.take(10);
  header.bits = reader.u16();
  return header;
}

/// Whether the rows of a BMP end within the file.
bool has_bmp_rows(Bytes file, const BmpHeader& header, size_t width, size_t height) {
  const size_t stride = (width * header.bits + 31) / 32 * 4;
  return header.pixels_at + stride * height <= file.size();
}

/// The file of a BMP with black for the colours that its palette leaves out; as it is when there are none.
std::vector<uint8_t> with_whole_palette(Bytes file, const BmpHeader& header) {
  std::vector<uint8_t> whole(file.begin(), file.end());
  const size_t end = header.palette_at() + header.palette_bytes();
  if (header.palette_bytes() == 0 || header.pixels_at >= end || header.pixels_at < header.palette_at()) return whole;
  whole.insert(whole.begin() + static_cast<ptrdiff_t>(header.pixels_at), end - header.pixels_at, 0);
  for (size_t i = 0; i < 4; i++) whole[10 + i] = static_cast<uint8_t>(end >> (8 * i));
  return whole;
}

/// Whether the pixels of a TGA end within the file (Truevision TGA File Format Specification 2.0; what precedes a
/// palette is skipped as the library does it).
bool has_tga_pixels(Bytes file) {
  ByteReader reader(file);
  const size_t id_bytes = reader.u8();
  const bool indexed = reader.u8() != 0, run_lengths = reader.u8() >= 8;
  const size_t palette_first = reader.u16(), colors = reader.u16(), color_bits = reader.u8();
  reader.u32();  // where the picture stands on a screen
  const size_t width = reader.u16(), height = reader.u16(), pixels = width * height;
  const size_t pixel_bytes = (reader.u8() + 7u) / 8;
  reader.u8();  // which corner is first
  reader.take(id_bytes + (indexed ? palette_first + colors * ((color_bits + 7) / 8) : 0));
  if (!run_lengths) return reader.take(pixels * pixel_bytes).size() == pixels * pixel_bytes;
  for (size_t done = 0; done < pixels && reader.ok();) {
    const uint8_t packet = reader.u8();
    const size_t count = std::min<size_t>(1 + (packet & 127u), pixels - done);
    reader.take(pixel_bytes * (packet & 128 ? 1 : count));
    done += count;
  }
  return reader.ok();
}

/// A fourth channel that is zero everywhere is one that nobody has set.
void fill_unset_alpha(Image& image) {
  if (image.channels != 4) return;
  for (size_t i = 3; i < image.pixels.size(); i += 4)
    if (image.pixels[i] != 0) return;
  for (size_t i = 3; i < image.pixels.size(); i += 4) image.pixels[i] = 255;
}

Result<Image> read_checked(Bytes file, const char* format) {
  Image image;
  constexpr int channels_of_file = 0;
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      stbi_load_from_memory(file.data(), static_cast<int>(file.size()), &image.width, &image.height, &image.channels,
                            channels_of_file),
      std::free);
  if (!pixels) return fail(ErrorKind::unsupported, format, "is damaged, or of a kind that is not read");
  const size_t size =
      static_cast<size_t>(image.width) * static_cast<size_t>(image.height) * static_cast<size_t>(image.channels);
  image.pixels.assign(pixels.get(), pixels.get() + size);
  fill_unset_alpha(image);
  return image;
}

}  // namespace

Result<Image> read_bmp_or_tga(Bytes file, ImageLimit limit) {
  constexpr size_t bytes_of_os2 = 12;  // a header whose palette the library cuts
  const bool bmp = is_bmp(file);
  const BmpHeader header = bmp_header(ByteReader(file));
  int width = 0, height = 0, channels = 0;
  const bool known = file.size() <= INT_MAX / 2 && !(bmp && header.info_bytes == bytes_of_os2) &&
                     stbi_info_from_memory(file.data(), static_cast<int>(file.size()), &width, &height, &channels);
  if (!known && bmp) return fail(ErrorKind::unsupported, "BMP", "is damaged, or of a kind that is not read");
  if (!known) return fail(ErrorKind::unsupported, "image", "is no PNG, JPEG, WebP, BMP or TGA");
  const auto columns = static_cast<size_t>(width);
  const auto rows = static_cast<size_t>(std::abs(int64_t(height)));  // of a BMP, negative when the first is at the top
  LW_CHECK(check_image_size(columns, rows, limit));
  if (!(bmp ? has_bmp_rows(file, header, columns, rows) : has_tga_pixels(file)))
    return fail(bmp ? "BMP" : "TGA", "the file is too short for its size");
  return bmp ? read_checked(with_whole_palette(file, header), "BMP") : read_checked(file, "TGA");
}

}  // namespace lightwell
