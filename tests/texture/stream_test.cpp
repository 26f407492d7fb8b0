// SPDX-License-Identifier: Apache-2.0
#include "lightwell/texture/stream.h"

#include <gtest/gtest.h>

#include "lightwell/base/random.h"

namespace lightwell {
namespace {

std::vector<uint8_t> random_bytes(size_t count) {
  Random random(1, count);
  std::vector<uint8_t> bytes(count);
  for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(random.below(256));
  return bytes;
}

TEST(TextureStream, CarriesFilesOfEverySizeUnchanged) {
  for (const size_t size :
       {size_t(1), texture_block_bytes - 1, texture_block_bytes, texture_block_bytes + 1, size_t(100000)}) {
    const auto file = random_bytes(size);
    const TextureParameters sent{static_cast<uint32_t>(size), ImageFormat::webp, 640, 480};
    const auto parameters = decode_texture_parameters(encode_texture_parameters(sent));
    ASSERT_TRUE(parameters);
    EXPECT_EQ(*parameters, sent);
    TextureDecoder decoder(*parameters);
    for (const Bytes block : texture_blocks(file)) {
      EXPECT_FALSE(decoder.complete());
      ASSERT_TRUE(decoder.append(block));
    }
    EXPECT_TRUE(decoder.complete());
    EXPECT_EQ(decoder.file(), file);
  }
}

TEST(TextureStream, RefusesBlocksThatDoNotFit) {
  const auto file = random_bytes(texture_block_bytes + 10);
  const Bytes bytes(file);
  TextureDecoder decoder({static_cast<uint32_t>(file.size()), ImageFormat::png, 1, 1});
  EXPECT_FALSE(decoder.append({}));
  EXPECT_FALSE(decoder.append(bytes));
  EXPECT_FALSE(decoder.append(bytes.first(texture_block_bytes - 1)));
  ASSERT_TRUE(decoder.append(bytes.first(texture_block_bytes)));
  EXPECT_FALSE(decoder.append(bytes.first(texture_block_bytes)));
  ASSERT_TRUE(decoder.append(bytes.subspan(texture_block_bytes)));
  EXPECT_FALSE(decoder.append(bytes.first(1)));
  EXPECT_EQ(decoder.file(), file);
}

TEST(TextureStream, RefusesParametersThatMakeNoSense) {
  const auto good = encode_texture_parameters({5, ImageFormat::jpeg, 4, 3});
  for (size_t size = 0; size < good.size(); size++) EXPECT_FALSE(decode_texture_parameters(Bytes(good).first(size)));
  EXPECT_FALSE(decode_texture_parameters(encode_texture_parameters({0, ImageFormat::jpeg, 4, 3})));
  EXPECT_FALSE(decode_texture_parameters(encode_texture_parameters({5, ImageFormat::jpeg, 0, 3})));
  EXPECT_FALSE(decode_texture_parameters(encode_texture_parameters({5, static_cast<ImageFormat>(3), 4, 3})));
  auto longer = good;
  longer.push_back(0);
  EXPECT_FALSE(decode_texture_parameters(longer));
}

TEST(ImageFormat, IsToldByTheFirstBytes) {
  EXPECT_EQ(image_format(as_bytes("\xff\xd8\xff\xe0")), ImageFormat::jpeg);
  EXPECT_EQ(image_format(as_bytes("RIFF____WEBP")), ImageFormat::webp);
  EXPECT_EQ(image_format(as_bytes("RIFF____WAVE")), std::nullopt);
  EXPECT_EQ(image_format({}), std::nullopt);
  EXPECT_EQ(mime_type(ImageFormat::png), "image/png");
}

}  // namespace
}  // namespace lightwell
