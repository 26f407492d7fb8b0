// SPDX-License-Identifier: Apache-2.0
#include <draco/attributes/geometry_attribute.h>
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include "lightwell/base/random.h"
#include "lightwell/gltf/draco_mesh.h"
#include "lightwell/texture/transfer.h"
#include "tests/gltf/samples.h"

namespace lightwell {
namespace {

/// A bumpy grid of n x n vertices.
Mesh grid(uint32_t n) {
  Mesh mesh;
  Random random(7, 0);
  for (uint32_t i = 0; i < n * n; i++)
    mesh.positions.push_back({{static_cast<float>(i % n), static_cast<float>(i / n), random.uniform()}});
  for (uint32_t y = 0; y + 1 < n; y++)
    for (uint32_t x = 0; x + 1 < n; x++) {
      const uint32_t a = y * n + x;
      mesh.faces.push_back({a, a + 1, a + n + 1});
      mesh.faces.push_back({a, a + n + 1, a + n});
    }
  return mesh;
}

// --- meshopt

std::vector<uint8_t> encode_vertices(const void* vertices, size_t count, size_t stride) {
  std::vector<uint8_t> bytes(meshopt_encodeVertexBufferBound(count, stride));
  bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), vertices, count, stride));
  return bytes;
}

/// Replaces a buffer view by a compressed one whose own buffer is a stand-in without data.
void compress_view(Document& document, size_t index, const char* extension, const std::vector<uint8_t>& bytes,
                   size_t stride, size_t count, const char* mode) {
  DocumentBuilder builder(document);
  Json packed = document.json["bufferViews"][static_cast<size_t>(builder.buffer_view(bytes))];
  packed["byteStride"] = stride;
  packed["count"] = count;
  packed["mode"] = mode;
  document.json["bufferViews"].erase(document.json["bufferViews"].size() - 1);
  Json& view = document.json["bufferViews"][index];
  view["extensions"][extension] = packed;
  view["buffer"] = 1;
  view["byteOffset"] = index * 100000;
  document.json["buffers"][1] = {{"byteLength", 1000000}};
}

/// A document whose positions and indices are compressed; view 0 holds positions, view 1 indices.
Document packed_document(const Mesh& mesh, const char* extension) {
  Document document = document_of(mesh);
  const auto* corners = mesh.faces[0].data();
  std::vector<uint8_t> indices(meshopt_encodeIndexBufferBound(mesh.faces.size() * 3, mesh.positions.size()));
  indices.resize(meshopt_encodeIndexBuffer(indices.data(), indices.size(), corners, mesh.faces.size() * 3));
  compress_view(document, 0, extension, encode_vertices(mesh.positions.data(), mesh.positions.size(), 12), 12,
                mesh.positions.size(), "ATTRIBUTES");
  compress_view(document, 1, extension, indices, 2, mesh.faces.size() * 3, "TRIANGLES");
  document.json["extensionsUsed"] = {extension};
  document.json["extensionsRequired"] = {extension};
  return document;
}

class Meshopt : public testing::TestWithParam<const char*> {};

TEST_P(Meshopt, BecomesPlainBuffers) {
  const Mesh mesh = grid(40);
  const auto document = read_again(packed_document(mesh, GetParam()));
  ASSERT_TRUE(document) << document.error().message();
  EXPECT_EQ(document->json.dump().find("meshopt"), std::string::npos);
  EXPECT_EQ(document->buffers.size(), 2u);  // neither the stand-in nor the compressed bytes
  Report report;
  const auto read = read_primitive(*document, 0, 0, report);
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_EQ(read->positions, mesh.positions);
  ASSERT_EQ(read->faces.size(), mesh.faces.size());
  for (size_t i = 0; i < mesh.faces.size(); i++) {  // the codec may begin a triangle at another corner
    Face face = read->faces[i];
    while (face[0] != mesh.faces[i][0]) std::rotate(face.begin(), face.begin() + 1, face.end());
    EXPECT_EQ(face, mesh.faces[i]);
  }
}

TEST_P(Meshopt, FaultsAreNamed) {
  const auto error_of = [&](const char* key, const Json& value) {
    Document document = packed_document(grid(10), GetParam());
    document.json["bufferViews"][0]["extensions"][GetParam()][key] = value;
    const auto read = read_again(document);
    return read ? "" : read.error().reason;
  };
  EXPECT_EQ(error_of("byteLength", 40), "damaged meshopt data");
  EXPECT_EQ(error_of("byteLength", 1000000), "reaches outside buffers[0]");
  EXPECT_EQ(error_of("byteStride", 13), "byteStride or count is none that its mode allows");
  EXPECT_EQ(error_of("byteStride", 260), "byteStride or count is none that its mode allows");
  EXPECT_EQ(error_of("count", 0), "byteStride or count is none that its mode allows");
  EXPECT_EQ(error_of("count", 4000000000u), "holds too few bytes");
  EXPECT_EQ(error_of("count", 99), "holds less than the byteLength of its buffer view");
  EXPECT_EQ(error_of("mode", "POINTS"), "mode is none of the extension's");
  EXPECT_EQ(error_of("filter", "BLUR"), "filter or its byteStride is none of the extension's");
  EXPECT_EQ(error_of("buffer", 5), "there is no buffers[5]");
  EXPECT_EQ(error_of("buffer", 1), "reaches outside buffers[1]");
}

INSTANTIATE_TEST_SUITE_P(Both, Meshopt, testing::Values("EXT_meshopt_compression", "KHR_meshopt_compression"));

/// Decodes `count` filtered elements and returns the buffer view's bytes.
std::vector<uint8_t> decode_filtered(const std::vector<uint8_t>& elements, size_t stride, const char* filter) {
  const size_t count = elements.size() / stride;
  Document document;
  DocumentBuilder builder(document);
  builder.buffer_view(elements);
  builder.add("images", {{"bufferView", 0}});  // so that the view is in use
  compress_view(document, 0, "KHR_meshopt_compression", encode_vertices(elements.data(), count, stride), stride, count,
                "ATTRIBUTES");
  document.json["bufferViews"][0]["extensions"]["KHR_meshopt_compression"]["filter"] = filter;
  const auto read = read_again(document);
  if (!read) return {};
  return *read_image(*read, 0);
}

TEST(MeshoptFilter, OctahedralGivesUnitVectors) {
  std::vector<float> vectors;
  Random random(3, 0);
  for (int i = 0; i < 64; i++) {
    const Vec3f v = normalized(Vec3f{{random.uniform() - 0.5f, random.uniform() - 0.5f, random.uniform() - 0.5f}});
    for (const float value : {v[0], v[1], v[2], 0.0f}) vectors.push_back(value);
  }
  std::vector<uint8_t> encoded(64 * 4);
  meshopt_encodeFilterOct(encoded.data(), 64, 4, 8, vectors.data());
  const std::vector<uint8_t> decoded = decode_filtered(encoded, 4, "OCTAHEDRAL");
  ASSERT_EQ(decoded.size(), encoded.size());
  for (size_t i = 0; i < decoded.size(); i++) {
    if (i % 4 == 3) continue;
    EXPECT_NEAR(static_cast<int8_t>(decoded[i]) / 127.0f, vectors[i], 0.02f);  // 8 bits, rounded twice
  }
}

TEST(MeshoptFilter, ExponentialGivesFloats) {
  const std::vector<float> values = {1, -0.5f, 1000, 0.125f};
  std::vector<uint8_t> encoded(16);
  meshopt_encodeFilterExp(encoded.data(), 1, 16, 16, values.data());
  const std::vector<uint8_t> decoded = decode_filtered(encoded, 16, "EXPONENTIAL");
  ASSERT_EQ(decoded.size(), 16u);
  for (size_t i = 0; i < 4; i++) {
    float value;
    std::memcpy(&value, &decoded[4 * i], 4);
    EXPECT_NEAR(value, values[i], 1000.0f / (1 << 14));  // 16 bits of the shared exponent's range
  }
}

// Y, Co, Cg and the alpha that marks eight bits (Appendix B of the extension), computed by hand: white, a grey of half
// alpha, green.
TEST(MeshoptFilter, ColorGivesRgba) {
  const std::vector<uint8_t> encoded = {255, 0, 0, 255, 128, 0, 0, 0xc0, 127, 0, 127, 255};
  EXPECT_EQ(decode_filtered(encoded, 4, "COLOR"),
            (std::vector<uint8_t>{255, 255, 255, 255, 128, 128, 128, 128, 0, 254, 0, 255}));
}

// --- Draco

std::vector<uint8_t> encode_draco(const Mesh& mesh) {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(static_cast<int>(mesh.faces.size()));
  const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  const int color = builder.AddAttribute(draco::GeometryAttribute::COLOR, 4, draco::DT_UINT8);
  for (size_t i = 0; i < mesh.faces.size(); i++) {
    const Face& f = mesh.faces[i];
    const auto& p = mesh.positions;
    const draco::FaceIndex face(static_cast<uint32_t>(i));
    builder.SetAttributeValuesForFace(position, face, &p[f[0]], &p[f[1]], &p[f[2]]);
    const uint8_t red[4] = {255, 0, 51, 255};
    builder.SetAttributeValuesForFace(color, face, red, red, red);
  }
  const auto encoded_mesh = builder.Finalize();
  draco::Encoder encoder;
  draco::EncoderBuffer buffer;
  encoder.EncodeMeshToBuffer(*encoded_mesh, &buffer);
  return {buffer.data(), buffer.data() + buffer.size()};
}

Document draco_document(const Mesh& mesh, std::vector<uint8_t> bytes) {
  Document document;
  DocumentBuilder builder(document);
  const int view = builder.buffer_view(bytes);
  builder.add("accessors", {{"componentType", 5126}, {"count", mesh.positions.size()}, {"type", "VEC3"}});
  builder.add("accessors",
              {{"componentType", 5121}, {"count", mesh.positions.size()}, {"type", "VEC4"}, {"normalized", true}});
  builder.add("accessors", {{"componentType", 5125}, {"count", mesh.faces.size() * 3}, {"type", "SCALAR"}});
  const Json draco = {{"bufferView", view}, {"attributes", {{"POSITION", 0}, {"COLOR_0", 1}}}};
  const Json primitive = {{"attributes", {{"POSITION", 0}, {"COLOR_0", 1}}},
                          {"indices", 2},
                          {"extensions", {{"KHR_draco_mesh_compression", draco}}}};
  builder.add("meshes", {{"primitives", {primitive, primitive}}});
  document.json["extensionsUsed"] = {"KHR_draco_mesh_compression"};
  document.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  return document;
}

std::vector<std::array<Vec3f, 3>> sorted_triangles(const Mesh& mesh) {
  std::vector<std::array<Vec3f, 3>> triangles;
  for (const Face& face : mesh.faces) {
    std::array<Vec3f, 3> corners = {mesh.positions[face[0]], mesh.positions[face[1]], mesh.positions[face[2]]};
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    triangles.push_back(corners);
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

TEST(Draco, BecomesPlainBuffers) {
  const Mesh mesh = grid(30);
  const auto document = read_again(draco_document(mesh, encode_draco(mesh)));
  ASSERT_TRUE(document) << document.error().message();
  EXPECT_EQ(document->json.dump().find("draco"), std::string::npos);
  Report report;
  for (const int primitive : {0, 1}) {
    const auto read = read_primitive(*document, 0, primitive, report);
    ASSERT_TRUE(read) << read.error().message();
    EXPECT_EQ(sorted_triangles(*read), sorted_triangles(mesh));
    EXPECT_EQ(read->colors[0], (Vec4f{{1, 0, 0.2f, 1}}));
  }
}

TEST(Draco, BareFilesAreRead) {
  const Mesh mesh = grid(30);
  const auto read = read_draco_file(encode_draco(mesh));
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_EQ(sorted_triangles(*read), sorted_triangles(mesh));
  EXPECT_NEAR(read->colors[0][2], srgb_to_linear(uint8_t(51)), 1e-6);  // rounding of floats
}

/// A number as Draco writes it: seven bits a byte, the lowest first.
void append_varint(ByteWriter& writer, uint32_t value) {
  for (; value >= 128; value >>= 7) writer.u8(static_cast<uint8_t>(value | 128));
  writer.u8(static_cast<uint8_t>(value));
}

TEST(Draco, CountsAreHeldAgainstTheBytes) {
  const std::vector<uint8_t> real = encode_draco(grid(100));
  EXPECT_TRUE(read_draco_file(real));
  for (const uint8_t method : {0, 1}) {  // sequential and edgebreaker
    ByteWriter writer;
    writer.append(as_bytes("DRACO"));
    for (const uint8_t byte : {uint8_t(2), uint8_t(2), uint8_t(1), method, uint8_t(0), uint8_t(0)}) writer.u8(byte);
    if (method == 1) writer.u8(0);
    append_varint(writer, 150000000);
    append_varint(writer, 300000000);
    writer.append(std::vector<uint8_t>(1000));
    const auto read = read_draco_file(writer.bytes());
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().kind, ErrorKind::limit);
    EXPECT_NE(read.error().reason.find("announces 300000000"), std::string::npos) << read.error().reason;
  }
}

TEST(Draco, DamagedBareFilesAreRefusedOrRead) {
  const std::vector<uint8_t> whole = encode_draco(grid(8));
  Random random(3, 0);
  for (int i = 0; i < 2000; i++) {
    auto damaged = whole;
    for (int n = 0; n < 2; n++)
      damaged[random.below(static_cast<uint32_t>(whole.size()))] = static_cast<uint8_t>(random.below(256));
    const auto read = read_draco_file(damaged);
    if (!read) continue;
    for (const Face& face : read->faces)
      for (const uint32_t corner : face) ASSERT_LT(corner, read->positions.size());
  }
}

TEST(Draco, AccessorsThatTwoStreamsShareAreParted) {
  const Mesh small = grid(3), large = grid(9);
  Document document = draco_document(small, encode_draco(small));
  const int second = DocumentBuilder(document).buffer_view(encode_draco(large));
  document.json["meshes"][0]["primitives"][1]["extensions"]["KHR_draco_mesh_compression"]["bufferView"] = second;
  const auto read = read_again(document);
  ASSERT_TRUE(read) << read.error().message();
  Report report;
  EXPECT_EQ(read_primitive(*read, 0, 0, report)->faces.size(), small.faces.size());
  EXPECT_EQ(read_primitive(*read, 0, 1, report)->faces.size(), large.faces.size());
}

TEST(Draco, FaultsAreNamed) {
  const Mesh mesh = grid(5);
  const std::vector<uint8_t> bytes = encode_draco(mesh);
  const auto error_of = [&](const char* pointer, const Json& value) {
    Document document = draco_document(mesh, bytes);
    document.json[Json::json_pointer(pointer)] = value;
    const auto read = read_again(document);
    return read ? "" : read.error().message();
  };
  const std::string extension = "/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression";
  EXPECT_EQ(error_of((extension + "/attributes/POSITION").c_str(), 17),
            "meshes[0].primitives[0].KHR_draco_mesh_compression.POSITION: is not among the attributes");
  EXPECT_EQ(error_of((extension + "/bufferView").c_str(), 17),
            "meshes[0].primitives[0].extensions.KHR_draco_mesh_compression.bufferView: there is no bufferViews[17]");
  EXPECT_EQ(error_of("/accessors/0/type", "VEC2"),
            "meshes[0].primitives[0].KHR_draco_mesh_compression.POSITION: has other components");
  EXPECT_EQ(error_of("/bufferViews/0/byteLength", bytes.size() / 2),
            "meshes[0].primitives[0].KHR_draco_mesh_compression: damaged Draco data");
}

TEST(Draco, CorruptBytesNeverCrash) {
  const Mesh mesh = grid(5);
  const std::vector<uint8_t> bytes = encode_draco(mesh);
  for (size_t i = 0; i < bytes.size(); i++) {
    std::vector<uint8_t> wrong = bytes;
    wrong[i] ^= 0xff;
    const auto document = read_again(draco_document(mesh, wrong));
    Report report;
    if (document) (void)read_primitive(*document, 0, 0, report);
  }
}

// --- sparse

TEST(Sparse, ValuesReplaceElements) {
  Document document = document_of(square());
  DocumentBuilder builder(document);
  const int indices = builder.buffer_view(raw<uint8_t>({1, 3}));
  const int values = builder.buffer_view(raw<float>({10, 11, 12, 20, 21, 22}));
  const Json sparse = {{"count", 2},
                       {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                       {"values", {{"bufferView", values}}}};
  document.json["accessors"][0]["sparse"] = sparse;
  const auto read = first_mesh(document);
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_EQ(read->positions, (std::vector<Vec3f>{{{0, 0, 0}}, {{10, 11, 12}}, {{1, 1, 0}}, {{20, 21, 22}}}));

  document.json["accessors"][0].erase("bufferView");  // the rest is zero then
  EXPECT_EQ(first_mesh(document)->positions[2], (Vec3f{}));

  document.json["accessors"][0]["sparse"]["indices"]["byteOffset"] = 1;
  EXPECT_EQ(read_again(document).error().message(),
            "accessors[0].sparse.indices: reaches outside bufferViews[" + std::to_string(indices) + "]");
  document.json["accessors"][0]["count"] = 2;
  document.json["accessors"][0]["sparse"] = sparse;
  document.json["meshes"][0]["primitives"][0].erase("indices");
  EXPECT_EQ(read_again(document).error().message(), "accessors[0].sparse.indices: an index is outside the accessor");
}

TEST(Sparse, ZerosNeedNoBuffer) {
  Document document;
  document.json =
      Json::parse(R"({"asset":{"version":"2.0"},"accessors":[{"componentType":5126,"count":3,"type":"VEC3"}],
                                  "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}]})");
  Report report;
  const auto read = read_bytes(bytes_of(document.json.dump()));
  ASSERT_TRUE(read);
  EXPECT_EQ(read_primitive(*read, 0, 0, report)->positions, std::vector<Vec3f>(3));
  document.json["accessors"][0]["count"] = 1e12;
  EXPECT_EQ(read_bytes(bytes_of(document.json.dump())).error().message(),
            "accessors[0]: expands to more than is sensible for a file of this size");
}

// Of an animation, whose accessors stay as they are: a validator refuses a file that has one.
TEST(Sparse, APlaceInNoBufferGoes) {
  Document document = document_of(square());
  DocumentBuilder builder(document);
  const int indices = builder.buffer_view(raw<uint8_t>({1}));
  const int values = builder.buffer_view(raw<float>({2}));
  const int times = builder.add("accessors", {{"byteOffset", 0},
                                              {"componentType", 5126},
                                              {"count", 2},
                                              {"type", "SCALAR"},
                                              {"min", {0}},
                                              {"max", {2}},
                                              {"sparse",
                                               {{"count", 1},
                                                {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                                                {"values", {{"bufferView", values}}}}}});
  const int places =
      builder.add("accessors", {{"bufferView", values}, {"componentType", 5126}, {"count", 1}, {"type", "SCALAR"}});
  document.json["animations"] = {{{"samplers", {{{"input", times}, {"output", places}}}},
                                  {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}}}};
  const auto read = read_again(document);
  ASSERT_TRUE(read) << read.error().message();
  const Json& accessors = read->json["accessors"];
  const auto sparse = std::ranges::find_if(accessors, [](const Json& accessor) { return accessor.contains("sparse"); });
  ASSERT_NE(sparse, accessors.end());
  EXPECT_FALSE(sparse->contains("byteOffset"));
  EXPECT_EQ((*sparse)["count"], 2);
}

}  // namespace
}  // namespace lightwell
