// SPDX-License-Identifier: Apache-2.0
#include "lightwell/texture/image_size.h"

#include <gtest/gtest.h>

#include "lightwell/base/random.h"
#include "lightwell/texture/image_file.h"
#include "tests/texture/webp_files.h"

namespace lightwell {
namespace {

/// Lossy; with four channels its alpha stands apart, in a file of several chunks.
std::vector<uint8_t> lossy_webp(const Image& image) {
  uint8_t* bytes = nullptr;
  const auto encode = image.channels == 4 ? WebPEncodeRGBA : WebPEncodeRGB;
  const size_t size = encode(image.pixels.data(), image.width, image.height, image.width * image.channels, 50, &bytes);
  std::vector<uint8_t> file(bytes, bytes + size);
  WebPFree(bytes);
  return file;
}

std::vector<std::vector<uint8_t>> files_of(const Image& image) {
  std::vector<std::vector<uint8_t>> files = {write_png(image), lossless_webp(image), lossy_webp(image)};
  if (image.channels == 3) files.push_back(write_jpeg(image, 50));
  return files;
}

Image some_image(Random& random, int channels) {
  Image image{static_cast<int>(1 + random.below(700)), static_cast<int>(1 + random.below(700)), channels, {}};
  for (int i = 0; i < image.width * image.height * channels; i++)
    image.pixels.push_back(static_cast<uint8_t>(random.below(256)));
  return image;
}

TEST(ImageSize, IsThatOfTheImage) {
  for (uint64_t i = 0; i < 10; i++) {
    Random random(17, i);
    const Image image = some_image(random, i % 2 == 0 ? 3 : 4);
    const ImageSize size{static_cast<uint32_t>(image.width), static_cast<uint32_t>(image.height)};
    for (const std::vector<uint8_t>& file : files_of(image)) EXPECT_EQ(image_size(file), size);
  }
}

TEST(ImageSize, OfABeginningIsTheSameOrUnknown) {
  Random random(18, 0);
  const Image image = some_image(random, 3);
  for (const std::vector<uint8_t>& file : files_of(image)) {
    const auto size = image_size(file);
    for (size_t length = 0; length < std::min<size_t>(file.size(), 1000); length++) {
      const auto of_beginning = image_size(Bytes(file).first(length));
      EXPECT_TRUE(!of_beginning || of_beginning == size) << length;
    }
    EXPECT_FALSE(image_size(Bytes(file).first(20)));
  }
}

// Where a decoder reads a damaged file at all, it finds the size that the header says.
TEST(ImageSize, AgreesWithTheDecoders) {
  Random random(19, 0);
  Image image = some_image(random, 3);
  image.height = 20;
  image.pixels.resize(static_cast<size_t>(image.width) * 60);
  for (const std::vector<uint8_t>& file : files_of(image))
    for (int i = 0; i < 300; i++) {
      std::vector<uint8_t> damaged = file;
      damaged[random.below(std::min<uint32_t>(static_cast<uint32_t>(file.size()), 700))] ^=
          static_cast<uint8_t>(1u << random.below(8));
      const auto decoded = read_image_file(damaged);
      if (!decoded || !image_format(damaged)) continue;
      EXPECT_EQ(image_size(damaged),
                (ImageSize{static_cast<uint32_t>(decoded->width), static_cast<uint32_t>(decoded->height)}));
    }
}

}  // namespace
}  // namespace lightwell
