// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/stl.h"

#include <gtest/gtest.h>

#include "lightwell/base/random.h"
#include "lightwell/scene/creased_mesh.h"
#include "lightwell/scene/import_gltf.h"
#include "lightwell/texture/transfer.h"

namespace lightwell {
namespace {

using Triangle = std::array<Vec3f, 3>;

/// The twelve triangles of the unit cube moved by `by`, facing outwards.
std::vector<Triangle> cube(const Vec3f& by = {}) {
  std::vector<Triangle> triangles;
  for (int axis = 0; axis < 3; axis++)
    for (const float side : {0.0f, 1.0f}) {
      const auto corner = [&](float u, float v) {
        Vec3f p = by;
        p[axis] += side;
        p[(axis + 1) % 3] += side > 0 ? u : v;
        p[(axis + 2) % 3] += side > 0 ? v : u;
        return p;
      };
      triangles.push_back({corner(0, 0), corner(1, 0), corner(1, 1)});
      triangles.push_back({corner(0, 0), corner(1, 1), corner(0, 1)});
    }
  return triangles;
}

std::vector<uint8_t> binary(const std::vector<Triangle>& triangles, const std::vector<uint16_t>& words = {},
                            std::string header = "made by a test") {
  header.resize(80);
  ByteWriter writer;
  writer.append(as_bytes(header));
  writer.u32(static_cast<uint32_t>(triangles.size()));
  for (size_t i = 0; i < triangles.size(); i++) {
    for (int n = 0; n < 3; n++) writer.f32(0);
    for (const Vec3f& corner : triangles[i])
      for (const float x : corner.e) writer.f32(x);
    writer.u16(words.empty() ? 0 : words[i]);
  }
  return writer.release();
}

std::vector<uint8_t> ascii(const std::vector<Triangle>& triangles) {
  std::string text = "solid cube of a test\r\n";
  for (const Triangle& triangle : triangles) {
    text += " facet normal 0 0 0\n  outer loop\n";
    for (const Vec3f& p : triangle)
      text += "   vertex " + std::to_string(p[0]) + " " + std::to_string(p[1]) + " +" + std::to_string(p[2]) + "\n";
    text += "  endloop\n endfacet\n";
  }
  text += "endsolid\n";
  return {text.begin(), text.end()};
}

Scene import(const std::vector<uint8_t>& file) {
  Report report;
  auto document = stl_document(file, report);
  EXPECT_TRUE(document) << document.error().message();
  return scene_from_document(std::move(*document), "test", report).value();
}

TEST(Stl, ReadsBothForms) {
  for (const auto& file : {binary(cube()), ascii(cube()), binary(cube(), {}, "solid as some begin")}) {
    ASSERT_TRUE(is_stl(file));
    const Scene scene = import(file);
    const Mesh& mesh = scene.primitives.at(0).mesh;
    EXPECT_EQ(mesh.faces.size(), 12u);
    EXPECT_EQ(mesh.positions.size(), 24u);  // a cube's edges are sharp: four corners a side
    EXPECT_EQ(scene.bounds().hi, Vec3f::filled(1));
    for (const Face& face : mesh.faces) {
      const Vec3f& a = mesh.positions[face[0]];
      const Vec3f normal = normalized(cross(mesh.positions[face[1]] - a, mesh.positions[face[2]] - a));
      EXPECT_GT(dot(normal, a - Vec3f::filled(0.5f)), 0);
      for (const uint32_t corner : face) EXPECT_EQ(mesh.normals[corner], normal);
    }
  }
}

TEST(Stl, ReadsColoursOfBothKinds) {
  const uint16_t red = 31 << 10, blue = 31;
  std::vector<uint16_t> words(12, red | 0x8000);
  words[0] = 0;
  Mesh mesh = import(binary(cube(), words)).primitives.at(0).mesh;
  const float grey = srgb_to_linear(0.8f);
  // Written as 16 bits, hence the tolerance.
  EXPECT_LE(length(mesh.colors[mesh.faces[1][0]] - Vec4f{{1, 0, 0, 1}}), 1e-4f);
  EXPECT_LE(length(mesh.colors[mesh.faces[0][0]] - Vec4f{{grey, grey, grey, 1}}), 1e-4f);

  words.assign(12, blue);  // red is lowest
  words[0] = 0x8000;
  mesh = import(binary(cube(), words, "COLOR=" + std::string("\x00\xff\x00\xff", 4))).primitives.at(0).mesh;
  EXPECT_LE(length(mesh.colors[mesh.faces[1][0]] - Vec4f{{1, 0, 0, 1}}), 1e-4f);
  EXPECT_LE(length(mesh.colors[mesh.faces[0][0]] - Vec4f{{0, 1, 0, 1}}), 1e-4f);
}

TEST(Stl, AFlatEdgeIsSmoothAndASharpOneIsNot) {
  const auto pair = [](float rise) {
    const std::vector<Vec3f> corners = {{{0, 0, 0}}, {{0, 1, 0}},    {{-1, 0, 0}},
                                        {{0, 0, 0}}, {{1, 0, rise}}, {{0, 1, 0}}};
    return creased_mesh(corners, {});
  };
  EXPECT_EQ(pair(0.3f).positions.size(), 4u);
  EXPECT_EQ(pair(1.5f).positions.size(), 6u);
}

// A fan of very many triangles must not take the square of their number.
TEST(Stl, TakesLinearTimeWhereManyFacetsMeet) {
  std::vector<Vec3f> corners;
  for (int i = 0; i < 300000; i++) {
    const auto x = static_cast<float>(i);
    corners.insert(corners.end(), {{{0, 0, 0}}, {{x, 1, 0.001f * x}}, {{x + 1, 1, -0.002f * x}}});
  }
  EXPECT_EQ(creased_mesh(corners, {}).faces.size(), 300000u);
}

TEST(Stl, RefusesFaultsByName) {
  Report report;
  const auto reason = [&](const std::string& text) {
    const auto document = stl_document(as_bytes(text), report);
    return document ? std::string() : document.error().message();
  };
  EXPECT_EQ(reason("solid\nfacet\nvertex 0 0 zero\n"), "line 3: a vertex without three numbers");
  EXPECT_EQ(reason("solid\nfacet\nvertex 0 0 1e300\n"), "line 3: a number that is not finite, or beyond 1e9");
  EXPECT_EQ(reason("solid\nvertex 0 0 0\n"), "ends within a facet");
  EXPECT_EQ(reason("solid nothing\nendsolid\n"), "has no facets");
  auto file = binary(cube());
  file[84 + 12 + 3] = 0x7f;  // the first number becomes huge
  file[84 + 12 + 2] = 0xff;
  const auto document = stl_document(file, report);
  ASSERT_FALSE(document);
  EXPECT_EQ(document.error().message(), "facet 0: a number that is not finite, or beyond 1e9");
}

TEST(Stl, SurvivesDamage) {
  Random random(5, 0);
  for (const auto& whole : {binary(cube()), ascii(cube())})
    for (int i = 0; i < 2000; i++) {
      auto damaged = whole;
      for (int n = 0; n < 3; n++)
        damaged[random.below(static_cast<uint32_t>(whole.size()))] = static_cast<uint8_t>(random.below(256));
      damaged.resize(whole.size() - random.below(2) * random.below(static_cast<uint32_t>(whole.size())));
      Report report;
      (void)stl_document(damaged, report);
    }
}

}  // namespace
}  // namespace lightwell
