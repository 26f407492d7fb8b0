// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/images_from_afar.h"

#include <gtest/gtest.h>

#include "lightwell/base/random.h"
#include "lightwell/texture/transfer.h"
#include "lightwell/trace/texture_lookup.h"

namespace lightwell {
namespace {

/// A scene with one image of noise, read by one material.
Scene scene_with(int width, int height, int channels, TextureLookup Material::*use) {
  Scene scene;
  Image image{.width = width, .height = height, .channels = channels, .pixels = {}};
  Random random(4, 0);
  image.pixels.resize(static_cast<size_t>(width * height * channels));
  for (uint8_t& code : image.pixels) code = static_cast<uint8_t>(random.below(256));
  scene.images.push_back(std::move(image));
  Material material;
  (material.*use).image = 0;
  scene.materials.push_back(material);
  return scene;
}

/// The mean over an image of a channel by the alpha of its texels, the last channel.
double mean_colour(const Image& image, int channel, bool srgb) {
  const bool alpha = image.channels % 2 == 0;
  double sum = 0, weights = 0;
  for (size_t i = 0; i < image.pixels.size(); i += static_cast<size_t>(image.channels)) {
    const uint8_t code = image.pixels[i + static_cast<size_t>(channel)];
    const double weight = alpha ? image.pixels[i + static_cast<size_t>(image.channels) - 1] / 255.0 : 1.0;
    sum += weight * static_cast<double>(srgb ? srgb_to_linear(code) : static_cast<float>(code) / 255);
    weights += weight;
  }
  return sum / weights;
}

// No light is lost: half a code of rounding, of sRGB's in light, is at most 0.4 %.
TEST(ImagesFromAfar, KeepTheMeanOfColoursInLight) {
  for (const int channels : {1, 3, 4}) {
    const Scene scene = scene_with(128, 256, channels, &Material::base_color_texture);
    const Image image = images_from_afar(scene).front();
    EXPECT_EQ(image.width, 32);
    EXPECT_EQ(image.height, 64);
    const double mean = mean_colour(scene.images.front(), 0, true);
    EXPECT_NEAR(mean_colour(image, 0, true), mean, 0.004 * mean);
  }
}

TEST(ImagesFromAfar, KeepTheMeanOfNumbers) {
  const Scene scene = scene_with(128, 128, 3, &Material::metallic_roughness_texture);
  const double mean = mean_colour(scene.images.front(), 1, false);
  EXPECT_NEAR(mean_colour(images_from_afar(scene).front(), 1, false), mean, 0.002);
}

// Below a leaf's transparent texels lies any colour: it must not bleed into the leaf.
TEST(ImagesFromAfar, DoNotSeeTransparentTexels) {
  Scene scene = scene_with(64, 64, 4, &Material::base_color_texture);
  std::vector<uint8_t>& pixels = scene.images.front().pixels;
  for (size_t i = 0; i < pixels.size(); i += 4) {
    const bool leaf = i / 4 % 3 == 0;
    pixels[i] = leaf ? 200 : 0;
    pixels[i + 3] = leaf ? 255 : 0;
  }
  const Image image = images_from_afar(scene).front();
  for (size_t i = 0; i < image.pixels.size(); i += 4) EXPECT_EQ(image.pixels[i], 200);
}

TEST(ImagesFromAfar, LeaveWhatIsSmallOrReadInTwoWays) {
  const Scene small = scene_with(63, 500, 3, &Material::base_color_texture);
  EXPECT_EQ(images_from_afar(small).front().pixels, small.images.front().pixels);
  Scene both = scene_with(128, 128, 3, &Material::base_color_texture);
  both.materials.front().metallic_roughness_texture.image = 0;
  EXPECT_EQ(images_from_afar(both).front().pixels, both.images.front().pixels);
}

// An image whose sides four does not divide: its last texels are means of fewer.
TEST(ImagesFromAfar, CoverTheWholeImage) {
  const Scene scene = scene_with(130, 67, 3, &Material::base_color_texture);
  const Image image = images_from_afar(scene).front();
  EXPECT_EQ(image.width, 33);
  EXPECT_EQ(image.height, 17);
  EXPECT_EQ(image.pixels.size(), size_t(33 * 17 * 3));
}

}  // namespace
}  // namespace lightwell
