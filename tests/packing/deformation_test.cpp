// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/deformation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "lightwell/gltf/pose.h"
#include "lightwell/packing/opening_budget.h"
#include "lightwell/packing/unpack.h"
#include "lightwell/packing/verify.h"
#include "tests/packing/sample_scenes.h"

namespace lightwell {
namespace {

// What goes with a vertex, as numbers.
using Bend = std::vector<float>;

// Of each vertex of a primitive at rest its joints, weights and displacements.
std::vector<Bend> bends_of(const Document& document) {
  const Json& primitive = document.json["meshes"][0]["primitives"][0];
  const auto count = static_cast<size_t>(
      number(document.json["accessors"][primitive["attributes"]["POSITION"].get<size_t>()], "count", 0));
  std::vector<Bend> bends(count);
  for (const char* semantic : {"JOINTS_0", "WEIGHTS_0"}) {
    const auto data = locate(document, primitive["attributes"][semantic].get<int>());
    EXPECT_TRUE(data) << data.error().message();
    const auto values = read_vectors<4>(*data);
    EXPECT_EQ(values.size(), count);
    for (size_t i = 0; i < count; i++)
      for (const float value : values[i].e)
        bends[i].push_back(std::round(value * 1024) / 1024);  // weights have 16 bits
  }
  for (const Json& target : primitive["targets"])
    for (const char* semantic : {"POSITION", "NORMAL"}) {
      std::vector<Vec3f> values(count);
      if (target.contains(semantic)) values = read_sparse_vectors(document, target[semantic].get<int>(), count).value();
      for (size_t i = 0; i < count; i++) bends[i].insert(bends[i].end(), values[i].e.begin(), values[i].e.end());
    }
  return bends;
}

// The source's vertices within a step of the lattice of a place.
std::vector<size_t> near(const Mesh& mesh, const Vec3f& place) {
  std::vector<size_t> found;
  for (size_t i = 0; i < mesh.positions.size(); i++)
    if (length(mesh.positions[i] - place) < 1e-3f) found.push_back(i);
  return found;
}

// Every vertex of every level bends as a vertex of the file at its place, and in the final level each of those is
// there.
TEST(Deformation, GoesWithTheVerticesOfEveryLevel) {
  const Document source = deforming_document(50);
  Report report;
  const MeshAtRest file = read_at_rest(source, 0, 0, report).value();
  const std::vector<Bend> bends = bends_of(source);
  const Packed packed = pack(source);
  const OpenedPack opened = open(packed.file);
  ASSERT_EQ(opened.primitives().size(), 1u);
  const Verification verification = verify_pack(opened);
  EXPECT_TRUE(verification.errors.empty()) << testing::PrintToString(verification.errors);

  for (const float share : {0.0f, 0.3f, 1.0f}) {
    SCOPED_TRACE(share);
    const Document level = unpack_document(opened, {.share = share}, report).value();
    const Mesh mesh = read_primitive(level, 0, 0, report).value();
    const std::vector<Bend> unpacked = bends_of(level);
    ASSERT_EQ(unpacked.size(), mesh.positions.size());
    std::map<Bend, size_t> there;
    for (size_t i = 0; i < unpacked.size(); i++) {
      const std::vector<size_t> sources = near(file.mesh, mesh.positions[i]);
      EXPECT_TRUE(std::any_of(sources.begin(), sources.end(), [&](size_t s) { return bends[s] == unpacked[i]; })) << i;
      there[unpacked[i]]++;
    }
    if (share < 1) continue;
    std::map<Bend, size_t> wanted;
    for (const Bend& bend : bends) wanted[bend]++;
    EXPECT_EQ(there, wanted);
  }
}

// A corner of the seam's two sides is one place at rest, and two when it bends.
TEST(Deformation, KeepsApartWhatBendsApart) {
  const Document source = deforming_document(50);
  const Packed packed = pack(source);
  const OpenedPack opened = open(packed.file);
  EXPECT_EQ(opened.primitives().at(0).vertices, 51u * 51u + 51u);
}

// The opening of what deforms has the arrays of all vertices, but none twice, and displacements where there are some.
TEST(Deformation, TakesTheBytesThatItMust) {
  const Document source = deforming_document(50);
  const Packed packed = pack(source);
  const OpenedPack opened = open(packed.file);
  const DeformationAccessors& all = opened.primitives().at(0).deformation.value();
  const Json& json = opened.json();
  const auto accessor = [&](int index) { return json["accessors"][static_cast<size_t>(index)]; };
  ASSERT_EQ(all.targets.size(), 2u);
  EXPECT_FALSE(accessor(all.targets[0].at("POSITION")).contains("sparse"));
  EXPECT_TRUE(accessor(all.targets[1].at("POSITION")).contains("sparse"));
  EXPECT_FALSE(accessor(all.targets[1].at("NORMAL")).contains("bufferView"));  // none
  const size_t vertices = 51 * 51 + 51;
  const size_t arrays = vertices * (4 + 8 + 12 + 12);
  // The sparse arrays, and the JSON of one mesh. Did arrays stand twice, there would be 40 KB more.
  constexpr size_t rest = 51 * 16 + 4096;
  const uint64_t coarsest = OpeningBudget::of(1, 0, 1).bytes;
  EXPECT_LT(packed.statistics.opening_bytes, arrays + rest + coarsest);
}

// A skin's weights need not add up to one, and there may be none: the pose is the file's.
TEST(Deformation, KeepsThePoseOfOddWeights) {
  Document source = deforming_document(50);
  const Json& attributes = source.json["meshes"][0]["primitives"][0]["attributes"];
  const Json& accessor = source.json["accessors"][attributes["WEIGHTS_0"].get<size_t>()];
  const Json& view = source.json["bufferViews"][accessor["bufferView"].get<size_t>()];
  auto* weights = reinterpret_cast<float*>(source.buffers[0].data() + view["byteOffset"].get<size_t>());
  for (size_t i = 0; i < 4 * accessor["count"].get<size_t>(); i++) weights[i] *= i % 20 < 4 ? 0 : 3;
  for (size_t joint = 0; joint < 4; joint++) source.json["nodes"][1 + joint]["translation"] = {joint, 0, 0};
  const Packed packed = pack(source);
  Report report;
  const Document finest = unpack_document(open(packed.file), {}, report).value();
  const Scene scene = scene_from_document(finest, "", report).value();
  // Of each vertex the nearest of the file's, in the pose: within a step of the lattice and a 16-bit share of the
  // joints.
  const std::vector<Vec3f>& file = packed.scene.primitives.at(0).mesh.positions;
  for (const Vec3f& place : scene.primitives.at(0).mesh.positions) {
    float nearest = 1;
    for (const Vec3f& other : file) nearest = std::min(nearest, length(other - place));
    ASSERT_LT(nearest, 3e-4f);
  }
  EXPECT_EQ(scene.primitives.at(0).mesh.positions.size(), packed.scene.primitives.at(0).mesh.positions.size());
}

// The pose that a scene is in changes nothing of the stream.
TEST(Deformation, IsTakenAtRest) {
  Document bent = deforming_document(50);
  bent.json["meshes"][0]["weights"] = {1, 0.5};
  const Packed packed = pack(bent), rest = pack(deforming_document(50));
  const RefinedPrimitive a = open(packed.file).primitives().at(0), b = open(rest.file).primitives().at(0);
  EXPECT_EQ(a.bounds.lo, b.bounds.lo);
  EXPECT_EQ(a.bounds.hi, b.bounds.hi);
  EXPECT_NE(packed.scene.bounds().hi, rest.scene.bounds().hi);
}

TEST(Deformation, IsHeldAgainstTheOpening) {
  const Packed packed = pack(deforming_document(50));
  const OpenedPack sound = open(packed.file);
  const std::vector<PackStream> streams = streams_of(sound.reader());
  const DeformationAccessors& all = sound.primitives().at(0).deformation.value();
  const auto accepted = [&](const std::string& pointer, const Json& value) {
    Json json = sound.json();
    EXPECT_TRUE(json.contains(Json::json_pointer(pointer))) << pointer;
    json[Json::json_pointer(pointer)] = value;
    const std::vector<uint8_t> file = rewrite(sound, json, streams);
    const auto opened = try_open(file);
    return opened && verify_pack(*opened).errors.empty();
  };
  const std::string primitive = "/meshes/0/primitives/0/";
  const std::string said = primitive + "extensions/LIGHTWELL_progressive_mesh/deformation/";
  const std::string joints = "/accessors/" + std::to_string(all.attributes.at("JOINTS_0"));
  EXPECT_TRUE(accepted("/asset/version", "2.0"));
  EXPECT_FALSE(accepted(joints + "/count", 99));
  EXPECT_FALSE(accepted(joints + "/componentType", 5123));
  EXPECT_FALSE(accepted(said + "attributes/JOINTS_0", all.attributes.at("WEIGHTS_0")));
  EXPECT_FALSE(accepted(said + "attributes/JOINTS_0", 100000));
  EXPECT_FALSE(accepted(said + "attributes", Json::object()));
  EXPECT_FALSE(accepted(said + "targets", Json::array()));
  EXPECT_FALSE(accepted(said + "targets/1/POSITION", all.targets[0].at("POSITION")));
  EXPECT_FALSE(accepted(primitive + "targets", Json::array()));
}

}  // namespace
}  // namespace lightwell
