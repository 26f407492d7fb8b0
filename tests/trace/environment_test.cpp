// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/environment.h"

#include <gtest/gtest.h>

#include "lightwell/scene/sky_map.h"
#include "tests/trace/chi_square.h"

namespace lightwell {
namespace {

Environment environment_of(RadianceImage map) {
  Environment environment;
  environment.radiance = Vec3f::filled(1);
  environment.map = std::make_shared<const RadianceImage>(std::move(map));
  return environment;
}

/// The pixel of a latitude-longitude map towards a direction: its middle column is -z, its first row up
/// (docs/light.md).
size_t pixel_towards(const Vec3f& v, int width, int height) {
  const double u = 0.5 + std::atan2(static_cast<double>(v[0]), -static_cast<double>(v[2])) / (2 * std::numbers::pi);
  const double polar = std::acos(std::clamp(static_cast<double>(v[1]), -1.0, 1.0)) / std::numbers::pi;
  const int x = std::clamp(static_cast<int>(u * width), 0, width - 1);
  const int y = std::clamp(static_cast<int>(polar * height), 0, height - 1);
  return static_cast<size_t>(y * width + x);
}

TEST(EnvironmentLight, ConstantIsTheSameFromEverywhere) {
  Environment constant;
  constant.radiance = {{1, 2, 3}};
  const EnvironmentLight light(constant);
  EXPECT_EQ(light.mean(), constant.radiance);
  Random random(1, 0);
  Vec3d sum{};
  const int count = 100000;
  for (int i = 0; i < count; i++) {
    const EnvironmentLight::Sample sample = light.sample(random);
    ASSERT_EQ(sample.radiance, constant.radiance);
    ASSERT_FLOAT_EQ(sample.density * 4 * pi, 1);
    ASSERT_EQ(light.density(sample.direction), sample.density);
    sum += sample.direction.cast<double>() / static_cast<double>(count);
  }
  EXPECT_LT(length(sum), 0.01);  // 3 axes of standard error 1 / sqrt(3 * 100000) = 0.002
}

// Directions are chosen by the radiance of their pixel times its solid angle, and the density says so.
TEST(EnvironmentLight, SamplesAMapWithItsDensity) {
  const int width = 16, height = 8;
  Random random(2, 0);
  RadianceImage map{width, height, {}};
  std::vector<double> shares;
  double total = 0;
  for (int pixel = 0; pixel < width * height; pixel++) {
    // A third is black, as above a horizon of trees; the others range over four decades.
    const float grey = random.below(3) == 0 ? 0.0f : std::pow(10.0f, 4 * random.uniform() - 2);
    map.pixels.insert(map.pixels.end(), {grey, grey, grey});
    const int row = pixel / width;
    const double solid_angle =
        2 * std::numbers::pi / width *
        (std::cos(std::numbers::pi * row / height) - std::cos(std::numbers::pi * (row + 1) / height));
    shares.push_back(static_cast<double>(grey) * solid_angle);
    total += shares.back();
  }
  for (double& share : shares) share /= total;
  const Environment environment = environment_of(map);
  const EnvironmentLight light(environment);
  EXPECT_NEAR(static_cast<double>(light.mean()[0]), total / (4 * std::numbers::pi), 1e-5 * total);
  std::vector<int> counts(shares.size());
  int edges = 0;
  for (int i = 0; i < 200000; i++) {
    const EnvironmentLight::Sample sample = light.sample(random);
    ASSERT_GT(sample.radiance[0], 0);
    // Density is proportional to radiance, so that each sample is the whole integral.
    ASSERT_NEAR(static_cast<double>(sample.radiance[0] / sample.density), total, 1e-4 * total);
    const size_t pixel = pixel_towards(sample.direction, width, height);
    if (sample.radiance[0] != map.pixels[3 * pixel]) {
      edges++;
      continue;
    }
    counts[pixel]++;
    if (light.radiance(sample.direction) == sample.radiance) {
      ASSERT_FLOAT_EQ(light.density(sample.direction), sample.density);
    } else {
      edges++;
    }
  }
  // Rounding takes a direction for its neighbour's within some 1e-6 of a pixel's edge.
  EXPECT_LT(edges, 20);
  EXPECT_GT(chi_square(counts, shares), least_probability);
}

// Single bright pixels on black: near a pixel's edge rounding may take a direction for its black neighbour's, whose
// radiance over density is 0 / 0.
TEST(EnvironmentLight, OfBlackAndBrightPixelsIsFinite) {
  RadianceImage map{4096, 64, std::vector<float>(4096 * 64 * 3)};
  for (size_t pixel = 0; pixel < 4096 * 64; pixel += 2)
    for (size_t c = 0; c < 3; c++) map.pixels[3 * pixel + c] = 1;
  const Environment environment = environment_of(std::move(map));
  const EnvironmentLight light(environment);
  const LightRegion region({Vec3f::filled(-1), Vec3f::filled(1)}, true);
  for (uint64_t i = 0; i < 100000; i++) {
    Random random(5, i);
    const Arrival arrival = light.arrive(random);
    ASSERT_TRUE(is_finite(arrival.radiance)) << i;
    ASSERT_GT(arrival.radiance[0], 0) << i;
    ASSERT_GT(arrival.density, 0) << i;
    ASSERT_TRUE(is_finite(light.emit(region, random).flux)) << i;
  }
}

// A picture of it has no borders of pixels, and none where the map's left and right meet.
TEST(EnvironmentLight, IsSeenWithoutBorders) {
  RadianceImage map{8, 4, {}};
  Random random(5, 0);
  for (int i = 0; i < 8 * 4 * 3; i++) map.pixels.push_back(random.uniform());
  const Environment environment = environment_of(map);
  const EnvironmentLight light(environment);
  // From the angles' rounding, times the steepest change from pixel to pixel.
  constexpr float rounding = 1e-4f;
  for (size_t i = 0; i < 32; i++) {
    const Vec3f middle = pixel_direction(map, i);
    EXPECT_LT(
        max_component(max(light.seen(middle) - light.radiance(middle), light.radiance(middle) - light.seen(middle))),
        rounding);
  }
  for (int i = 0; i < 1000; i++) {
    const Vec3f direction = sample_sphere(random);
    const Vec3f near = normalized(direction + sample_sphere(random) * 1e-4f);
    const Vec3f step = light.seen(near) - light.seen(direction);
    // Pixels are 0.8 wide; within a tenth of the pole they are narrower.
    if (std::abs(direction[1]) >= 0.9f) continue;
    EXPECT_LT(max_component(max(step, -step)), 2e-3f);
  }
}

TEST(EnvironmentLight, IsBlackWithoutRadiance) {
  EXPECT_TRUE(EnvironmentLight().black());
  EXPECT_TRUE(EnvironmentLight(Environment{}).black());
  const Environment dark = environment_of({4, 2, std::vector<float>(24)});
  EXPECT_TRUE(EnvironmentLight(dark).black());
}

}  // namespace
}  // namespace lightwell
