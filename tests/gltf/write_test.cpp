// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "lightwell/base/random.h"
#include "lightwell/gltf/accessor.h"
#include "lightwell/gltf/references.h"
#include "lightwell/texture/image_file.h"
#include "tests/gltf/samples.h"
#include "tests/temporary_folder.h"

namespace lightwell {
namespace {

/// Every place that refers to an accessor, and that accessor with the bytes of its buffer view in the place of the
/// view's index, so that two documents compare equal however they are numbered.
std::vector<std::pair<std::string, Json>> accessors_by_place(const Document& document) {
  std::vector<std::pair<std::string, Json>> found;
  for_each_reference(document.json, [&](const Json& value, std::string_view array, const ReferencePlace& place) {
    if (array != "accessors") return;
    Json accessor = document.json["accessors"][value.get<size_t>()];
    const Json& view = document.json["bufferViews"][accessor["bufferView"].get<size_t>()];
    const auto& buffer = document.buffers[view["buffer"].get<size_t>()];
    const auto begin = buffer.begin() + static_cast<ptrdiff_t>(number(view, "byteOffset", 0));
    accessor["bufferView"] = std::vector<uint8_t>(begin, begin + static_cast<ptrdiff_t>(number(view, "byteLength", 0)));
    found.emplace_back(place.text(), std::move(accessor));
  });
  return found;
}

/// A document of random buffers, views, accessors and references to some of them, in every place that knows of
/// accessors.
Document random_document(uint64_t seed) {
  Random random(seed, 0);
  Document document;
  DocumentBuilder builder(document);
  const uint32_t buffers = 1 + random.below(3), views = 1 + random.below(12), accessors = 1 + random.below(12);
  for (uint32_t i = 0; i < buffers; i++) {
    std::vector<uint8_t> bytes(64 + random.below(200));
    for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(random.bits());
    builder.add("buffers", {{"byteLength", bytes.size()}});
    document.buffers.push_back(std::move(bytes));
  }
  for (uint32_t i = 0; i < views; i++) {
    const uint32_t buffer = random.below(buffers), offset = random.below(40);
    const auto room = static_cast<uint32_t>(document.buffers[buffer].size()) - offset;
    builder.add("bufferViews", {{"buffer", buffer}, {"byteOffset", offset}, {"byteLength", 1 + random.below(room)}});
  }
  for (uint32_t i = 0; i < accessors; i++)
    builder.add(
        "accessors",
        {{"bufferView", random.below(views)}, {"componentType", 5121}, {"type", "SCALAR"}, {"count", 1}, {"name", i}});
  const auto any = [&] { return random.below(accessors); };
  builder.add("meshes", {{"primitives", Json::array({{{"attributes", {{"POSITION", any()}, {"_MINE", any()}}},
                                                      {"indices", any()},
                                                      {"targets", Json::array({{{"POSITION", any()}}})}}})}});
  builder.add("nodes",
              {{"mesh", 0}, {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", {{"SCALE", any()}}}}}}}});
  builder.add("skins", {{"joints", {0}}, {"inverseBindMatrices", any()}});
  builder.add("animations",
              {{"samplers", Json::array({{{"input", any()}, {"output", any()}}})}, {"channels", Json::array()}});
  builder.add("images", {{"bufferView", random.below(views)}, {"mimeType", "image/png"}});
  return document;
}

TEST(DropUnused, KeepsAllThatIsReferredTo) {
  for (uint64_t seed = 0; seed < 300; seed++) {
    SCOPED_TRACE(seed);
    const Document before = random_document(seed);
    Document after = before;
    drop_unused(after);
    EXPECT_TRUE(accessors_by_place(after) == accessors_by_place(before));
    EXPECT_EQ(*read_image(after, 0), *read_image(before, 0));
    EXPECT_EQ(after.buffers.size(), after.json["buffers"].size());

    std::set<std::string> referred;  // what is left is referred to
    for_each_reference(after.json, [&](const Json& value, std::string_view array, const ReferencePlace&) {
      referred.insert(std::string(array) + value.dump());
    });
    for (const char* array : {"accessors", "bufferViews", "buffers"})
      for (size_t i = 0; i < after.json[array].size(); i++) EXPECT_TRUE(referred.contains(array + std::to_string(i)));
  }
}

TEST(DropUnused, LeavesNothingOfNothing) {
  Document document;
  DocumentBuilder(document).accessor(std::vector<Vec3f>(3), true);
  drop_unused(document);
  EXPECT_TRUE(document.buffers.empty());
  EXPECT_EQ(document.json, Document().json);
}

/// Small meshes in buffer views of their own, with and without each attribute.
Document document_of_parts(int parts) {
  Document document;
  DocumentBuilder builder(document);
  for (int i = 0; i < parts; i++) {
    Mesh mesh = square();
    for (Vec3f& p : mesh.positions) p[2] = static_cast<float>(i);
    if (i % 2 == 0) mesh.normals.assign(4, Vec3f{{0, 0, 1}});
    if (i % 3 == 0) mesh.texcoords[0].assign(4, Vec2f{{0.5f, static_cast<float>(i)}});
    if (i % 5 == 0) mesh.colors.assign(4, Vec4f{{1, 0, 0, 1}});
    builder.add("meshes", {{"primitives", Json::array({builder.primitive(mesh)})}});
  }
  return document;
}

/// Every place that refers to an accessor, with the bytes of that accessor's elements.
std::vector<std::pair<std::string, std::vector<uint8_t>>> elements_by_place(const Document& document) {
  std::vector<std::pair<std::string, std::vector<uint8_t>>> found;
  for_each_reference(document.json, [&](const Json& value, std::string_view array, const ReferencePlace& place) {
    if (array != "accessors") return;
    const AccessorData data = locate(document, value.get<int>()).value();
    std::vector<uint8_t> bytes;
    for (size_t i = 0; i < data.count; i++) {
      const Bytes element = data.bytes.subspan(i * data.stride, data.type.extent());
      bytes.insert(bytes.end(), element.begin(), element.end());
    }
    found.emplace_back(place.text(), std::move(bytes));
  });
  return found;
}

TEST(ShareBufferViews, KeepsAllMeshes) {
  const Document before = document_of_parts(30);
  Document after = before;
  const size_t bytes = before.buffers[0].size();
  DocumentBuilder(after).primitive(square());  // of no mesh
  share_buffer_views(after);
  Report report;
  after = single_buffer(after, report);
  EXPECT_EQ(after.json["accessors"].size(), before.json["accessors"].size());
  EXPECT_EQ(after.json["bufferViews"].size(), 3u);  // of 12 and 8 bytes a vertex, and indices
  EXPECT_LE(after.buffers[0].size(), bytes);
  EXPECT_EQ(elements_by_place(after), elements_by_place(before));
}

TEST(ShareBufferViews, KeepsWhatItCannotMove) {
  for (uint64_t seed = 0; seed < 300; seed++) {
    SCOPED_TRACE(seed);
    const Document before = random_document(seed);
    Document after = before;
    share_buffer_views(after);
    EXPECT_EQ(elements_by_place(after), elements_by_place(before));
    EXPECT_EQ(*read_image(after, 0), *read_image(before, 0));
  }
}

// The last element of a matrix may lack the padding that the others have.
TEST(ShareBufferViews, ReadsNothingBeyondABuffer) {
  Document document = document_of(square());
  DocumentBuilder builder(document);
  const std::vector<uint8_t> matrices = {1, 2, 0, 0, 3, 4, 0, 0, 5, 6, 0, 0, 7, 8};
  builder.add("accessors", {{"bufferView", append_buffer_view(document, matrices, 0, 34962)},
                            {"componentType", 5121},
                            {"type", "MAT2"},
                            {"count", 2}});
  document.json["meshes"][0]["primitives"][0]["attributes"]["_M"] = document.json["accessors"].size() - 1;
  const auto before = elements_by_place(document);
  share_buffer_views(document);
  EXPECT_EQ(elements_by_place(document), before);
}

// glTF gives no stride to what is not of vertices.
TEST(ShareBufferViews, LeavesArraysThatAnAnimationShares) {
  Document document = document_of(square());
  const int positions = index_of(document.json["meshes"][0]["primitives"][0]["attributes"], "POSITION");
  DocumentBuilder(document).add(
      "animations",
      {{"samplers", Json::array({{{"input", positions}, {"output", positions}}})}, {"channels", Json::array()}});
  share_buffer_views(document);
  const Json& accessor = document.json["accessors"][static_cast<size_t>(positions)];
  EXPECT_FALSE(document.json["bufferViews"][accessor["bufferView"].get<size_t>()].contains("byteStride"));
}

TEST(SingleBuffer, KeepsAllBytesAndTheirAlignment) {
  for (uint64_t seed = 0; seed < 300; seed++) {
    SCOPED_TRACE(seed);
    Document before = random_document(seed);
    drop_unused(before);
    Report report;
    const Document after = single_buffer(before, report);
    ASSERT_EQ(after.buffers.size(), 1u);
    EXPECT_TRUE(accessors_by_place(after) == accessors_by_place(before));
    EXPECT_EQ(*read_image(after, 0), *read_image(before, 0));
    for (size_t i = 0; i < after.json["bufferViews"].size(); i++)
      EXPECT_EQ(whole_number(after.json["bufferViews"][i]["byteOffset"]) % 4,
                whole_number(before.json["bufferViews"][i]["byteOffset"]) % 4);
  }
}

TEST(SingleBuffer, HoldsBytesThatManyViewsShareOnce) {
  Document document;
  DocumentBuilder builder(document);
  builder.buffer_view(std::vector<uint8_t>(100000, 7));
  for (int i = 0; i < 100; i++) {
    document.json["bufferViews"][static_cast<size_t>(i)] = {
        {"buffer", 0}, {"byteOffset", i * 8}, {"byteLength", 90000}};
    builder.add("images", {{"bufferView", i}, {"mimeType", "image/png"}});
  }
  Report report;
  EXPECT_EQ(single_buffer(document, report).buffers[0].size(), 90000u + 99 * 8);
}

TEST(WriteGlb, KeepsTheJsonAndReadsBack) {
  Document document = document_of(square());
  document.json["asset"]["copyright"] = "somebody";
  document.json["nodes"][0]["name"] = "Wand \xc3\xa4";
  document.json["nodes"][0]["extras"] = {{"anything", {1, "two", nullptr, 3.5}}};
  document.json["materials"] =
      Json::array({{{"extensions", {{"KHR_materials_sheen", {{"sheenColorFactor", {1, 0, 0}}}}}}}});
  document.json["extensionsUsed"] = {"KHR_materials_sheen"};
  Report report;
  const auto written = write_glb(document, report);
  ASSERT_TRUE(written);
  EXPECT_EQ(written->size() % 4, 0u);
  const auto again = read_bytes(*written);
  ASSERT_TRUE(again) << again.error().message();
  EXPECT_EQ(again->json, document.json);
  EXPECT_EQ(again->buffers, document.buffers);
  EXPECT_TRUE(report.warnings.empty());
}

TEST(WriteGlb, EmptyDocumentHasNoBinaryChunk) {
  Report report;
  const auto written = write_glb(Document(), report);
  ASSERT_TRUE(written);
  EXPECT_TRUE(read_bytes(*written));
  EXPECT_EQ(written->size(), 20u + 28);
}

TEST(WriteGlb, PutsImagesInsideAndAWhitePixelForMissingOnes) {
  const Image red{1, 1, 3, {255, 0, 0}};
  Document document;
  const TemporaryFolder folder;
  document.folder = folder.path();
  const std::vector<uint8_t> png = write_png(red);
  folder.write("red.png", std::string(png.begin(), png.end()));
  DocumentBuilder builder(document);
  builder.add("images", {{"uri", "red.png"}, {"name", "red"}});
  builder.add("images", {{"uri", "missing.png"}});
  Report report;
  const auto written = write_glb(document, report);
  ASSERT_TRUE(written);
  const auto again = read_bytes(*written);
  ASSERT_TRUE(again);
  EXPECT_EQ(*read_image(*again, 0), png);
  EXPECT_EQ(again->json["images"][0]["name"], "red");
  EXPECT_EQ(again->json["images"][0]["mimeType"], "image/png");
  EXPECT_FALSE(again->json["images"][0].contains("uri"));
  const auto white = read_image_file(*read_image(*again, 1));
  ASSERT_TRUE(white);
  EXPECT_EQ(white->pixels[0], 255);
  EXPECT_EQ(report.warnings,
            std::vector<std::string>{"images[1]: the file missing.png cannot be found; a white pixel stands for it"});
}

}  // namespace
}  // namespace lightwell
