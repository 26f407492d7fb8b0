// SPDX-License-Identifier: Apache-2.0
#include "lightwell/gltf/meshopt_vertices.h"

#include <gtest/gtest.h>

#include "lightwell/base/file.h"
#include "tests/gltf/samples.h"

namespace lightwell {
namespace {

constexpr size_t count = 700;  // three blocks, the last not full, nor its last group
constexpr size_t stride = 24;

/// Columns that make an encoder use every channel mode: slopes over the border of bytes and halves, bytes, noise, and
/// bits that lie across that border.
std::vector<uint8_t> plain_elements() {
  ByteWriter writer;
  uint32_t state = 1;
  const auto noise = [&] {
    state = state * 1664525 + 1013904223;
    return state >> 8;
  };
  for (uint32_t i = 0; i < count; i++) {
    writer.u32(i * i * 7919);
    writer.u16(static_cast<uint16_t>(i * 300));
    writer.u16(static_cast<uint16_t>(65535 - i));
    for (const uint32_t byte : {i, 5u, i >> 4, i % 97 == 0 ? 200u : 0u}) writer.u8(static_cast<uint8_t>(byte));
    writer.u32(noise());
    writer.u32(0x40000000 | (noise() & 15) << 13);
    writer.u32(0x3f800000 | (noise() & 255) << 20);
  }
  return writer.release();
}

/// The same, encoded by another's program: encodeVertexBufferLevel(elements, 700, 24, 3, 1) of the npm package
/// meshoptimizer 1.3.0. Its channels have the modes 1, 1, 0, 0, 2 (turned by 3 bits) and 2 (by 4).
std::vector<uint8_t> packed_elements() {
  return *read_file(std::filesystem::path(LIGHTWELL_TEST_DATA) / "gltf" / "meshopt-vertices-v1.bin");
}

TEST(MeshoptVerticesV1, DecodesWhatTheReferenceEncodes) {
  const auto decoded = decode_meshopt_vertices_v1(packed_elements(), count, stride);
  ASSERT_TRUE(decoded);
  EXPECT_EQ(*decoded, plain_elements());
}

TEST(MeshoptVerticesV1, EveryOtherLengthIsRefused) {
  std::vector<uint8_t> packed = packed_elements();
  const std::vector<uint8_t> whole = packed;
  for (size_t size = 0; size < whole.size(); size++)
    ASSERT_FALSE(decode_meshopt_vertices_v1(Bytes(whole).first(size), count, stride)) << size;
  packed.insert(packed.begin() + 100, 0);
  EXPECT_FALSE(decode_meshopt_vertices_v1(packed, count, stride));
}

TEST(MeshoptVerticesV1, AnyBytesAreSafe) {
  const std::vector<uint8_t> whole = packed_elements();
  for (size_t i = 0; i < whole.size(); i++) {
    std::vector<uint8_t> packed = whole;
    packed[i] ^= 0xff;
    const auto decoded = decode_meshopt_vertices_v1(packed, count, stride);
    ASSERT_TRUE(!decoded || decoded->size() == count * stride);
  }
}

TEST(MeshoptVerticesV1, IsReadFromADocument) {
  Document document;
  DocumentBuilder builder(document);
  builder.buffer_view(packed_elements());
  Json packed = document.json["bufferViews"][0];
  packed["mode"] = "ATTRIBUTES";
  packed["count"] = count;
  packed["byteStride"] = stride;
  document.json["bufferViews"][0] = {
      {"buffer", 1}, {"byteLength", count * stride}, {"extensions", {{"KHR_meshopt_compression", packed}}}};
  builder.add("buffers", {{"byteLength", count * stride}});
  builder.add("images", {{"bufferView", 0}});  // so that the view is in use
  const auto read = read_again(document);
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_EQ(*read_image(*read, 0), plain_elements());
}

}  // namespace
}  // namespace lightwell
