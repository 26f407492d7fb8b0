// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/texture_extension.h"

#include <gtest/gtest.h>

#include "tests/packing/extension_properties.h"

namespace lightwell {
namespace {

RefinedTexture any_refined(Random& random, size_t texture) {
  RefinedTexture refined{random.below(65536),
                         1 + random.below(9999),
                         1 + random.below(9999),
                         static_cast<ImageFormat>(random.below(3)),
                         texture,
                         random.below(9),
                         {}};
  for (uint32_t left = random.below(3); left > 0; left--)
    refined.levels.push_back({random.below(65536), 1 + random.below(999), 1 + random.below(999)});
  return refined;
}

// A document in which some textures are refined, and others are not.
struct Textures {
  using Value = std::vector<RefinedTexture>;
  static constexpr const char* place = "textures[";
  static Value any(Random& random) { return {any_refined(random, 0), any_refined(random, 2)}; }
  static Json pack_of(const Value& list) {
    Json json = {{"textures", Json::array({{{"source", 0}}, {{"source", 0}}, {{"source", 0}}})}};
    for (const RefinedTexture& refined : list)
      json["textures"][refined.texture] = {{"source", refined.source},
                                           {"extensions", {{texture_extension, to_json(refined)}}}};
    return json;
  }
  static Result<Value> read(const Json& json) { return read_refined_textures(json); }
};

TEST(TextureExtension, ReadsWhatItWritesWhereItStands) { expect_reads_what_it_writes<Textures>(61); }
TEST(TextureExtension, ReadsAnyJsonAsAListOrAnError) { expect_reads_any_json_or_an_error<Textures>(62); }

TEST(TextureExtension, NamesWhatIsWrong) {
  Random random(63, 0);
  Json json = Textures::pack_of({any_refined(random, 1)});
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
