// SPDX-License-Identifier: Apache-2.0
#include "lightwell/texture/stream.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

TEST(TextureStream, ParametersSurvive) {
  const TextureParameters sent{99, ImageFormat::webp, 640, 480};
  const auto parameters = decode_texture_parameters(encode_texture_parameters(sent));
  ASSERT_TRUE(parameters);
  EXPECT_EQ(*parameters, sent);
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
