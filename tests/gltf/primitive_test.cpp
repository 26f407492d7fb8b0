// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "tests/gltf/samples.h"

namespace lightwell {
namespace {

Mesh full_mesh() {
  Mesh mesh = square();
  mesh.normals = {{{0, 0, 1}}, {{0, 1, 0}}, {{1, 0, 0}}, {{0, 0.6f, 0.8f}}};
  mesh.texcoords[0] = {{{0, 0}}, {{1, 0}}, {{1, 1}}, {{-2.5f, 1e3f}}};
  mesh.texcoords[1] = {{{0.5f, 0}}, {{0.25f, 0}}, {{0, 0}}, {{0, 1}}};
  mesh.colors = {{{1, 0, 0, 1}}, {{0, 1, 0, 0}}, {{0.2f, 0.4f, 0.6f, 0.8f}}, {{0, 0, 0, 1}}};
  return mesh;
}

/// Replaces the data of an attribute of the first primitive.
void set_attribute(Document& document, const char* semantic, const std::vector<uint8_t>& bytes, int component,
                   const char* type, size_t count, bool is_normalized, size_t stride = 0) {
  DocumentBuilder builder(document);
  const int view = builder.buffer_view(bytes);
  if (stride > 0) document.json["bufferViews"].back()["byteStride"] = stride;
  const int accessor = builder.add("accessors", {{"bufferView", view},
                                                 {"componentType", component},
                                                 {"type", type},
                                                 {"count", count},
                                                 {"normalized", is_normalized}});
  document.json["meshes"][0]["primitives"][0]["attributes"][semantic] = accessor;
}

TEST(Primitive, RoundTripsThroughTheBuilder) {
  const Mesh mesh = full_mesh();
  const auto read = first_mesh(document_of(mesh));
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_EQ(read->positions, mesh.positions);
  EXPECT_EQ(read->texcoords, mesh.texcoords);
  EXPECT_EQ(read->faces, mesh.faces);
  for (size_t i = 0; i < 4; i++) {
    EXPECT_LT(length(read->normals[i] - mesh.normals[i]), 1e-6f);  // normalised again: a few ulp
    EXPECT_LE(length(read->colors[i] - mesh.colors[i]), 1e-6f);    // multiples of 1/5 are multiples of 1/255
  }
}

TEST(Primitive, WithoutNormalsStaysSo) {
  const auto read = first_mesh(document_of(square()));
  ASSERT_TRUE(read);
  EXPECT_TRUE(read->normals.empty());
  EXPECT_TRUE(read->colors.empty());
}

TEST(Primitive, WideAndNarrowIndicesAreTheSame) {
  Mesh mesh = square();
  for (const size_t vertices : {size_t(4), size_t(65535), size_t(65536), size_t(70000)}) {
    mesh.positions.resize(vertices, Vec3f{{2, 2, 2}});
    const auto last = static_cast<uint32_t>(vertices - 1);
    mesh.faces.assign(vertices / 2 + 1, Face{0, 1, last});
    const auto read = first_mesh(document_of(mesh));
    ASSERT_TRUE(read);
    EXPECT_EQ(read->faces, mesh.faces);
  }
}

TEST(Primitive, StripsAndFansHaveTheSpecifiedFaces) {
  Mesh mesh = square();
  mesh.positions.push_back({{2, 2, 0}});
  Document document = document_of(mesh);
  Json& primitive = document.json["meshes"][0]["primitives"][0];
  primitive.erase("indices");
  primitive["mode"] = 5;
  EXPECT_EQ(first_mesh(document)->faces, (std::vector<Face>{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}));
  primitive["mode"] = 6;
  EXPECT_EQ(first_mesh(document)->faces, (std::vector<Face>{{1, 2, 0}, {2, 3, 0}, {3, 4, 0}}));
  primitive["mode"] = 4;  // the last two corners are no triangle
  EXPECT_EQ(first_mesh(document)->faces, (std::vector<Face>{{0, 1, 2}}));
}

TEST(Primitive, DegenerateTrianglesAreKept) {
  Mesh mesh = square();
  mesh.faces = {{0, 0, 0}, {0, 1, 1}, {0, 1, 2}, {0, 1, 2}};
  mesh.positions[3] = mesh.positions[0];
  EXPECT_EQ(first_mesh(document_of(mesh))->faces, mesh.faces);
}

TEST(Primitive, UnusedVerticesOfASharedAccessorAreLeftOut) {
  Mesh mesh = square();
  mesh.positions.resize(1000, Vec3f{{std::numeric_limits<float>::quiet_NaN(), 0, 0}});
  mesh.positions[900] = {{9, 9, 9}};
  mesh.faces = {{900, 1, 2}};
  mesh.texcoords[0].resize(1000);
  mesh.texcoords[0][900] = {{7, 8}};
  const auto read = first_mesh(document_of(mesh));
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_EQ(read->positions, (std::vector<Vec3f>{{{1, 0, 0}}, {{1, 1, 0}}, {{9, 9, 9}}}));
  EXPECT_EQ(read->texcoords[0][2], (Vec2f{{7, 8}}));
  EXPECT_EQ(read->faces, (std::vector<Face>{{2, 0, 1}}));
}

// The equations of glTF 2.0, section 3.11: c / 127, c / 255, c / 32767, c / 65535, and never below -1.
TEST(Primitive, NormalisedIntegersBecomeFloats) {
  Document document = document_of(square());
  set_attribute(document, "NORMAL", raw<int8_t>({0, 0, 127, 0, 0, -128, 127, 0, 0, 0, 0, 127}), 5120, "VEC3", 4, true);
  set_attribute(document, "COLOR_0", raw<uint16_t>({0, 65535, 13107, 0, 1, 2, 3, 4, 5, 6, 7, 8}), 5123, "VEC3", 4,
                true);
  set_attribute(document, "TEXCOORD_0", raw<uint8_t>({0, 255, 51, 102, 1, 2, 3, 4}), 5121, "VEC2", 4, true);
  set_attribute(document, "TEXCOORD_1", raw<int16_t>({-32768, 32767, 0, 1, 2, 3, 4, 5}), 5122, "VEC2", 4, true);
  const auto read = first_mesh(document);
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_EQ(read->normals[1], (Vec3f{{0, 0, -1}}));
  EXPECT_EQ(read->colors[0], (Vec4f{{0, 1, 0.2f, 1}}));
  EXPECT_EQ(read->texcoords[0][0], (Vec2f{{0, 1}}));
  EXPECT_EQ(read->texcoords[0][1], (Vec2f{{0.2f, 0.4f}}));
  EXPECT_EQ(read->texcoords[1][0], (Vec2f{{-1, 1}}));
}

TEST(Primitive, QuantisedAndInterleavedPositionsAreRead) {
  Document document = document_of(square());
  document.json["extensionsUsed"] = {"KHR_mesh_quantization"};
  std::vector<uint8_t> bytes;
  for (int16_t i = 0; i < 4; i++) {
    const auto vertex = raw<int16_t>({i, static_cast<int16_t>(-100 * i), 30000, 77});  // the fourth is padding
    bytes.insert(bytes.end(), vertex.begin(), vertex.end());
  }
  bytes.resize(bytes.size() - 2);  // the last element may end before its stride does
  set_attribute(document, "POSITION", bytes, 5122, "VEC3", 4, false, 8);
  const auto read = first_mesh(document);
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_EQ(read->positions[3], (Vec3f{{3, -300, 30000}}));
}

TEST(Primitive, PositionsThatAreNotFiniteAreRefused) {
  for (const float wrong : {NAN, INFINITY, -INFINITY}) {
    Mesh mesh = square();
    mesh.positions[2][1] = wrong;
    const auto read = first_mesh(document_of(mesh));
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().message(),
              "meshes[0].primitives[0].attributes.POSITION: vertex 2 is not at a finite position");
  }
}

TEST(Primitive, IndicesOutsideAreRefused) {
  Mesh mesh = square();
  mesh.faces[1][2] = 4;
  EXPECT_EQ(first_mesh(document_of(mesh)).error().message(),
            "meshes[0].primitives[0].indices: 4 is outside the 4 vertices");
}

TEST(Primitive, WrongNormalsAreComputedAndOtherNumbersThatAreNotFiniteAreZero) {
  Mesh mesh = full_mesh();
  mesh.normals[0] = {{0, 0, 0}};
  mesh.normals[1] = {{NAN, 0, 0}};
  mesh.texcoords[0][1][0] = INFINITY;
  const Document document = document_of(mesh);
  Report report;
  const auto read = read_primitive(document, 0, 0, report);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->normals[0], (Vec3f{{0, 0, 1}}));
  EXPECT_EQ(read->normals[1], (Vec3f{{0, 0, 1}}));
  EXPECT_EQ(read->texcoords[0][1], (Vec2f{{0, 0}}));
  EXPECT_EQ(report.warnings.size(), 2u);
}

TEST(Primitive, ThatDoesNotExistIsAnError) {
  Report report;
  EXPECT_FALSE(read_primitive(document_of(square()), 0, 1, report));
  EXPECT_FALSE(read_primitive(document_of(square()), -1, 0, report));
  EXPECT_FALSE(read_primitive(Document(), 0, 0, report));
}

}  // namespace
}  // namespace lightwell
