// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/texture_extension.h"

#include <gtest/gtest.h>

#include "tests/packing/nasty_json.h"

namespace lightwell {
namespace {

// A document in which these textures are refined, and others are not.
Json pack_of(const std::vector<RefinedTexture>& list) {
  Json json = {{"textures", Json::array({{{"source", 0}}, {{"source", 0}}, {{"source", 0}}})}};
  for (const RefinedTexture& refined : list)
    json["textures"][refined.texture] = {{"source", refined.source},
                                         {"extensions", {{texture_extension, to_json(refined)}}}};
  return json;
}

RefinedTexture any_refined(Random& random, size_t texture) {
  return {random.below(65536),
          1 + random.below(9999),
          1 + random.below(9999),
          static_cast<ImageFormat>(random.below(3)),
          texture,
          random.below(9)};
}

void expect_same(const RefinedTexture& a, const RefinedTexture& b) {
  EXPECT_EQ(a.stream, b.stream);
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  EXPECT_EQ(a.format, b.format);
  EXPECT_EQ(a.texture, b.texture);
  EXPECT_EQ(a.source, b.source);
}

TEST(TextureExtension, ReadsWhatItWritesWhereItStands) {
  for (uint64_t i = 0; i < 100; i++) {
    Random random(61, i);
    const std::vector<RefinedTexture> list = {any_refined(random, 0), any_refined(random, 2)};
    const auto again = read_refined_textures(Json::parse(pack_of(list).dump()));
    ASSERT_TRUE(again) << again.error().message();
    ASSERT_EQ(again->size(), list.size());
    for (size_t k = 0; k < list.size(); k++) expect_same((*again)[k], list[k]);
  }
}

TEST(TextureExtension, ReadsAnyJsonAsAListOrAnError) {
  int refused = 0;
  for (uint64_t i = 0; i < 1000; i++) {
    Random random(62, i);
    Json json = pack_of({any_refined(random, 1)});
    for (uint32_t changes = 1 + random.below(3); changes > 0; changes--) spoil(json, random);
    const auto list = read_refined_textures(json);
    if (list) continue;
    refused++;
    EXPECT_TRUE(list.error().element.starts_with("textures[")) << list.error().message();
  }
  EXPECT_GT(refused, 200);  // else the changes would not be nasty
}

TEST(TextureExtension, NamesWhatIsWrong) {
  Random random(63, 0);
  Json json = pack_of({any_refined(random, 1)});
  Json& texture = json["textures"][1];
  texture["extensions"][texture_extension]["mimeType"] = "image/gif";
  EXPECT_EQ(read_refined_textures(json).error().message(),
            "textures[1].LIGHTWELL_progressive_texture.mimeType: is no image format of packs");
  texture["extensions"][texture_extension]["mimeType"] = "image/png";
  texture.erase("source");
  EXPECT_EQ(read_refined_textures(json).error().message(), "textures[1].source: is missing");
}

}  // namespace
}  // namespace lightwell
