// SPDX-License-Identifier: Apache-2.0
#include "lightwell/mesh/quantize.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/mesh/level.h"
#include "tests/mesh/shapes.h"

namespace lightwell {
namespace {

TEST(NormalCode, EveryDirectionOfTheGridGivesBackItsCode) {
  for (int u = -511; u <= 511; u++)
    for (int v = -511; v <= 511; v++) {
      const Vec3f n = normal_of({static_cast<int16_t>(u), static_cast<int16_t>(v)});
      ASSERT_NEAR(length(n), 1, 1e-6);
      const NormalCode code = normal_code(n);
      if (std::abs(u) < 511 && std::abs(v) < 511)
        ASSERT_EQ(code, (NormalCode{static_cast<int16_t>(u), static_cast<int16_t>(v)}));
      else
        ASSERT_EQ(normal_of(code), n);  // two codes on the rim are one direction
      ASSERT_EQ(normal_code(normal_of(code)), code);
    }
}

TEST(NormalCode, IsWithinAQuarterOfADegree) {
  for (uint64_t i = 0; i < 10000; i++) {
    Random random(1, i);
    const Vec3f n = normalized(random_point(random) - Vec3f::filled(0.5f));
    // Half a cell's diagonal is (0.5, 0.5, 1) / 511 on the octahedron, at least 1 / sqrt(3) from the centre.
    const float farthest = std::sqrt(1.5f * 3) / 511;
    EXPECT_LT(length(normal_of(normal_code(n)) - n), farthest);
    const Vec<int64_t, 3> integers = (n * 1e6f).cast<int64_t>();
    EXPECT_LT(length(normal_of(normal_code(integers)) - n), 2 * farthest);  // rounded towards zero
  }
}

TEST(NormalCode, OfNoDirectionIsUp) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(normal_of(normal_code(Vec3f{})), (Vec3f{{0, 1, 0}}));
  EXPECT_EQ(normal_of(normal_code(Vec3f{{nan, 0, 0}})), (Vec3f{{0, 1, 0}}));
  EXPECT_EQ(normal_of(normal_code(Vec<int64_t, 3>{})), (Vec3f{{0, 1, 0}}));
}

TEST(NormalCode, OfHugeIntegersIsThatOfTheirDirection) {
  const int64_t huge = int64_t(1) << 61;
  EXPECT_EQ(normal_of(normal_code(Vec<int64_t, 3>{{0, 0, -huge}})), (Vec3f{{0, 0, -1}}));
  EXPECT_EQ(normal_code(Vec<int64_t, 3>{{huge, -huge, huge}}), normal_code(Vec<int64_t, 3>{{9, -9, 9}}));
}

TEST(Lattice, CodesAndValuesAreOneToOne) {
  for (const int exponent : {Lattice::min_exponent, -14, 0, 3, Lattice::max_exponent}) {
    const Lattice lattice{static_cast<int8_t>(exponent)};
    for (const int32_t code : {0, 1, -1, 12345, -99999, Lattice::limit, -Lattice::limit}) {
      EXPECT_EQ(lattice.code(lattice.value(code)), code);
      EXPECT_EQ(lattice.exact_code(lattice.value(code)), code);
    }
  }
  EXPECT_EQ(Lattice{}.code(1e30f), Lattice::limit);
  EXPECT_EQ(Lattice{}.code(std::numeric_limits<float>::quiet_NaN()), 0);
}

TEST(Quantize, KeepsPositionsWithinHalfAStepOf14Bits) {
  for (const auto& [name, mesh] : nasty_meshes()) {
    SCOPED_TRACE(name);
    const auto quantized = quantize(mesh, {});
    ASSERT_TRUE(quantized);
    const Mesh result = dequantize(*quantized);
    ASSERT_EQ(result.faces.size(), mesh.faces.size());
    const Vec3d lo = mesh.bounds().lo.cast<double>(), hi = mesh.bounds().hi.cast<double>();
    // Far from the origin the floats of the input are coarser than 14 bits of the box. A step is a power of two: up to
    // twice as long as 14 bits would let it be.
    const double magnitude = std::max(std::abs(max_component(hi)), std::abs(max_component(-lo)));
    const double side = max_component(hi - lo), allowed = std::max(side / 16383, magnitude * 0x1p-23);
    if (name == "a large soup") {
      EXPECT_LE(side, 16383.5 * static_cast<double>(quantized->position_lattice.step()));
    }
    for (size_t f = 0; f < mesh.faces.size(); f++)
      for (size_t k = 0; k < 3; k++) {
        const Vec3d p = mesh.positions[mesh.faces[f][k]].cast<double>();
        const Vec3d q = result.positions[result.faces[f][k]].cast<double>();
        for (int i = 0; i < 3; i++) ASSERT_LE(std::abs(p[i] - q[i]), allowed);
      }
  }
}

TEST(Quantize, KeepsTheErrorAskedFor) {
  const Mesh mesh = knot(40, 9);
  for (const float error : {1e-5f, 1e-3f, 0.03f}) {
    const Mesh result = dequantize(*quantize(mesh, {error}));
    float worst = 0;
    for (size_t f = 0; f < mesh.faces.size(); f++)
      for (int i = 0; i < 3; i++)
        worst =
            std::max(worst, std::abs(mesh.positions[mesh.faces[f][0]][i] - result.positions[result.faces[f][0]][i]));
    EXPECT_LE(worst, error);
    EXPECT_GT(worst, error / 4);  // the step is a power of two; no finer than needed
  }
}

// A lattice coarser than the mesh would make a point of it.
TEST(Quantize, AMeshSmallerThanTheErrorKeepsItsForm) {
  const Mesh mesh = knot(40, 9);
  Box3f box;
  for (const Vec3f& p : mesh.positions) box.extend(p);
  const Mesh result = dequantize(*quantize(mesh, {1000}));
  for (size_t f = 0; f < mesh.faces.size(); f++)
    for (int i = 0; i < 3; i++)  // half a step of 6 bits
      EXPECT_NEAR(mesh.positions[mesh.faces[f][0]][i], result.positions[result.faces[f][0]][i],
                  max_component(box.size()) / 128);
}

TEST(Quantize, ResultIsAFixedPoint) {
  for (const auto& [name, mesh] : nasty_meshes()) {
    SCOPED_TRACE(name);
    const QuantizedMesh once = *quantize(mesh, {});
    const Mesh values = dequantize(once);
    for (size_t v = 0; v < once.positions.size(); v++) {
      for (int i = 0; i < 3; i++) ASSERT_EQ(once.position_lattice.code(values.positions[v][i]), once.positions[v][i]);
      if (!once.normals.empty()) {
        ASSERT_EQ(normal_code(values.normals[v]), once.normals[v]);
      }
      if (!once.texcoords[0].empty()) {
        for (int i = 0; i < 2; i++)
          ASSERT_EQ(once.texcoord_lattices[0].code(values.texcoords[0][v][i]), once.texcoords[0][v][i]);
      }
      if (!once.colors.empty()) {
        ASSERT_EQ(color_code(values.colors[v]), once.colors[v]);
      }
    }
  }
}

TEST(Quantize, WeldsEqualVerticesAndDropsUnusedOnes) {
  Mesh mesh;
  for (int i = 0; i < 5; i++) add_triangle(mesh, {{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}});
  mesh.positions.push_back({{9, 9, 9}});
  const QuantizedMesh quantized = *quantize(mesh, {});
  EXPECT_EQ(quantized.positions.size(), 3u);
  EXPECT_EQ(quantized.faces.size(), 5u);
}

TEST(Quantize, KeepsVerticesOfOnePositionTogether) {
  const QuantizedMesh sphere = *quantize(seamed_sphere(12, 16), {});
  std::set<Vec3i> left;
  for (size_t v = 1; v < sphere.positions.size(); v++) {
    const bool begins = sphere.positions[v] != sphere.positions[v - 1];
    EXPECT_TRUE(!begins || left.insert(sphere.positions[v - 1]).second);
  }
}

TEST(Quantize, RefusesPositionsThatAreNone) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -2e37f}) {
    Mesh mesh = tetrahedron({}, 1);
    mesh.positions[2][1] = bad;
    const auto result = quantize(mesh, {});
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().element, "vertex 2");
  }
}

TEST(Quantize, TakesTexcoordsAndColoursOfAnyKind) {
  Mesh mesh = tetrahedron({}, 1);
  const float inf = std::numeric_limits<float>::infinity();
  mesh.texcoords[1] = {{{0, 1e30f}}, {{inf, 0}}, {{-inf, 1}}, {{0.5f, 0.25f}}};
  mesh.colors = {{{-1, 2, inf, 0.5f}}, {{std::numeric_limits<float>::quiet_NaN(), 0, 0, 0}}, {}, {}};
  EXPECT_TRUE(quantize(mesh, {}));
}

TEST(ColorCode, GivesItselfBack) {
  for (int i = 0; i < 256; i++) {
    const auto c = static_cast<uint8_t>(i);
    const ColorCode code{c, 0, 255, c};
    EXPECT_EQ(color_code(color_value(code)), code);
    EXPECT_EQ(color_code(color_of(color_value(code))), code);
  }
  EXPECT_EQ(color_value({0, 255, 0, 0}), (Color16{0, 65535, 0, 0}));
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  EXPECT_EQ(color_code(Vec4f{{nan, -1, 2, inf}}), (ColorCode{0, 0, 255, 255}));
}

// Scans store colours as shades of 8-bit sRGB (IEC 61966-2-1). None moves by a whole shade: the root's steps are at
// most 1.45 of sRGB's, where that becomes linear, and half a step is the error.
TEST(ColorCode, MovesAShadeOfSrgbByLessThanOne) {
  const auto linear = [](int shade) {
    const float x = static_cast<float>(shade) / 255;
    return x <= 0.04045f ? x / 12.92f : std::pow((x + 0.055f) / 1.055f, 2.4f);
  };
  for (int shade = 0; shade < 256; shade++) {
    const float value = linear(shade);
    const float step = std::min(linear(std::min(shade + 1, 255)) - linear(std::min(shade, 254)), 1.0f);
    EXPECT_NEAR(color_of(color_value(color_code(Vec4f::filled(value))))[0], value, 0.73f * step) << shade;
  }
}

// CIE 1976 lightness, of which 1 is just visible. Half a step of the root is largest where lightness becomes linear, at
// 0.008856: 903.3 * 24.5 / 255^2 = 0.34.
// Half is where glTF cuts masked surfaces off: what is just there stays there.
TEST(ColorCode, KeepsAlphaToHalfAStepOf255) {
  for (int i = 0; i <= 1000; i++) {
    const float alpha = static_cast<float>(i) / 1000;
    EXPECT_NEAR(color_of(color_value(color_code(Vec4f{{0, 0, 0, alpha}})))[3], alpha, 0.501f / 255) << alpha;
  }
  EXPECT_GE(color_of(color_value(color_code(Vec4f{{0, 0, 0, 0.5f}})))[3], 0.5f);
}

TEST(ColorCode, MovesLightnessByLessThanIsVisible) {
  const auto lightness = [](float y) { return y > 0.008856f ? 116 * std::cbrt(y) - 16 : 903.3f * y; };
  for (int i = 0; i <= 4096; i++) {
    const float value = static_cast<float>(i) / 4096;
    const Vec4f kept = color_of(color_value(color_code(Vec4f::filled(value))));
    EXPECT_NEAR(lightness(kept[0]), lightness(value), 0.35f) << value;
  }
}

}  // namespace
}  // namespace lightwell
