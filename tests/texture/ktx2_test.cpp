// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "lightwell/base/file.h"
#include "lightwell/base/random.h"
#include "lightwell/texture/image_file.h"
#include "lightwell/texture/ktx2_file.h"

namespace lightwell {
namespace {

// tests/data/ktx2/README.md says what these are.
constexpr std::array names = {"etc1s_rgb", "etc1s_rgba_mips", "etc1s_grey",          "etc1s_runs",
                              "uastc_rgb", "uastc_all_modes", "uastc_rgba_mips_zstd"};

// Fields of a file (KTX 2.0, section "File Structure").
constexpr size_t format_at = 12, width_at = 20, depth_at = 28, layers_at = 32, faces_at = 36, levels_at = 40,
                 supercompression_at = 44, descriptor_at = 48, level_at = 80, uncompressed_at = 96;

std::vector<uint8_t> data_file(const std::string& name) {
  return read_file(std::filesystem::path(LIGHTWELL_TEST_DATA) / "ktx2" / name).value();
}

std::vector<uint8_t> sample(const std::string& name) { return data_file(name + ".ktx2"); }

uint32_t field(const std::vector<uint8_t>& file, size_t at) { return ByteReader(Bytes(file).subspan(at)).u32(); }

std::vector<uint8_t> with_field(std::vector<uint8_t> file, size_t at, uint32_t value) {
  for (size_t i = 0; i < 4; i++) file[at + i] = static_cast<uint8_t>(value >> (8 * i));
  return file;
}

/// Where the descriptor has the channel of its sample.
size_t channel_at(const std::vector<uint8_t>& file, size_t sample) {
  return field(file, descriptor_at) + 4 + 24 + 16 * sample + 3;
}

std::vector<uint8_t> with_channel(std::vector<uint8_t> file, size_t sample, uint8_t channel) {
  file[channel_at(file, sample)] = channel;
  return file;
}

void expect_equal(const Result<Image>& read, const Image& image) {
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_EQ(read->width, image.width);
  EXPECT_EQ(read->height, image.height);
  EXPECT_EQ(read->channels, image.channels);
  EXPECT_TRUE(read->pixels == image.pixels);
}

void expect_refused(const std::vector<uint8_t>& file, ErrorKind kind, const std::string& reason) {
  const auto read = read_ktx2(file);
  ASSERT_FALSE(read) << reason;
  EXPECT_EQ(read.error().kind, kind) << read.error().message();
  EXPECT_NE(read.error().message().find(reason), std::string::npos) << read.error().message();
}

TEST(Ktx2, DecodesAsTheReferenceTranscoder) {
  for (const std::string name : names) {
    SCOPED_TRACE(name);
    const auto reference = read_png(data_file(name + ".png"));
    ASSERT_TRUE(reference) << reference.error().message();
    expect_equal(read_ktx2(sample(name)), *reference);
    expect_equal(read_image_file(sample(name)), *reference);
  }
}

TEST(Ktx2, WithoutAlphaHasThreeChannels) {
  constexpr uint8_t rgb = 0;
  const auto four = read_ktx2(sample("uastc_all_modes"));
  ASSERT_TRUE(four);
  Image three{four->width, four->height, 3, {}};
  for (size_t i = 0; i < four->pixels.size(); i++)
    if (i % 4 < 3) three.pixels.push_back(four->pixels[i]);
  expect_equal(read_ktx2(with_channel(sample("uastc_all_modes"), 0, rgb)), three);
}

// What is alpha in one file is green in a file of red and green.
TEST(Ktx2, ReadsRedAndGreen) {
  constexpr uint8_t red = 3, green = 4;
  const auto file = sample("etc1s_rgba_mips");
  const auto colors = read_ktx2(file);
  ASSERT_TRUE(colors);
  Image expected{colors->width, colors->height, 3, {}};
  for (size_t i = 0; i < colors->pixels.size(); i += 4)
    for (const size_t c : {0, 3, 2}) expected.pixels.push_back(colors->pixels[i + c]);
  expect_equal(read_ktx2(with_channel(with_channel(file, 0, red), 1, green)), expected);
}

TEST(Ktx2, IsKnownByItsFirstBytes) {
  EXPECT_TRUE(is_ktx2(sample("etc1s_rgb")));
  EXPECT_FALSE(is_ktx2({}));
  EXPECT_FALSE(is_ktx2(as_bytes("\xabKTX 11\xbb\r\n\x1a\n")));
  EXPECT_FALSE(read_ktx2(data_file("etc1s_rgb.png")));
}

TEST(Ktx2, RefusesShortFiles) {
  for (const std::string name : names) {
    const auto file = sample(name);
    for (size_t size = 0; size < file.size(); size++)
      ASSERT_FALSE(read_ktx2(Bytes(file).first(size))) << name << " " << size;
  }
}

TEST(Ktx2, SurvivesRandomEdits) {
  Random random(7, 0);
  for (const std::string name : names) {
    const auto file = sample(name);
    for (int i = 0; i < 400; i++) {
      auto damaged = file;
      for (uint32_t edits = 1 + random.below(3); edits > 0; edits--)
        damaged[random.below(static_cast<uint32_t>(file.size()))] = static_cast<uint8_t>(random.below(256));
      const auto read = read_ktx2(damaged, {1 << 16});
      ASSERT_TRUE(!read || read->pixels.size() == static_cast<size_t>(read->width * read->height * read->channels));
    }
  }
}

TEST(Ktx2, KeepsToTheLimit) {
  for (const std::string name : {"etc1s_rgb", "uastc_rgb"}) {
    EXPECT_TRUE(read_ktx2(sample(name), {20 * 12}));
    const auto read = read_ktx2(sample(name), {20 * 12 - 1});
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().kind, ErrorKind::limit);
  }
  expect_refused(with_field(sample("etc1s_rgb"), width_at, 0), ErrorKind::bad_input, "an empty image");
  expect_refused(with_field(sample("uastc_rgb"), width_at, ~0u), ErrorKind::limit, "pixels");
}

// 8192 pixels a side would be a fifth of a gigabyte.
TEST(Ktx2, MemoryNeedsBytes) {
  for (const std::string name : names)
    expect_refused(with_field(with_field(sample(name), width_at, 8192), width_at + 4, 8192), ErrorKind::bad_input,
                   "claims more pixels");
}

TEST(Ktx2, RefusesOtherKinds) {
  constexpr uint32_t vk_format_r8g8b8a8 = 37, zlib = 3;
  constexpr uint8_t rrrg = 5, aaa = 15;
  const auto lz = sample("etc1s_rgb"), plain = sample("uastc_rgb"), two = sample("etc1s_rgba_mips");
  expect_refused(with_field(lz, format_at, vk_format_r8g8b8a8), ErrorKind::unsupported, "Basis Universal");
  expect_refused(with_field(lz, depth_at, 2), ErrorKind::unsupported, "2D");
  expect_refused(with_field(lz, layers_at, 2), ErrorKind::unsupported, "2D");
  expect_refused(with_field(lz, faces_at, 6), ErrorKind::unsupported, "2D");
  expect_refused(with_field(lz, supercompression_at, 0), ErrorKind::unsupported, "BasisLZ");
  expect_refused(with_field(plain, supercompression_at, zlib), ErrorKind::unsupported, "Zstandard");
  expect_refused(with_channel(plain, 0, rrrg), ErrorKind::unsupported, "channels");
  expect_refused(with_channel(two, 0, aaa), ErrorKind::unsupported, "channels");
  auto other_model = plain;
  other_model[field(plain, descriptor_at) + 12] = 162;  // ASTC
  expect_refused(other_model, ErrorKind::unsupported, "Basis Universal");
}

TEST(Ktx2, RefusesAnotherLevelThanItsSize) {
  const auto plain = sample("uastc_rgb"), packed = sample("uastc_rgba_mips_zstd");
  expect_refused(with_field(plain, width_at, 24), ErrorKind::bad_input, "as many");
  expect_refused(with_field(packed, width_at, 28), ErrorKind::bad_input, "as many");
  const uint32_t more_blocks = field(packed, uncompressed_at) / 6 * 7;  // a column of four blocks
  expect_refused(with_field(with_field(packed, width_at, 28), uncompressed_at, more_blocks), ErrorKind::bad_input,
                 "Zstandard");
  expect_refused(with_field(plain, levels_at, 33), ErrorKind::bad_input, "header");
  expect_refused(with_field(plain, level_at, ~0u), ErrorKind::bad_input, "ends too early");
}

TEST(Ktx2, RefusesBlocksThatNoEncoderMakes) {
  constexpr uint8_t reserved_code = 0x45, mode_2 = 0x1d, mode_3 = 0x03, mode_7 = 0x07;
  auto file = sample("uastc_rgb");
  uint8_t* block = &file[field(file, level_at)];
  block[0] = reserved_code;
  expect_refused(file, ErrorKind::bad_input, "UASTC block");
  for (const uint8_t mode : {mode_2, mode_3, mode_7}) {
    std::fill_n(block, 16, uint8_t(0xff));  // a pattern of ones behind hints of ones
    block[0] = static_cast<uint8_t>(0xe0 | mode);
    expect_refused(file, ErrorKind::bad_input, "UASTC block");
  }
}

}  // namespace
}  // namespace lightwell
