// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/environment_picture.h"

#include <gtest/gtest.h>

#include "lightwell/packing/unpack.h"
#include "lightwell/packing/verify.h"
#include "tests/packing/extension_properties.h"
#include "tests/packing/sample_scenes.h"

namespace lightwell {
namespace {

struct OfPack {
  using Value = std::optional<EnvironmentPicture>;
  static constexpr const char* place = environment_extension;
  static Value any(Random& random) {
    return EnvironmentPicture{random.below(3), 1e-3f + 1e6f * random.uniform(), 1 + 20 * random.uniform()};
  }
  static Json pack_of(const Value& picture) {
    Json json = {{"textures", Json::array({{{"source", 0}}, {{"source", 0}}, {{"source", 0}}})}};
    if (picture) json["extensions"][environment_extension] = to_json(*picture);
    return json;
  }
  static Result<Value> read(const Json& json) { return read_environment_picture(json); }
};

TEST(EnvironmentExtension, ReadsWhatItWrites) { expect_reads_what_it_writes<OfPack>(71); }
TEST(EnvironmentExtension, ReadsAnyJsonOrNamesTheError) { expect_reads_any_json_or_an_error<OfPack>(72); }

RadianceImage decoded(const CodedRadiance& picture) {
  return decoded(picture.image, {.texture = 0, .radiance = picture.radiance, .stops = picture.stops});
}

TEST(EnvironmentPicture, IsRightToHalfAStep) {
  const Environment sky = some_sky(64, 32);
  const CodedRadiance picture = coded(sky).value();
  const RadianceImage again = decoded(picture);
  ASSERT_EQ(again.pixels.size(), sky.map->pixels.size());
  const float half_step = std::exp2(picture.stops / 255 / 2);
  for (size_t i = 0; i < again.pixels.size(); i++) {
    const float darkest = picture.radiance * std::exp2(-picture.stops * 254 / 255);  // the byte 1
    if (sky.map->pixels[i] < darkest) continue;
    EXPECT_LT(std::max(again.pixels[i] / sky.map->pixels[i], sky.map->pixels[i] / again.pixels[i]), half_step * 1.001f);
  }
}

TEST(EnvironmentPicture, OfALargeMapHoldsMeans) {
  Environment sky = some_sky(1300, 650);
  sky.radiance = {{2, 1, 3}};
  const CodedRadiance picture = coded(sky).value();
  EXPECT_EQ(picture.image.width, environment_width);
  EXPECT_EQ(picture.image.height, environment_width / 2);
  const RadianceImage again = decoded(picture);
  for (size_t c = 0; c < 3; c++) {
    double sum = 0, wanted = 0;
    for (size_t i = c; i < again.pixels.size(); i += 3) sum += static_cast<double>(again.pixels[i]);
    for (size_t i = c; i < sky.map->pixels.size(); i += 3) wanted += static_cast<double>(sky.map->pixels[i]);
    sum /= static_cast<double>(again.pixels.size()), wanted /= static_cast<double>(sky.map->pixels.size());
    // Rounding to steps of 4 % evens out over the pixels but for the pattern of columns, which divide unevenly.
    EXPECT_NEAR(sum / wanted, static_cast<double>(sky.radiance[static_cast<int>(c)]), 0.02 * sum / wanted);
  }
}

TEST(EnvironmentPicture, OfNothingIsNone) {
  EXPECT_FALSE(coded({}));
  EXPECT_FALSE(coded({Vec3f::filled(1), nullptr}));
  const auto even = [](float radiance) {
    return std::make_shared<RadianceImage>(RadianceImage{4, 2, std::vector<float>(24, radiance)});
  };
  EXPECT_FALSE(coded({Vec3f::filled(1), even(0)}));
  EXPECT_FALSE(coded({Vec3f::filled(1), even(1e13f)}));
  EXPECT_TRUE(coded({Vec3f::filled(1), even(1e12f)}));
}

// What a viewer mirrors comes back from the pack, and what is baked from that pack does not carry it twice.
TEST(EnvironmentPicture, ComesBackFromThePack) {
  const Environment sky = some_sky(128, 64);
  const Packed packed = pack(sheet_document(), {}, sky);
  const OpenedPack opened = open(packed.file);
  const Verification verification = verify_pack(opened);
  EXPECT_TRUE(verification.errors.empty()) << testing::PrintToString(verification.errors);
  const RadianceImage again = unpack_environment(opened, {}).value().value();
  ASSERT_EQ(again.pixels.size(), sky.map->pixels.size());
  EXPECT_TRUE(again.pixels == decoded(coded(sky).value()).pixels);
  Report report;
  const Document document = unpack_document(opened, {}, report).value();
  EXPECT_FALSE(document.json.contains("textures"));
  EXPECT_FALSE(document.json.contains("images"));
}

TEST(EnvironmentPicture, WantsItsLightInAGrid) {
  const Packed packed = pack(sheet_document(), {}, some_sky(128, 64));
  const OpenedPack opened = open(packed.file);
  Json json = opened.json();
  json["extensions"]["LIGHTWELL_light_grids"]["grids"][0]["contains"] = {"indirect"};
  const std::vector<uint8_t> file = rewrite(opened, json, streams_of(opened.reader()));
  EXPECT_EQ(verify_pack(open(file)).errors,
            std::vector<std::string>{"scene: LIGHTWELL_light_grids: no grid has the light of the scene's sky"});
}

}  // namespace
}  // namespace lightwell
