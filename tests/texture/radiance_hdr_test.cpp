// SPDX-License-Identifier: Apache-2.0
#include "lightwell/texture/radiance_hdr.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "lightwell/base/file.h"
#include "lightwell/base/random.h"

namespace lightwell {
namespace {

std::vector<uint8_t> picture(const std::string& header, const std::vector<uint8_t>& data) {
  std::vector<uint8_t> file(header.begin(), header.end());
  file.insert(file.end(), data.begin(), data.end());
  return file;
}

std::vector<uint8_t> picture_of(const std::string& resolution, const std::vector<uint8_t>& data) {
  return picture("#?RADIANCE\n# made\nFORMAT=32-bit_rle_rgbe\n\n" + resolution + "\n", data);
}

std::vector<float> pixels_of(const std::vector<uint8_t>& file) {
  const auto image = read_radiance_hdr(file);
  EXPECT_TRUE(image) << (image ? "" : image.error().message());
  return image ? image->pixels : std::vector<float>{};
}

TEST(RadianceHdr, ReadsFlatPixels) {
  // m 2^(e - 136): 128 with exponent 129 is one.
  const auto pixels = pixels_of(picture_of("-Y 1 +X 2", {128, 64, 0, 129, 255, 255, 255, 0}));
  EXPECT_EQ(pixels, (std::vector<float>{1, 0.5f, 0, 0, 0, 0}));
}

TEST(RadianceHdr, ReadsTheOldCoding) {
  // One pixel, a repetition of 3, then of 1 << 8 after another repetition: 1 + 3 + 0x104.
  const auto pixels =
      pixels_of(picture_of("-Y 1 +X 263", {128, 0, 0, 129, 1, 1, 1, 3, 0, 128, 0, 129, 1, 1, 1, 2, 1, 1, 1, 1}));
  ASSERT_EQ(pixels.size(), 263u * 3);
  for (size_t x = 0; x < 263; x++) ASSERT_EQ(pixels[3 * x], x < 4 ? 1 : 0) << x;
  for (size_t x = 0; x < 263; x++) ASSERT_EQ(pixels[3 * x + 1], x < 4 ? 0 : 1) << x;
}

TEST(RadianceHdr, ReadsTheNewCoding) {
  // Eight pixels: red a run, green literal, blue two runs, exponent a run.
  const std::vector<uint8_t> row = {2, 2, 0, 8, 136, 128, 8, 1, 2, 3, 4, 5, 6, 7, 8, 132, 0, 132, 64, 136, 129};
  const auto pixels = pixels_of(picture_of("-Y 1 +X 8", row));
  ASSERT_EQ(pixels.size(), 24u);
  for (size_t x = 0; x < 8; x++) {
    EXPECT_EQ(pixels[3 * x], 1);
    EXPECT_EQ(pixels[3 * x + 1], static_cast<float>(x + 1) / 128);
    EXPECT_EQ(pixels[3 * x + 2], x < 4 ? 0 : 0.5f);
  }
}

TEST(RadianceHdr, DividesByTheExposuresAndTurnsTheImage) {
  const auto file = picture("#?RGBE\nEXPOSURE= 2\nEXPOSURE=4\n\n+Y 2 -X 2\n",
                            {128, 0, 0, 132, 0, 128, 0, 132, 0, 0, 128, 132, 0, 0, 0, 0});
  EXPECT_EQ(pixels_of(file), (std::vector<float>{0, 0, 0, 0, 0, 1, 0, 1, 0, 1, 0, 0}));
}

TEST(RadianceHdr, RefusesFaults) {
  const std::vector<uint8_t> pixel = {128, 128, 128, 129};
  EXPECT_TRUE(read_radiance_hdr(picture_of("-Y 1 +X 1", pixel)));
  for (const std::string resolution :
       {"-Y 1", "+X 1 -Y 1", "-Y 0 +X 1", "-Y 1 +X -1", "-Y 40000 +X 1", "-Y 32000 +X 32000", "-Y 1 +X 1x", ""})
    EXPECT_FALSE(read_radiance_hdr(picture_of(resolution, pixel))) << resolution;
  EXPECT_FALSE(read_radiance_hdr(picture("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n", pixel)));
  EXPECT_FALSE(read_radiance_hdr(picture("#?RADIANCE\nEXPOSURE=0\n\n-Y 1 +X 1\n", pixel)));
  EXPECT_FALSE(read_radiance_hdr(picture("#?RADIANCE\nEXPOSURE=1e-300\n\n-Y 1 +X 1\n", pixel)));
  EXPECT_FALSE(read_radiance_hdr(picture("P6\n\n-Y 1 +X 1\n", pixel)));
  EXPECT_FALSE(read_radiance_hdr(picture_of("-Y 1 +X 2", {1, 1, 1, 1, 1, 1, 1, 1})));          // repeats nothing
  EXPECT_FALSE(read_radiance_hdr(picture_of("-Y 1 +X 8", {2, 2, 0, 8, 137, 1, 1, 1, 1, 1})));  // a run beyond the row
  EXPECT_FALSE(read_radiance_hdr(picture_of("-Y 1 +X 8", {2, 2, 0, 9, 136, 1, 136, 1, 136, 1, 136, 1})));
}

TEST(RadianceHdr, IsTotalOnPrefixesAndDamage) {
  const auto file =
      picture_of("-Y 1 +X 8", {2, 2, 0, 8, 136, 128, 8, 1, 2, 3, 4, 5, 6, 7, 8, 132, 0, 132, 64, 136, 129});
  for (size_t size = 0; size < file.size(); size++) EXPECT_FALSE(read_radiance_hdr(Bytes(file).first(size)));
  Random random(9, 0);
  for (int i = 0; i < 2000; i++) {
    auto damaged = file;
    damaged[random.below(static_cast<uint32_t>(file.size()))] = static_cast<uint8_t>(random.below(256));
    (void)read_radiance_hdr(damaged);
  }
}

TEST(RadianceHdr, ReadsASkyOfOthers) {
  const std::filesystem::path path = LIGHTWELL_SHARED "/data/hdr/qwantani_afternoon_puresky_1k.hdr";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  const auto file = read_file(path);
  ASSERT_TRUE(file);
  const auto image = read_radiance_hdr(*file);
  ASSERT_TRUE(image) << image.error().message();
  EXPECT_EQ(image->width, 1024);
  EXPECT_EQ(image->height, 512);
}

}  // namespace
}  // namespace lightwell
