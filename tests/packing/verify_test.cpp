// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/verify.h"

#include <gtest/gtest.h>

#include <map>

#include "lightwell/packing/unpack.h"
#include "lightwell/scene/builtin.h"
#include "lightwell/transport/fetch.h"
#include "tests/packing/spoilt_packs.h"

namespace lightwell {
namespace {

Document room() { return find_builtin_scene("box-small")->make(1); }

// The JSON changed in one digit, in a file whose checks are right otherwise.
TEST(VerifyPack, HoldsTheJsonAgainstTheStreams) {
  const Packed packed = pack(room());
  const OpenedPack sound = open(packed.file);
  const std::vector<PackStream> streams = streams_of(sound.reader());
  const auto errors = [&](const std::string& pointer, const Json& value) {
    Json json = sound.json();
    EXPECT_TRUE(json.contains(Json::json_pointer(pointer))) << pointer;
    json[Json::json_pointer(pointer)] = value;
    const std::vector<uint8_t> file = rewrite(sound, json, streams);
    const auto opened = try_open(file);
    return opened ? verify_pack(*opened).errors.size() : 1;
  };
  EXPECT_EQ(errors("/asset/version", "2.0"), 0u);
  const std::string grid = "/extensions/LIGHTWELL_light_grids/grids/0/";
  const RefinedPrimitive& refined = sound.primitives().front();
  const std::string primitive =
      "/meshes/" + std::to_string(refined.mesh) + "/primitives/" + std::to_string(refined.primitive);
  const std::string mesh = primitive + "/extensions/LIGHTWELL_progressive_mesh/";
  EXPECT_EQ(errors(grid + "min/1", 7.5), 1u);
  EXPECT_EQ(errors(grid + "cell/0", 0.25), 1u);
  EXPECT_EQ(errors(grid + "nodes/2", 99), 1u);
  EXPECT_EQ(errors(grid + "codec", 0), 1u);
  EXPECT_EQ(errors(grid + "normalOffset", 0.25), 1u);
  EXPECT_EQ(errors(grid + "stream", 1), 1u);
  EXPECT_EQ(errors(mesh + "vertices", 1), 1u);
  EXPECT_EQ(errors(mesh + "error", 1000), 1u);
  EXPECT_EQ(errors(mesh + "bounds/max/0", -1000), 1u);
  EXPECT_EQ(errors("/extensions/LIGHTWELL_streams/version", 1), 1u);
  EXPECT_EQ(errors("/scenes/0/nodes", Json::array()), 1u);  // nothing is shown
  EXPECT_EQ(errors("/extensions/LIGHTWELL_streams/id", "0"), 1u);
  EXPECT_EQ(errors("/extensions/LIGHTWELL_streams/exposure", 1e300), 1u);

  const Json& json = sound.json();
  const Json& attributes = json[Json::json_pointer(primitive + "/attributes")];
  const std::string positions = "/accessors/" + attributes["POSITION"].dump();
  const std::string indices = "/accessors/" + json[Json::json_pointer(primitive + "/indices")].dump();
  EXPECT_EQ(errors(primitive + "/attributes/POSITION", attributes["NORMAL"]), 1u);
  EXPECT_EQ(errors(primitive + "/attributes", {{"POSITION", attributes["POSITION"]}}), 1u);
  EXPECT_EQ(errors(positions + "/count", 3), 1u);
  EXPECT_EQ(errors(positions + "/type", "VEC2"), 1u);
  EXPECT_EQ(errors(positions + "/componentType", 5125), 1u);
  EXPECT_EQ(errors(positions + "/max/0", 1000), 1u);
  EXPECT_EQ(errors(indices + "/componentType", 5121), 1u);
  EXPECT_EQ(errors(indices + "/count", 3), 1u);
}

TEST(VerifyPack, HoldsLevelsAgainstTheirStreams) {
  Document document = room();
  add_noise(document, 512);
  const Packed packed = pack(std::move(document));
  const OpenedPack sound = open(packed.file);
  const auto message = [&](auto change) {
    Json json = sound.json();
    Json& refined = json["textures"][0]["extensions"][texture_extension];
    change(refined);
    const std::vector<uint8_t> file = rewrite(sound, json, streams_of(sound.reader()));
    const auto opened = try_open(file);
    if (!opened) return opened.error().message();
    const auto errors = verify_pack(*opened).errors;
    return errors.empty() ? std::string() : errors[0];
  };
  EXPECT_EQ(message([](Json&) {}), "");
  EXPECT_EQ(message([](Json& refined) { refined.erase("levels"); }), "");  // who does not know levels loses nothing
  const std::string stream = std::to_string(sound.textures()[0].stream);
  EXPECT_NE(message([](Json& refined) { refined["levels"][0]["width"] = 64; }), "");
  EXPECT_NE(message([](Json& refined) { refined["levels"][0]["stream"] = 0; }), "");
  EXPECT_NE(message([](Json& refined) { refined["levels"][0]["stream"] = 9999; }), "");
  EXPECT_EQ(message([](Json& refined) {
              refined["levels"][0] = {{"stream", refined["stream"]}, {"width", 512}, {"height", 512}};
            }),
            "JSON: " + std::string(texture_extension) + ": stream " + stream + " is a level and an image");
  EXPECT_EQ(message([](Json& refined) {
              const Json level = {{"stream", refined["stream"]}, {"width", 512}, {"height", 512}};
              refined["levels"].insert(refined["levels"].begin(), level);
            }),
            "JSON: textures[0]: its levels are not smaller images of it, from coarse to fine");
}

TEST(VerifyPack, FindsEveryDamagedByte) {
  const Packed packed = pack(room());
  Random random(9, 0);
  for (int i = 0; i < 40; i++) {
    std::vector<uint8_t> damaged = packed.file;
    const size_t at = random.below(static_cast<uint32_t>(damaged.size()));
    damaged[at] = static_cast<uint8_t>(damaged[at] ^ 1u << random.below(8));
    const size_t padding = packed.file.size() - 3;  // up to three bytes behind the last stream mean nothing
    if (at >= padding) continue;
    const auto opened = try_open(damaged);
    EXPECT_TRUE(!opened || !verify_pack(*opened).errors.empty()) << "byte " << at;
  }
}

// What a client has of a pack in the end, by stream.
struct Received {
  struct MeshBuffers {
    std::vector<uint8_t> positions, indices;
    uint32_t vertices = 0, faces = 0;
  };
  std::map<uint32_t, MeshBuffers> meshes;
  std::map<uint32_t, std::vector<uint8_t>> images;
  size_t grids = 0;

  void apply(const Update& update) {
    if (const auto* mesh = std::get_if<MeshUpdate>(&update)) {
      meshes[mesh->asset].positions.resize(size_t(12) * mesh->vertices);
      meshes[mesh->asset].indices.resize(size_t(12) * mesh->faces);
    } else if (const auto* range = std::get_if<RangeUpdate>(&update)) {
      if (range->buffer != 0 && range->buffer != RangeUpdate::indices) return;
      auto& buffers = meshes[range->asset];
      auto& target = range->buffer == 0 ? buffers.positions : buffers.indices;
      std::copy(range->data.begin(), range->data.end(), target.begin() + static_cast<ptrdiff_t>(range->offset));
    } else if (const auto* draw = std::get_if<DrawUpdate>(&update)) {
      meshes[draw->asset].vertices = draw->vertices;
      meshes[draw->asset].faces = draw->faces;
    } else if (const auto* image = std::get_if<TextureUpdate>(&update)) {
      images[image->asset].assign(image->file.begin(), image->file.end());
    } else if (std::get_if<LightUpdate>(&update)) {
      grids++;
    }
  }
};

template <typename T>
std::vector<uint8_t> bytes_of(const std::vector<T>& values) {
  const auto* begin = reinterpret_cast<const uint8_t*>(values.data());
  return {begin, begin + values.size() * sizeof(T)};
}

// Everything that shows a pack succeeds with it, and shows the same.
void expect_shown(const OpenedPack& pack, const std::vector<uint8_t>& file) {
  Report report;
  for (const float share : {0.0f, 0.5f}) {
    const auto coarse = unpack_document(pack, {.share = share}, report);
    ASSERT_TRUE(coarse) << coarse.error().message();
    EXPECT_TRUE(scene_from_document(*coarse, "", report));
  }
  const auto document = unpack_document(pack, {}, report);
  ASSERT_TRUE(document) << document.error().message();
  EXPECT_TRUE(scene_from_document(*document, "", report));
  const auto glb = write_glb(*document, report);
  ASSERT_TRUE(glb) << glb.error().message();
  EXPECT_TRUE(read_document(*glb, {}, report));
  for (const GridDescription& grid : pack.grids()) EXPECT_TRUE(unpack_light(pack.reader(), grid.stream, {}));

  Received received;
  Client client{ClientOptions{}};
  const auto line = memory_transport(file);
  const auto outcome = fetch(client, *line, [&](const Update& update) { received.apply(update); });
  ASSERT_TRUE(outcome) << outcome.error().message();
  EXPECT_EQ(received.grids > 0, !pack.grids().empty());
  EXPECT_EQ(received.meshes.size(), pack.primitives().size());
  for (const RefinedPrimitive& refined : pack.primitives()) {
    const auto mesh =
        read_primitive(*document, static_cast<int>(refined.mesh), static_cast<int>(refined.primitive), report);
    ASSERT_TRUE(mesh) << mesh.error().message();
    EXPECT_EQ(received.meshes[refined.stream].vertices, refined.vertices);
    EXPECT_EQ(received.meshes[refined.stream].positions, bytes_of(mesh->positions));
    EXPECT_EQ(received.meshes[refined.stream].indices, bytes_of(mesh->faces));
  }
  for (const RefinedTexture& refined : pack.textures())
    EXPECT_EQ(received.images[refined.stream], read_image(*document, static_cast<int>(refined.source)).value());
}

// Changes a sound pack in so many ways.
void expect_only_what_can_be_shown_is_accepted(const Packed& packed, int edits) {
  const OpenedPack sound = open(packed.file);
  ASSERT_EQ(sound.primitives().size(), 1u);
  ASSERT_TRUE(verify_pack(sound).errors.empty()) << testing::PrintToString(verify_pack(sound).errors);
  expect_shown(sound, packed.file);
  const std::vector<PackStream> streams = streams_of(sound.reader());
  int accepted = 0;
  for (uint64_t i = 0; i < static_cast<uint64_t>(edits); i++) {
    SCOPED_TRACE(i);
    Random random(31, i);
    Json json = sound.json();
    std::vector<PackStream> changed = streams;
    if (i % 4 == 0)
      spoil(changed, random);
    else
      for (uint32_t changes = 1 + random.below(2); changes > 0; changes--) spoil(json, random);
    const std::vector<uint8_t> file = rewrite(sound, json, std::move(changed));
    const auto opened = try_open(file);
    if (!opened || !verify_pack(*opened).errors.empty()) continue;
    accepted++;
    expect_shown(*opened, file);
    ASSERT_FALSE(testing::Test::HasFailure()) << json.dump(1);
  }
  // Names, factors and what a row of a table repeats wrongly are of both sorts; else the changes would prove nothing.
  EXPECT_GT(accepted, edits / 20);
  EXPECT_LT(accepted, edits / 2);
}

TEST(VerifyPack, AcceptsOnlyWhatEverythingCanShow) {
  const Packed packed = pack_of_everything();
  ASSERT_EQ(open(packed.file).textures().size(), 1u);
  expect_only_what_can_be_shown_is_accepted(packed, 400);
}

TEST(VerifyPack, AcceptsOnlyWhatBendsEverywhere) {
  const Packed packed = pack(deforming_document(50));
  expect_only_what_can_be_shown_is_accepted(packed, 300);
}

}  // namespace
}  // namespace lightwell
