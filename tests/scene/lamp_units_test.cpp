// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/lamp_units.h"

#include <gtest/gtest.h>

#include <numbers>

#include "lightwell/scene/import_gltf.h"

namespace lightwell {
namespace {

/// What Blender writes by default for a point of 100 W: 683 lm/W over the whole sphere.
Document lamp_of_100_watts(const std::string& generator) {
  Document document;
  document.json["asset"]["generator"] = generator;
  document.json["scenes"] = Json::parse(R"([{"nodes": [0]}])");
  document.json["nodes"] = Json::parse(R"([{"extensions": {"KHR_lights_punctual": {"light": 0}}}])");
  document.json["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "point"}, {"intensity", 100 * 683 / (4 * std::numbers::pi)}}};
  return document;
}

float intensity_of(const Document& document) {
  Report report;
  return scene_from_document(document, "", report).value().lamps.at(0).intensity[0];
}

constexpr float lumens = 5435.14f, watts = 7.95775f;  // a steradian
constexpr float rounding = 1e-3f;                     // of the digits above
const std::string blender = "Khronos glTF Blender I/O v4.2.60";

TEST(LampUnits, AreThoseOfTheProgramUnlessSaid) {
  struct Case {
    std::string generator;
    LampUnits units;
    float expected;
    size_t lines;
  };
  for (const Case& c :
       {Case{blender, LampUnits::automatic, watts, 1}, Case{blender, LampUnits::radiometric, lumens, 0},
        Case{blender, LampUnits::photometric, watts, 0}, Case{"glTF-Transform", LampUnits::automatic, lumens, 0},
        Case{"glTF-Transform", LampUnits::photometric, watts, 0}}) {
    Document document = lamp_of_100_watts(c.generator);
    Report report;
    make_lamps_radiometric(document, c.units, report);
    EXPECT_NEAR(intensity_of(document), c.expected, rounding * c.expected) << c.generator;
    EXPECT_EQ(report.warnings.size(), c.lines);
  }
}

// What a pack's export is baked from is Blender's no longer.
TEST(LampUnits, OfAFileThatWasReadBeforeStay) {
  Document document = lamp_of_100_watts(blender);
  Report report;
  make_lamps_radiometric(document, LampUnits::automatic, report);
  make_lamps_radiometric(document, LampUnits::automatic, report);
  EXPECT_NEAR(intensity_of(document), watts, rounding * watts);
}

// Who edits a file of Blender's with another program has lamps in candela, and nothing tells of it but their size.
TEST(LampUnits, ThatAreLikelyCandelaBesideEmissionAreAdvisedOn) {
  struct Case {
    double intensity;
    std::vector<double> emission;
    size_t lines;
  };
  for (const Case& c :
       {Case{5435, {0, 1, 0}, 1}, Case{5435, {0, 0, 0}, 0}, Case{5435, {}, 0}, Case{40, {1, 1, 1}, 0}}) {
    Document document = lamp_of_100_watts("glTF-Transform");
    document.json["extensions"]["KHR_lights_punctual"]["lights"][0]["intensity"] = c.intensity;
    document.json["materials"][0]["emissiveFactor"] = c.emission;
    Report report;
    make_lamps_radiometric(document, LampUnits::automatic, report);
    ASSERT_EQ(report.warnings.size(), c.lines);
    for (const std::string& line : report.warnings)
      EXPECT_NE(line.find("--lamp-units photometric"), std::string::npos) << line;
  }
}

TEST(LampUnits, NothingIsSaidOfAFileWithoutLamps) {
  Document document;
  document.json["asset"]["generator"] = blender;
  const Json before = document.json;
  Report report;
  make_lamps_radiometric(document, LampUnits::automatic, report);
  EXPECT_TRUE(report.warnings.empty());
  EXPECT_EQ(document.json, before);
}

}  // namespace
}  // namespace lightwell
