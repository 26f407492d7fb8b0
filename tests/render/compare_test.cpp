// SPDX-License-Identifier: Apache-2.0
#include "lightwell/render/compare.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lightwell/base/random.h"
#include "lightwell/render/colour.h"
#include "lightwell/render/flip.h"

namespace lightwell {
namespace {

constexpr std::array metrics{Metric::rmse, Metric::relmse, Metric::deltae, Metric::lab, Metric::flip};

Picture flat(int width, int height, const Vec3f& colour) {
  Picture picture{width, height, {}};
  for (int i = 0; i < width * height; i++)
    picture.pixels.insert(picture.pixels.end(), colour.e.begin(), colour.e.end());
  return picture;
}

Picture noise(int width, int height, uint64_t seed) {
  Picture picture = flat(width, height, {});
  Random random(seed, 0);
  for (float& v : picture.pixels) v = random.uniform();
  return picture;
}

TEST(Compare, EqualPicturesDoNotDiffer) {
  const Picture picture = noise(20, 12, 1);
  for (const Metric metric : metrics) {
    const Comparison c = compare(picture, picture, metric).value();
    EXPECT_EQ(c.errors.size(), 240u);
    EXPECT_EQ(c.mean, 0);
    EXPECT_EQ(c.max, 0);
  }
}

TEST(Compare, ClosedForms) {
  const Picture a = flat(4, 4, {{0.5f, 0.5f, 0.5f}}), b = flat(4, 4, {{0.25f, 0.5f, 0.5f}});
  EXPECT_NEAR(compare(a, b, Metric::rmse)->mean, 0.25 / std::sqrt(3), 1e-6);
  EXPECT_NEAR(compare(a, b, Metric::relmse)->mean, 0.0625 / (0.0625 + 0.01) / 3, 1e-6);
  // Grey Y = 0.5 has L = 116 cbrt(0.5) - 16 = 76.069; white 100.
  EXPECT_NEAR(compare(a, flat(4, 4, {{1, 1, 1}}), Metric::lab)->mean, 100 - 76.069, 1e-2);
}

TEST(Compare, MeanPercentileAndMaximum) {
  Picture a = flat(100, 1, {}), b = a;
  for (size_t i = 0; i < 100; i++) {
    for (size_t c = 0; c < 3; c++) a.pixels[3 * i + c] = static_cast<float>(i + 1);
  }
  const Comparison c = compare(a, b, Metric::rmse).value();
  EXPECT_FLOAT_EQ(static_cast<float>(c.p95), 95);
  EXPECT_FLOAT_EQ(static_cast<float>(c.max), 100);
  EXPECT_NEAR(c.mean, std::sqrt(101.0 * 201 / 6), 1e-3);
}

TEST(Compare, RefusesOtherSizes) {
  EXPECT_FALSE(compare(flat(2, 2, {}), flat(2, 3, {}), Metric::rmse));
  EXPECT_FALSE(compare(flat(0, 0, {}), flat(0, 0, {}), Metric::rmse));
}

TEST(Compare, RefusesPixelsThatAreNoNumbers) {
  Picture picture = noise(4, 3, 1);
  picture.pixels[7] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(compare(picture, noise(4, 3, 1), Metric::rmse));
  EXPECT_FALSE(compare(noise(4, 3, 1), picture, Metric::flip));
}

TEST(Compare, KnowsItsMetricsByName) {
  EXPECT_EQ(metric_of("flip"), Metric::flip);
  EXPECT_EQ(metric_of("deltae"), Metric::deltae);
  EXPECT_EQ(metric_of("ssim"), std::nullopt);
}

// From the test data of Sharma, Wu and Dalal (2005), to its four digits.
TEST(Ciede2000, GivesThePublishedValues) {
  const auto near = [](const Vec3f& a, const Vec3f& b, float expected) {
    EXPECT_NEAR(ciede2000(a, b), expected, 1e-4f);
    EXPECT_NEAR(ciede2000(b, a), expected, 1e-4f);
  };
  near({{50, 2.6772f, -79.7751f}}, {{50, 0, -82.7485f}}, 2.0425f);
  near({{50, 3.1571f, -77.2803f}}, {{50, 0, -82.7485f}}, 2.8615f);
  near({{50, 0, 0}}, {{50, -1, 2}}, 2.3669f);
  near({{50, 2.5f, 0}}, {{50, 0, -2.5f}}, 4.3065f);
  near({{50, 2.5f, 0}}, {{73, 25, -18}}, 27.1492f);
  near({{50, 2.5f, 0}}, {{50, 3.2592f, 0.335f}}, 1.0f);
}

TEST(Colour, WhiteAndPrimaries) {
  const Vec3f white = lab_of(relative_xyz({{1, 1, 1}}));
  EXPECT_NEAR(white[0], 100, 1e-4f);
  EXPECT_NEAR(white[1], 0, 1e-4f);
  EXPECT_NEAR(white[2], 0, 1e-4f);
  const Vec3f red = lab_of(relative_xyz({{1, 0, 0}}));  // 53.24, 80.09, 67.20
  EXPECT_NEAR(red[0], 53.24f, 0.01f);
  EXPECT_NEAR(red[1], 80.09f, 0.01f);
  EXPECT_NEAR(red[2], 67.20f, 0.01f);
  const Vec3f back = linear_srgb(relative_xyz({{0.1f, 0.7f, 0.4f}}));
  EXPECT_NEAR(back[0], 0.1f, 1e-6f);
  EXPECT_NEAR(back[1], 0.7f, 1e-6f);
  EXPECT_NEAR(back[2], 0.4f, 1e-6f);
}

std::vector<Vec3f> filled(int count, const Vec3f& colour) {
  return std::vector<Vec3f>(static_cast<size_t>(count), colour);
}

// Green against blue is the largest colour difference, by definition 1; flat pictures have no features.
TEST(Flip, IsOneForGreenAgainstBlue) {
  for (const float error : flip(filled(60, {{0, 1, 0}}), filled(60, {{0, 0, 1}}), 10, 6)) EXPECT_NEAR(error, 1, 1e-4f);
}

// Black against white: HyAB 100, to the power 0.7 25.119; green against blue has HyAB 308.2 and 41.48 or so: with the
// knee at 0.4 of that, 0.95 + (25.119 - 0.4 c) / (0.6 c) * 0.05.
TEST(Flip, IsTheClosedFormForBlackAgainstWhite) {
  const auto hunt = [](const Vec3f& rgb) {
    const Vec3f lab = lab_of(relative_xyz(rgb));
    return Vec3f{{lab[0], 0.01f * lab[0] * lab[1], 0.01f * lab[0] * lab[2]}};
  };
  const Vec3f green = hunt({{0, 1, 0}}), blue = hunt({{0, 0, 1}});
  const float c = std::pow(std::abs(green[0] - blue[0]) + std::hypot(green[1] - blue[1], green[2] - blue[2]), 0.7f);
  const float expected = 0.95f + (std::pow(100.0f, 0.7f) - 0.4f * c) / (0.6f * c) * 0.05f;
  for (const float error : flip(filled(60, {{0, 0, 0}}), filled(60, {{1, 1, 1}}), 10, 6))
    EXPECT_NEAR(error, expected, 1e-3f);
}

TEST(Flip, IsSymmetricAndBounded) {
  const Picture a = noise(24, 16, 1), b = noise(24, 16, 2);
  const Comparison ab = compare(a, b, Metric::flip).value(), ba = compare(b, a, Metric::flip).value();
  for (size_t i = 0; i < ab.errors.size(); i++) {
    EXPECT_NEAR(ab.errors[i], ba.errors[i], 1e-4f);
    EXPECT_GE(ab.errors[i], 0);
    EXPECT_LE(ab.errors[i], 1);
  }
  EXPECT_GT(ab.mean, 0.05);
}

// A line that appears is seen where it is, and not far away.
TEST(Flip, SeesFeaturesWhereTheyAre) {
  Picture plain = flat(64, 32, {{0.2f, 0.2f, 0.2f}}), line = plain;
  for (size_t y = 0; y < 32; y++) {
    for (size_t c = 0; c < 3; c++) line.pixels[(y * 64 + 20) * 3 + c] = 0.8f;
  }
  const Comparison seen = compare(line, plain, Metric::flip).value();
  EXPECT_GT(seen.errors[16 * 64 + 20], 0.5f);
  EXPECT_LT(seen.errors[16 * 64 + 60], 1e-3f);
}

TEST(HeatMap, GoesFromBlackToWhite) {
  Comparison c;
  c.errors = {0, 1, 2, 3};
  c.max = 3;
  const Image image = heat_map(c, 4, 1);
  EXPECT_EQ(image.pixels, (std::vector<uint8_t>{0, 0, 0, 255, 0, 0, 255, 255, 0, 255, 255, 255}));
}

}  // namespace
}  // namespace lightwell
