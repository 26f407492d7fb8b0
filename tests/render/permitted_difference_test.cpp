// SPDX-License-Identifier: Apache-2.0
#include "lightwell/render/permitted_difference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lightwell/texture/transfer.h"

namespace lightwell {
namespace {

double polynomial(std::initializer_list<double> coefficients, double x) {
  double sum = 0, power = 1;
  for (const double coefficient : coefficients) {
    sum += coefficient * power;
    power *= x;
  }
  return sum;
}

/// The luminance of an index of just noticeable differences, cd/m2 (DICOM PS3.14, section 7.1).
double luminance_of_index(double index) {
  const double x = std::log(index);
  return std::pow(10, polynomial({-1.3011877, 8.0242636e-2, 1.3646699e-1, -2.5468404e-2, 1.3635334e-3}, x) /
                          polynomial({1, -2.5840191e-2, -1.0320229e-1, 2.8745620e-2, -3.1978977e-3, 1.2992634e-4}, x));
}

/// The inverse, by bisection.
double index_of_luminance(double luminance) {
  double low = 1, high = 1023;
  while (high - low > 1e-6) {
    const double middle = (low + high) / 2;
    (luminance_of_index(middle) < luminance ? low : high) = middle;
  }
  return low;
}

// The ends that the standard gives: 0.05 and 3993 cd/m2, in as many digits.
TEST(PermittedDifference, StandardDisplayFunctionHasItsEnds) {
  EXPECT_NEAR(luminance_of_index(1), 0.05, 0.0005);
  EXPECT_NEAR(luminance_of_index(1023), 3993, 0.5);
}

// A step of a screen is seen everywhere, and nowhere is much more than that, so that one number serves for all values.
TEST(PermittedDifference, IsOneStepOfTheScreenWhereItIsSmooth) {
  constexpr double white = 200, reflected = 1;  // cd/m2
  const auto index = [&](int value) {
    return index_of_luminance(reflected + white * static_cast<double>(srgb_to_linear(static_cast<uint8_t>(value))));
  };
  for (int value = 0; value < 255; value++) {
    const double step = index(value + 1) - index(value);
    EXPECT_GT(step, 1.2) << value;
    EXPECT_LT(step, 2.7) << value;
  }
  EXPECT_FLOAT_EQ(permitted_difference(0), 1.0f / 255);
}

TEST(PermittedDifference, GrowsWithContrastAsMaskingDoes) {
  for (const float contrast : {0.0f, 2.0f, 4.0f, 8.0f, 16.0f, 32.0f, 36.0f}) {
    const double masked = std::clamp(std::pow(static_cast<double>(contrast) / 2, 0.62), 1.0, 6.0);
    // The table has three decimals.
    EXPECT_NEAR(255 * static_cast<double>(permitted_difference(contrast / 255)), masked, 0.001) << contrast;
  }
  // Between the rows a line is below the formula, within an octave by up to 1.5 %.
  for (float contrast = 2; contrast < 36; contrast += 0.1f) {
    const double masked = std::pow(static_cast<double>(contrast) / 2, 0.62);
    const double found = 255 * static_cast<double>(permitted_difference(contrast / 255));
    EXPECT_LT(found, masked + 0.001) << contrast;
    EXPECT_GT(found, 0.98 * masked) << contrast;
  }
  EXPECT_FLOAT_EQ(permitted_difference(1), 6.0f / 255);
}

}  // namespace
}  // namespace lightwell
