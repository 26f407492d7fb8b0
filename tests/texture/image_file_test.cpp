// SPDX-License-Identifier: Apache-2.0
#include "lightwell/texture/image_file.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <array>
#include <cstdio>
#include <cstdlib>
// jpeglib.h needs what cstdio declares.
#include <jpeglib.h>

#include "lightwell/base/random.h"
#include "tests/texture/webp_files.h"

namespace lightwell {
namespace {

Image noise(int width, int height, int channels) {
  Image image{width, height, channels, {}};
  Random random(3, static_cast<uint64_t>(channels));
  for (int i = 0; i < width * height * channels; i++) image.pixels.push_back(static_cast<uint8_t>(random.below(256)));
  return image;
}

Image constant(int width, int height, std::vector<uint8_t> pixel) {
  Image image{width, height, static_cast<int>(pixel.size()), {}};
  for (int i = 0; i < width * height; i++) image.pixels.insert(image.pixels.end(), pixel.begin(), pixel.end());
  return image;
}

void append_big_endian(std::vector<uint8_t>& out, uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) out.push_back(static_cast<uint8_t>(value >> shift));
}

void append_chunk(std::vector<uint8_t>& png, const std::string& type, std::vector<uint8_t> data) {
  append_big_endian(png, static_cast<uint32_t>(data.size()));
  data.insert(data.begin(), type.begin(), type.end());
  png.insert(png.end(), data.begin(), data.end());
  append_big_endian(png, static_cast<uint32_t>(crc32(0, data.data(), static_cast<uInt>(data.size()))));
}

/// A PNG as its specification puts it together: any depth and colour type, rows given as packed bytes.
std::vector<uint8_t> hand_made_png(uint32_t width, uint32_t height, uint8_t depth, uint8_t color_type,
                                   std::vector<uint8_t> rows, const std::vector<uint8_t>& palette = {}) {
  std::vector<uint8_t> png = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  std::vector<uint8_t> header;
  append_big_endian(header, width);
  append_big_endian(header, height);
  for (const uint8_t byte : {depth, color_type, uint8_t(0), uint8_t(0), uint8_t(0)}) header.push_back(byte);
  append_chunk(png, "IHDR", header);
  if (!palette.empty()) append_chunk(png, "PLTE", palette);
  const size_t stride = rows.size() / height;
  for (size_t y = height; y-- > 0;) rows.insert(rows.begin() + static_cast<ptrdiff_t>(y * stride), 0);
  std::vector<uint8_t> packed(compressBound(rows.size()));
  uLongf size = packed.size();
  compress(packed.data(), &size, rows.data(), rows.size());
  packed.resize(size);
  append_chunk(png, "IDAT", packed);
  append_chunk(png, "IEND", {});
  return png;
}

std::vector<uint8_t> cmyk_jpeg(const Image& image, bool adobe) {
  jpeg_compress_struct codec{};
  jpeg_error_mgr errors{};
  codec.err = jpeg_std_error(&errors);
  jpeg_create_compress(&codec);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&codec, &bytes, &size);
  codec.image_width = static_cast<JDIMENSION>(image.width);
  codec.image_height = static_cast<JDIMENSION>(image.height);
  codec.input_components = 4;
  codec.in_color_space = JCS_CMYK;
  jpeg_set_defaults(&codec);
  codec.write_Adobe_marker = adobe;
  jpeg_set_quality(&codec, 95, TRUE);
  jpeg_start_compress(&codec, TRUE);
  for (size_t y = 0; y < codec.image_height; y++) {
    auto* row = const_cast<JSAMPROW>(&image.pixels[y * codec.image_width * 4]);
    jpeg_write_scanlines(&codec, &row, 1);
  }
  jpeg_finish_compress(&codec);
  std::vector<uint8_t> file(bytes, bytes + size);
  jpeg_destroy_compress(&codec);
  std::free(bytes);
  return file;
}

void expect_equal(const Result<Image>& read, const Image& expected) {
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_EQ(read->width, expected.width);
  EXPECT_EQ(read->height, expected.height);
  EXPECT_EQ(read->channels, expected.channels);
  EXPECT_EQ(read->pixels, expected.pixels);
}

/// Every prefix of a file gives an image or a one-line error.
void expect_total_on_prefixes(const std::vector<uint8_t>& file) {
  for (size_t size = 0; size < file.size(); size++) {
    const auto read = read_image_file(Bytes(file).first(size));
    EXPECT_TRUE(read || read.error().message().find('\n') == std::string::npos);
  }
}

TEST(Png, RoundTripsEveryNumberOfChannels) {
  for (int channels = 1; channels <= 4; channels++) {
    const Image image = noise(7, 5, channels);
    expect_equal(read_image_file(write_png(image)), image);
  }
}

TEST(Png, ReducesSixteenBitsToEight) {
  const std::vector<uint8_t> rows = {0x00, 0x00, 0x80, 0x80, 0xff, 0xff};
  expect_equal(read_png(hand_made_png(3, 1, 16, 0, rows)), {3, 1, 1, {0, 128, 255}});
}

TEST(Png, ExpandsPalettesAndFewBits) {
  const std::vector<uint8_t> palette = {10, 20, 30, 40, 50, 60, 70, 80, 90};
  expect_equal(read_png(hand_made_png(4, 1, 2, 3, {0b00011000}, palette)),
               {4, 1, 3, {10, 20, 30, 40, 50, 60, 70, 80, 90, 10, 20, 30}});
  expect_equal(read_png(hand_made_png(4, 2, 1, 0, {0b10100000, 0b01010000})),
               {4, 2, 1, {255, 0, 255, 0, 0, 255, 0, 255}});
}

TEST(Png, RefusesHugeAndDamagedFiles) {
  EXPECT_FALSE(read_png(hand_made_png(16385, 1, 8, 0, std::vector<uint8_t>(1))));
  EXPECT_FALSE(read_png(hand_made_png(4, 1, 2, 3, {0})));  // no palette
  auto damaged = write_png(noise(9, 9, 3));
  damaged[40] ^= 0x10;
  EXPECT_FALSE(read_png(damaged));
  expect_total_on_prefixes(write_png(noise(6, 6, 4)));
}

// Quality 95 keeps a constant colour within 3 of 255: what the rounding of YCbCr and of one quantised coefficient
// leaves.
TEST(Jpeg, KeepsConstantGreyAndColour) {
  for (const Image& image : {constant(17, 9, {77}), constant(17, 9, {200, 100, 50})}) {
    const auto read = read_image_file(write_jpeg(image, 95));
    ASSERT_TRUE(read) << read.error().message();
    ASSERT_EQ(read->pixels.size(), image.pixels.size());
    for (size_t i = 0; i < image.pixels.size(); i++) ASSERT_NEAR(read->pixels[i], image.pixels[i], 3);
  }
}

TEST(Jpeg, TurnsInksIntoColour) {
  // Half cyan, no magenta, all yellow, a fifth black: (1 - ink) (1 - black); Adobe's files hold the complements.
  const Image inks = constant(8, 8, {128, 0, 255, 51}), complements = constant(8, 8, {127, 255, 0, 204});
  for (const auto& file : {cmyk_jpeg(inks, false), cmyk_jpeg(complements, true)}) {
    const auto read = read_jpeg(file);
    ASSERT_TRUE(read) << read.error().message();
    ASSERT_EQ(read->channels, 3);
    EXPECT_NEAR(read->pixels[0], 0.5 * 0.8 * 255, 4);
    EXPECT_NEAR(read->pixels[1], 0.8 * 255, 4);
    EXPECT_NEAR(read->pixels[2], 0, 4);
  }
}

// A small file must not make its reader ask for a gigabyte.
TEST(ImageFile, HoldsSizesAgainstTheFile) {
  EXPECT_FALSE(read_png(hand_made_png(8192, 8192, 8, 6, std::vector<uint8_t>(8192))));
  auto jpeg = write_jpeg(constant(8, 8, {5}), 90);
  const std::vector<uint8_t> start_of_frame = {0xff, 0xc0};
  const auto frame = std::search(jpeg.begin(), jpeg.end(), start_of_frame.begin(), start_of_frame.end());
  for (int i = 5; i < 9; i += 2) frame[i] = 0x1f;  // 7944 pixels a side
  const auto read = read_jpeg(jpeg);
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().reason.find("too short"), std::string::npos) << read.error().reason;
}

TEST(Jpeg, RefusesShortFiles) {
  const auto file = write_jpeg(noise(40, 40, 3), 90);
  EXPECT_FALSE(read_jpeg(Bytes(file).first(file.size() / 2)));
  expect_total_on_prefixes(write_jpeg(noise(9, 9, 3), 50));
}

// Quality 90 keeps a constant colour within 3 of 255, as JPEG's; alpha is kept as it is.
TEST(WebP, IsWrittenOfAnyNumberOfChannels) {
  const std::array<uint8_t, 4> grey{77, 77, 77, 255}, clear{90, 90, 90, 40}, red{200, 50, 60, 255},
      glass{30, 90, 200, 60};
  const std::array cases{std::pair(constant(17, 9, {77}), grey), std::pair(constant(17, 9, {90, 40}), clear),
                         std::pair(constant(17, 9, {200, 50, 60}), red),
                         std::pair(constant(17, 9, {30, 90, 200, 60}), glass)};
  for (const auto& [image, expected] : cases) {
    const auto read = read_image_file(write_webp(image, 90));
    ASSERT_TRUE(read) << read.error().message();
    ASSERT_EQ(read->width, 17);
    ASSERT_EQ(read->height, 9);
    ASSERT_EQ(read->channels, image.channels % 2 == 0 ? 4 : 3);
    for (size_t c = 0; c < static_cast<size_t>(read->channels); c++) EXPECT_NEAR(read->pixels[c], expected[c], 3);
  }
  EXPECT_TRUE(write_webp(constant(16384, 1, {7}), 90).empty());
}

TEST(WebP, ReadsColourWithAndWithoutAlpha) {
  expect_equal(read_image_file(lossless_webp(noise(11, 6, 3))), noise(11, 6, 3));
  Image image = noise(11, 6, 4);
  for (size_t i = 3; i < image.pixels.size(); i += 4)
    image.pixels[i] |= 1;  // fully transparent pixels lose their colour
  expect_equal(read_image_file(lossless_webp(image)), image);
  expect_total_on_prefixes(lossless_webp(noise(5, 5, 4)));
}

// 8192 pixels a side would be a quarter of a gigabyte; a header is all there is.
TEST(WebP, MemoryNeedsBytes) {
  ByteWriter file;
  file.append(as_bytes("RIFF"));
  file.u32(22);
  file.append(as_bytes("WEBPVP8L"));
  file.u32(10);
  file.u8(0x2f);
  file.u32(8191 | 8191 << 14);
  file.append(std::vector<uint8_t>(5));
  const auto read = read_webp(file.bytes());
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message().find("claims more pixels"), std::string::npos) << read.error().message();
}

/// A BMP of the kind that most programs write: 24 bits, or 8 with a palette of the given colours; rows from the bottom.
std::vector<uint8_t> bmp(int width, int height, uint16_t bits, const std::vector<uint8_t>& rows,
                         const std::vector<uint8_t>& palette = {}) {
  const auto pixels_at = static_cast<uint32_t>(54 + palette.size());
  ByteWriter file;
  file.append(as_bytes("BM"));
  file.u32(static_cast<uint32_t>(pixels_at + rows.size()));
  file.u32(0);
  file.u32(pixels_at);
  for (const int number : {40, width, height}) file.u32(static_cast<uint32_t>(number));
  file.u16(1);
  file.u16(bits);
  for (int i = 0; i < 6; i++) file.u32(0);
  file.append(palette);
  file.append(rows);
  return file.release();
}

/// A TGA with its first row at the top.
std::vector<uint8_t> tga(uint16_t width, uint16_t height, uint8_t type, uint8_t bits, const std::vector<uint8_t>& rest,
                         uint16_t colors = 0) {
  ByteWriter file;
  file.u8(0);
  file.u8(colors > 0 ? 1 : 0);
  file.u8(type);
  file.u16(0);
  file.u16(colors);
  file.u8(colors > 0 ? 24 : 0);
  file.u32(0);
  file.u16(width);
  file.u16(height);
  file.u8(bits);
  file.u8(0x20);
  file.append(rest);
  return file.release();
}

const std::vector<uint8_t> small_bmp = bmp(1, 2, 24, {3, 2, 1, 0, 6, 5, 4, 0});
const std::vector<uint8_t> small_tga = tga(3, 1, 10, 24, {0x81, 3, 2, 1, 0x00, 6, 5, 4});

TEST(Bmp, ReadsColoursAndPalettes) {
  expect_equal(read_image_file(small_bmp), {1, 2, 3, {4, 5, 6, 1, 2, 3}});
  expect_equal(read_image_file(bmp(1, -2, 24, {3, 2, 1, 0, 6, 5, 4, 0})), {1, 2, 3, {1, 2, 3, 4, 5, 6}});
  expect_equal(read_image_file(bmp(1, 1, 32, {3, 2, 1, 0})), {1, 1, 4, {1, 2, 3, 255}});
  // The second pixel is of a colour that the palette lacks.
  expect_equal(read_image_file(bmp(2, 1, 8, {1, 9, 0, 0}, {3, 2, 1, 0, 6, 5, 4, 0})), {2, 1, 3, {4, 5, 6, 0, 0, 0}});
}

TEST(Tga, ReadsColoursRunsGreyAndPalettes) {
  expect_equal(read_image_file(tga(2, 1, 2, 24, {3, 2, 1, 6, 5, 4})), {2, 1, 3, {1, 2, 3, 4, 5, 6}});
  expect_equal(read_image_file(tga(1, 1, 2, 32, {3, 2, 1, 9})), {1, 1, 4, {1, 2, 3, 9}});
  expect_equal(read_image_file(tga(1, 1, 2, 32, {3, 2, 1, 0})), {1, 1, 4, {1, 2, 3, 255}});
  expect_equal(read_image_file(tga(2, 1, 3, 8, {7, 8})), {2, 1, 1, {7, 8}});
  expect_equal(read_image_file(small_tga), {3, 1, 3, {1, 2, 3, 1, 2, 3, 4, 5, 6}});
  expect_equal(read_image_file(tga(2, 1, 1, 8, {3, 2, 1, 6, 5, 4, 1, 0}, 2)), {2, 1, 3, {4, 5, 6, 1, 2, 3}});
}

// The library would take what is missing from memory that nobody has set.
TEST(BmpAndTga, RefuseShortFiles) {
  for (const auto& file :
       {small_bmp, small_tga, tga(3, 1, 2, 24, std::vector<uint8_t>(9)), tga(2, 1, 1, 8, {3, 2, 1, 6, 5, 4, 1, 0}, 2)})
    for (size_t size = 0; size < file.size(); size++) EXPECT_FALSE(read_image_file(Bytes(file).first(size))) << size;
  for (const auto& file : {bmp(8192, 8192, 24, {1}), tga(8192, 8192, 2, 32, {1}), tga(8192, 8192, 10, 32, {0xff})}) {
    const auto read = read_image_file(file);
    ASSERT_FALSE(read);
    EXPECT_NE(read.error().reason.find("too short"), std::string::npos) << read.error().reason;
  }
  EXPECT_EQ(read_image_file(bmp(9000, 9000, 1, {1})).error().kind, ErrorKind::limit);
  EXPECT_EQ(read_image_file(tga(9000, 9000, 3, 8, {1})).error().kind, ErrorKind::limit);
}

TEST(ImageFile, RefusesWhatItDoesNotKnow) {
  EXPECT_FALSE(read_image_file({}));
  EXPECT_FALSE(read_image_file(as_bytes("GIF89a")));
  EXPECT_FALSE(check_image_size(0, 5));
  EXPECT_FALSE(check_image_size(16385, 1));
  EXPECT_TRUE(check_image_size(16384, 4096));
  EXPECT_FALSE(check_image_size(16384, 4097));
}

TEST(ImageFile, ItsLimitCanBeSet) {
  constexpr ImageLimit raised{uint64_t(1) << 28}, lowered{64};
  EXPECT_TRUE(check_image_size(16384, 16384, raised));
  EXPECT_FALSE(check_image_size(16385, 16384, raised));
  EXPECT_TRUE(check_image_size(20000, 1, raised));
  const Image wide = constant(17, 2, {9}), square = constant(9, 8, {9});
  for (const Image& image : {wide, square})
    for (const auto& file : {write_png(image), write_jpeg(image, 90)}) {
      const auto read = read_image_file(file, lowered);
      ASSERT_FALSE(read);
      EXPECT_EQ(read.error().kind, ErrorKind::limit);
      EXPECT_NE(naming_image_option(read.error()).message().find("--max-image-megapixels"), std::string::npos);
    }
  EXPECT_TRUE(read_image_file(write_png(constant(16, 4, {9})), lowered));
}

TEST(ImageFile, SurvivesFlippedBits) {
  Random random(5, 0);
  for (const auto& file : {write_png(noise(12, 12, 3)), write_jpeg(noise(12, 12, 3), 70),
                           lossless_webp(noise(12, 12, 4)), small_bmp, small_tga}) {
    for (int i = 0; i < 500; i++) {
      auto damaged = file;
      damaged[random.below(static_cast<uint32_t>(file.size()))] ^= static_cast<uint8_t>(1 + random.below(255));
      const auto read = read_image_file(damaged);
      ASSERT_TRUE(!read || read->pixels.size() == static_cast<size_t>(read->width * read->height * read->channels));
    }
  }
}

TEST(Preview, IsTheSmallerOfPngAndJpeg) {
  const auto few_colors = write_preview(constant(64, 64, {200, 100, 50, 255}), 16, true);
  EXPECT_EQ(image_format(few_colors), ImageFormat::png);
  const auto opaque = read_image_file(few_colors);
  ASSERT_TRUE(opaque);
  EXPECT_EQ(opaque->channels, 3);
  EXPECT_EQ(image_format(write_preview(noise(64, 64, 3), 64, true)), ImageFormat::jpeg);
  EXPECT_EQ(image_format(write_preview(noise(64, 64, 4), 64, true)), ImageFormat::png);
}

}  // namespace
}  // namespace lightwell
