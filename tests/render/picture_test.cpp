// SPDX-License-Identifier: Apache-2.0
#include "lightwell/render/picture.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lightwell/base/random.h"
#include "lightwell/render/float_picture.h"
#include "lightwell/texture/image_file.h"
#include "tests/temporary_folder.h"

namespace lightwell {
namespace {

Picture random_picture(int width, int height, uint64_t seed) {
  Picture picture{width, height, {}};
  Random random(seed, 0);
  for (int i = 0; i < width * height * 3; i++) picture.pixels.push_back(std::exp2(12 * random.uniform() - 8));
  return picture;
}

class PictureFiles : public testing::Test {
 protected:
  const TemporaryFolder temporary_;
  const std::filesystem::path folder_ = temporary_.path();
};

TEST_F(PictureFiles, FloatsComeBackAsTheyWere) {
  for (const char* name : {"a.exr", "a.pfm"}) {
    for (const auto& [width, height] : {std::pair{1, 1}, {17, 5}, {3, 40}}) {
      const Picture picture = random_picture(width, height, 1);
      ASSERT_TRUE(write_picture(folder_ / name, picture)) << name;
      const Result<Picture> back = read_picture(folder_ / name);
      ASSERT_TRUE(back) << name << " " << back.error().message();
      EXPECT_EQ(back->width, width);
      EXPECT_EQ(back->height, height);
      EXPECT_EQ(back->pixels, picture.pixels) << name;
    }
  }
}

// Half a step of 8-bit sRGB; its slope is at most 1/12.92 a step in the dark and 2.3 in the light.
TEST_F(PictureFiles, PngComesBackWithinAStepOfEightBits) {
  Picture picture{64, 1, {}};
  for (int i = 0; i < 64 * 3; i++) picture.pixels.push_back(static_cast<float>(i) / 191);
  ASSERT_TRUE(write_picture(folder_ / "a.png", picture, {0, ToneCurve::none}));
  const Picture back = read_picture(folder_ / "a.png").value();
  for (size_t i = 0; i < picture.pixels.size(); i++) EXPECT_NEAR(back.pixels[i], picture.pixels[i], 0.5f / 255 * 2.3f);
}

TEST_F(PictureFiles, ErrorsNameTheFile) {
  EXPECT_EQ(write_picture(folder_ / "a.bmp", random_picture(1, 1, 1)).error().file, (folder_ / "a.bmp").string());
  EXPECT_EQ(read_picture(folder_ / "none.exr").error().file, (folder_ / "none.exr").string());
}

// PFM's first row is the picture's last.
TEST(Pfm, HasItsFirstRowAtTheBottom) {
  const std::vector<uint8_t> file = write_pfm({1, 2, {1, 2, 3, 4, 5, 6}});
  ByteReader reader(file);
  reader.take(std::string("PF\n1 2\n-1.0\n").size());
  EXPECT_EQ(reader.f32(), 4);
  reader.take(8);
  EXPECT_EQ(reader.f32(), 1);
}

TEST(Pfm, ReadsGreyAndBigEndian) {
  ByteWriter writer;
  writer.append(as_bytes("Pf\n1 1\n1.0\n"));
  writer.u32(__builtin_bswap32(std::bit_cast<uint32_t>(0.75f)));
  const Picture picture = read_picture(writer.bytes()).value();
  EXPECT_EQ(picture.pixels, (std::vector<float>{0.75f, 0.75f, 0.75f}));
}

TEST(ReadPicture, RefusesEveryPrefix) {
  const Picture picture = random_picture(9, 7, 2);
  const std::vector<std::vector<uint8_t>> files{write_pfm(picture), write_exr(picture).value(),
                                                write_png(displayed(picture, {}))};
  for (size_t kind = 0; kind < files.size(); kind++) {
    const Bytes file = files[kind];
    for (size_t length = 0; length < file.size(); length++) {
      const std::vector<uint8_t> prefix(file.begin(), file.begin() + static_cast<ptrdiff_t>(length));
      const auto read = read_picture(prefix);
      // A PNG is whole before its last chunk; the others end with their pixels.
      if (kind < 2) {
        EXPECT_FALSE(read) << "kind " << kind << ", length " << length << " of " << file.size();
      }
    }
  }
}

TEST(ReadPicture, RefusesHugeSizes) {
  EXPECT_FALSE(read_picture(as_bytes("PF\n2000000000 2000000000\n-1.0\n")));
  EXPECT_FALSE(read_picture(as_bytes("PF\n-1 5\n-1.0\n")));
}

// The values of the curve's own description: 4 % of reflection is taken away, then nothing changes up to 0.76; it never
// reaches 1 and never falls.
TEST(NeutralTone, KeepsColoursAndCompressesLights) {
  EXPECT_NEAR(neutral_tone({{0.5f, 0.4f, 0.3f}})[0], 0.46f, 1e-6f);
  EXPECT_NEAR(neutral_tone({{0.5f, 0.4f, 0.3f}})[2], 0.26f, 1e-6f);
  EXPECT_EQ(neutral_tone({})[0], 0);
  float before = 0;
  for (float x = 0; x < 100; x = x * 1.1f + 0.01f) {
    const float y = neutral_tone(Vec3f::filled(x))[0];
    EXPECT_GE(y, before);
    EXPECT_LT(y, 1);
    before = y;
  }
  // Very bright colours turn white.
  const Vec3f bright = neutral_tone({{1000, 100, 100}});
  EXPECT_GT(bright[1], 0.9f);
}

TEST(Display, ExposesAndCuts) {
  const Display display{1, ToneCurve::none};
  EXPECT_EQ(display({{0.25f, 0.75f, -1}}), (Vec3f{{0.5f, 1, 0}}));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(display({{nan, nan, nan}}), Vec3f{});
}

}  // namespace
}  // namespace lightwell
