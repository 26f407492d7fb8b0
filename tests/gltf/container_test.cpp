// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "lightwell/base/random.h"
#include "tests/gltf/samples.h"

namespace lightwell {
namespace {

std::vector<uint8_t> sample_glb() {
  const Document document = document_of(square());
  return glb(document.json, document.buffers[0]);
}

void put_u32(std::vector<uint8_t>& bytes, size_t at, uint32_t value) {
  for (size_t i = 0; i < 4; i++) bytes[at + i] = static_cast<uint8_t>(value >> (8 * i));
}

uint32_t get_u32(const std::vector<uint8_t>& bytes, size_t at) {
  ByteReader reader{Bytes(bytes).subspan(at)};
  return reader.u32();
}

std::string error_of(const std::vector<uint8_t>& bytes) {
  const auto document = read_bytes(bytes);
  return document ? "" : document.error().message();
}

TEST(Container, IsRecognisedByContent) {
  EXPECT_TRUE(is_gltf(sample_glb()));
  EXPECT_TRUE(is_gltf(bytes_of(" \n{}")));
  EXPECT_TRUE(is_gltf(bytes_of("\xef\xbb\xbf{}")));
  EXPECT_FALSE(is_gltf(bytes_of("ply\n")));
  EXPECT_FALSE(is_gltf({}));
}

TEST(Container, EveryPrefixIsRefused) {
  const std::vector<uint8_t> whole = sample_glb();
  ASSERT_TRUE(read_bytes(whole));
  for (size_t size = 0; size < whole.size(); size++)
    ASSERT_FALSE(read_bytes({whole.begin(), whole.begin() + static_cast<ptrdiff_t>(size)})) << size;
}

TEST(Container, CorruptBytesNeverCrash) {
  const std::vector<uint8_t> whole = sample_glb();
  for (size_t i = 0; i < whole.size(); i++)
    for (const uint8_t flip : {1, 0x80, 0xff}) {
      std::vector<uint8_t> wrong = whole;
      wrong[i] ^= flip;
      Report report;
      const auto document = read_bytes(wrong);
      if (document) (void)read_primitive(*document, 0, 0, report);
    }
}

TEST(Container, HeaderFaultsAreNamed) {
  std::vector<uint8_t> bytes = sample_glb();
  put_u32(bytes, 4, 1);
  EXPECT_EQ(error_of(bytes), "GLB header: version 1 is not supported, only 2 (at byte 4)");
  bytes = sample_glb();
  put_u32(bytes, 8, static_cast<uint32_t>(bytes.size()) + 4);
  EXPECT_NE(error_of(bytes).find("GLB header: announces"), std::string::npos);
  bytes = sample_glb();
  put_u32(bytes, 12, 0xfffffff0);
  EXPECT_EQ(error_of(bytes), "chunks[0]: is longer than the file (at byte 12)");
  bytes = sample_glb();
  put_u32(bytes, 16, 0x004e4942);
  EXPECT_EQ(error_of(bytes), "chunks[0]: is not of type JSON");
  bytes = sample_glb();
  put_u32(bytes, 24 + get_u32(bytes, 12), 0x4e4f534a);
  EXPECT_EQ(error_of(bytes), "chunks[1]: is a second chunk of type JSON");
}

TEST(Container, SkipsUnknownChunksAndWarnsOfBytesAfterTheEnd) {
  std::vector<uint8_t> bytes = sample_glb();
  for (const uint32_t word : {4u, 0x5453574cu, 7u}) {
    bytes.resize(bytes.size() + 4);
    put_u32(bytes, bytes.size() - 4, word);
  }
  put_u32(bytes, 8, static_cast<uint32_t>(bytes.size()));
  EXPECT_TRUE(read_bytes(bytes));
  bytes.push_back(0);
  Report report;
  EXPECT_TRUE(read_document(bytes, "", report));
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_EQ(report.warnings[0], "bytes after the end of the GLB are ignored");
}

TEST(Container, ReadsJsonWithAByteOrderMark) {
  EXPECT_TRUE(read_bytes(bytes_of("\xef\xbb\xbf{\"asset\":{\"version\":\"2.0\"}}")));
}

TEST(Container, JsonFaultsAreNamed) {
  EXPECT_EQ(error_of(bytes_of("{\"asset\":}")), "JSON: syntax error (at byte 9)");
  EXPECT_EQ(error_of(bytes_of("[1e999]")), "JSON: holds a number that is too large");
  EXPECT_EQ(error_of(bytes_of("[]")), "JSON: is not an object");
  EXPECT_EQ(error_of(bytes_of(std::string(100000, '['))), "JSON: is nested deeper than 128 levels");
  std::string keys = "{\"extras\":{";
  for (int i = 0; i < 10000; i++) keys += "\"k" + std::to_string(i) + "\":1,";
  EXPECT_EQ(error_of(bytes_of(keys + "\"k\":1}}")), "JSON: an object has more than 8192 keys");
  // Brackets and colons within texts are not structure.
  EXPECT_TRUE(read_bytes(bytes_of("{\"asset\":{\"version\":\"2.0\",\"copyright\":\"" + std::string(200, '[') + "\\\"" +
                                  std::string(9000, ':') + "\"}}")));
}

TEST(Container, VersionsAreChecked) {
  const auto with_asset = [](const std::string& asset) { return error_of(bytes_of("{\"asset\":" + asset + "}")); };
  EXPECT_EQ(error_of(bytes_of("{}")), "asset: version is missing");
  EXPECT_EQ(with_asset("{\"version\":\"1.0\"}"), "asset: version 1.0 is not supported, only 2.0");
  EXPECT_EQ(with_asset("{\"version\":\"2.1\",\"minVersion\":\"2.1\"}"),
            "asset: asks for glTF 2.1 at least, 2.0 is supported");
  EXPECT_EQ(with_asset("{\"version\":\"2.1\"}"), "");
}

TEST(Container, RequiredExtensionsAreNamedAndOptionalOnesLeftOut) {
  Document document = document_of(square());
  document.json["extensionsUsed"] = {"EXT_unknown", "KHR_materials_sheen"};
  document.json["nodes"][0]["extensions"] = {{"EXT_unknown", {{"accessor", 17}}}};
  document.json["nodes"][0]["extras"] = {{"extensions", {{"EXT_unknown", 1}}}};
  Report report;
  const auto read = read_document(glb(document.json, document.buffers[0]), "", report);
  ASSERT_TRUE(read);
  EXPECT_EQ(report.warnings, std::vector<std::string>{"extensions left out, not supported: EXT_unknown"});
  EXPECT_EQ(read->json["extensionsUsed"], Json({"KHR_materials_sheen"}));
  EXPECT_FALSE(read->json["nodes"][0].contains("extensions"));
  EXPECT_EQ(read->json["nodes"][0]["extras"]["extensions"]["EXT_unknown"], 1);

  document.json["extensionsRequired"] = {"EXT_unknown"};
  EXPECT_EQ(error_of(glb(document.json, document.buffers[0])), "extensionsRequired: EXT_unknown is not supported");
}

TEST(Container, MetadataMayBeRequired) {
  Document document = document_of(square());
  document.json["extensionsUsed"] =
      document.json["extensionsRequired"] = {"EXT_mesh_features", "EXT_structural_metadata"};
  Report report;
  const auto read = read_document(glb(document.json, document.buffers[0]), "", report);
  ASSERT_TRUE(read);
  EXPECT_EQ(report.warnings,
            std::vector<std::string>{"extensions left out, not supported: EXT_mesh_features, EXT_structural_metadata"});
  EXPECT_FALSE(read->json.contains("extensionsRequired"));
}

// A limit that any quadratic step would exceed by far.
TEST(Container, ManyNodesAndADeepTreeAreReadInLinearTime) {
  Document document = document_of(square());
  Json& nodes = document.json["nodes"];
  for (int i = 1; i < 20000; i++) {
    nodes[nodes.size() - 1]["children"] = {i};
    nodes.push_back(Json::object());
  }
  for (int i = 20000; i < 60000; i++) nodes.push_back({{"mesh", 0}});
  const auto start = std::chrono::steady_clock::now();
  EXPECT_TRUE(read_again(document));
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
}

}  // namespace
}  // namespace lightwell
