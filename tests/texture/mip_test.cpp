// SPDX-License-Identifier: Apache-2.0
#include "lightwell/texture/mip.h"

#include <gtest/gtest.h>

#include "lightwell/texture/transfer.h"

namespace lightwell {
namespace {

TEST(Transfer, RoundTripsEveryByte) {
  for (int byte = 0; byte < 256; byte++)
    EXPECT_EQ(to_byte(linear_to_srgb(srgb_to_linear(static_cast<uint8_t>(byte)))), byte);
  EXPECT_NEAR(srgb_to_linear(0.5f), 0.2140411f, 1e-6);  // IEC 61966-2-1
}

TEST(SmallestMip, AveragesColourAsLight) {
  const Image checker{2, 2, 1, {0, 255, 255, 0}};
  EXPECT_EQ(smallest_mip(checker, 1, true).pixels[0], 188);  // linear 0.5
  EXPECT_EQ(smallest_mip(checker, 1, false).pixels[0], 128);
}

TEST(SmallestMip, IgnoresTheColourOfTransparentPixels) {
  const Image edge{2, 1, 4, {0, 200, 0, 255, 255, 0, 255, 0}};
  const Image mip = smallest_mip(edge, 1, true);
  EXPECT_EQ(mip.pixels, (std::vector<uint8_t>{0, 200, 0, 128}));
  const Image hidden{2, 1, 2, {90, 0, 90, 0}};
  EXPECT_EQ(smallest_mip(hidden, 1, true).pixels, (std::vector<uint8_t>{90, 0}));
}

TEST(SmallestMip, KeepsShapeAndSmallImages) {
  const Image wide{100, 10, 1, std::vector<uint8_t>(1000, 7)};
  const Image mip = smallest_mip(wide, 16, false);
  EXPECT_EQ(mip.width, 16);
  EXPECT_EQ(mip.height, 2);
  EXPECT_EQ(mip.pixels, std::vector<uint8_t>(32, 7));
  EXPECT_EQ(smallest_mip(wide, 100, false).width, 100);
  const Image thin{1000, 1, 1, std::vector<uint8_t>(1000, 7)};
  EXPECT_EQ(smallest_mip(thin, 16, false).height, 1);
}

}  // namespace
}  // namespace lightwell
