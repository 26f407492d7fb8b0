// SPDX-License-Identifier: Apache-2.0
#include "lightwell/mesh/winding.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lightwell/base/random.h"
#include "tests/mesh/shapes.h"

namespace lightwell {
namespace {

/// A band of quads, `half_turns` of them twisted, whose ends are joined by position alone.
Mesh band(int steps, int half_turns) {
  Mesh mesh;
  for (int i = 0; i <= steps; i++) {
    const bool end = i == steps;
    const float around = 6.2831853f * static_cast<float>(end ? 0 : i) / static_cast<float>(steps);
    const float twist = 3.1415927f * static_cast<float>(half_turns * (end ? 0 : i)) / static_cast<float>(steps);
    for (const float side : {-1.0f, 1.0f}) {
      // The last pair is the first one, its ends exchanged after an odd number of half turns.
      const float across = (end && half_turns % 2 == 1 ? -side : side) * 0.3f;
      const float r = 2 + across * std::cos(twist);
      mesh.positions.push_back({{r * std::cos(around), across * std::sin(twist), r * std::sin(around)}});
    }
  }
  for (uint32_t i = 0; i < static_cast<uint32_t>(steps); i++) {
    const uint32_t a = 2 * i;
    mesh.faces.push_back({a, a + 1, a + 2});
    mesh.faces.push_back({a + 2, a + 1, a + 3});
  }
  return mesh;
}

TEST(Winding, IsAlikeInSoundSurfaces) {
  for (const Mesh& mesh : {sheet(6), seamed_sphere(9, 12), faceted_torus(7, 9), band(24, 0), band(24, 2)}) {
    const std::vector<uint8_t> against = wound_against_the_rest(mesh);
    EXPECT_EQ(std::ranges::count(against, 1), 0);
  }
}

TEST(Winding, OfFacesThatWereTurnedIsFound) {
  for (uint64_t round = 0; round < 20; round++) {
    Mesh mesh = round % 2 == 0 ? faceted_torus(9, 11) : band(40, 0);
    Random random(31, round);
    std::vector<uint8_t> turned(mesh.faces.size());
    double area = 0, of_turned = 0;
    for (size_t i = 0; i < mesh.faces.size(); i++) {
      turned[i] = random.uniform() < 0.1f + 0.08f * static_cast<float>(round % 10);
      const auto& [a, b, c] = mesh.faces[i];
      const double size = static_cast<double>(
          length(cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a])));
      area += size;
      if (!turned[i]) continue;
      of_turned += size;
      std::swap(mesh.faces[i][1], mesh.faces[i][2]);
    }
    // The greater part is what counts.
    if (of_turned > area / 2)
      for (uint8_t& face : turned) face ^= 1;
    EXPECT_EQ(wound_against_the_rest(mesh), turned) << round;
  }
}

TEST(Winding, OfAMoebiusStripIsLeft) {
  EXPECT_EQ(std::ranges::count(wound_against_the_rest(band(24, 1)), 1), 0);
  EXPECT_EQ(std::ranges::count(wound_against_the_rest(band(24, 3)), 1), 0);
}

// Three sheets that meet in a line, faces without area, nothing.
TEST(Winding, AnyMeshIsLookedAt) {
  Mesh fan;
  fan.positions = {{{0, 0, 0}}, {{0, 1, 0}}, {{1, 0, 0}}, {{0, 0, 1}}, {{-1, 0, 0}}};
  fan.faces = {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}, {2, 2, 2}, {0, 0, 1}};
  EXPECT_EQ(wound_against_the_rest(fan).size(), 5u);
  EXPECT_TRUE(wound_against_the_rest({}).empty());
}

}  // namespace
}  // namespace lightwell
