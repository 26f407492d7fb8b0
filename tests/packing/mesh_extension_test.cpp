// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/mesh_extension.h"

#include <gtest/gtest.h>

#include "tests/packing/nasty_json.h"

namespace lightwell {
namespace {

// A document in which these primitives are refined, and others are not.
Json pack_of(const std::vector<RefinedPrimitive>& list) {
  Json json = {{"meshes", Json::array()}};
  for (size_t mesh = 0; mesh < 3; mesh++)
    json["meshes"].push_back({{"primitives", Json::array({Json::object(), Json::object()})}});
  for (const RefinedPrimitive& refined : list)
    json["meshes"][refined.mesh]["primitives"][refined.primitive]["extensions"][mesh_extension] = to_json(refined);
  return json;
}

RefinedPrimitive any_refined(Random& random, size_t mesh, size_t primitive) {
  RefinedPrimitive refined{
      random.below(65536), random.below(1000000), random.below(1000000), {}, random.uniform(), mesh, primitive};
  for (int axis = 0; axis < 3; axis++) {
    refined.bounds.lo[axis] = -random.uniform();
    refined.bounds.hi[axis] = random.uniform();
  }
  return refined;
}

void expect_same(const RefinedPrimitive& a, const RefinedPrimitive& b) {
  EXPECT_EQ(a.stream, b.stream);
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.faces, b.faces);
  EXPECT_EQ(a.bounds.lo, b.bounds.lo);
  EXPECT_EQ(a.bounds.hi, b.bounds.hi);
  EXPECT_EQ(a.error, b.error);
  EXPECT_EQ(a.mesh, b.mesh);
  EXPECT_EQ(a.primitive, b.primitive);
}

TEST(MeshExtension, ReadsWhatItWritesWhereItStands) {
  for (uint64_t i = 0; i < 100; i++) {
    Random random(51, i);
    const std::vector<RefinedPrimitive> list = {any_refined(random, 0, 1), any_refined(random, 2, 0)};
    const auto again = read_refined_primitives(Json::parse(pack_of(list).dump()));
    ASSERT_TRUE(again) << again.error().message();
    ASSERT_EQ(again->size(), list.size());
    for (size_t k = 0; k < list.size(); k++) expect_same((*again)[k], list[k]);
  }
}

// Where it stands may change as well: then another primitive, or none, is refined.
TEST(MeshExtension, ReadsAnyJsonAsAListOrAnError) {
  int refused = 0;
  for (uint64_t i = 0; i < 1000; i++) {
    Random random(52, i);
    Json json = pack_of({any_refined(random, 0, 1)});
    for (uint32_t changes = 1 + random.below(3); changes > 0; changes--) spoil(json, random);
    const auto list = read_refined_primitives(json);
    if (list) continue;
    refused++;
    EXPECT_TRUE(list.error().element.starts_with("meshes[")) << list.error().message();
  }
  EXPECT_GT(refused, 200);  // else the changes would not be nasty
}

TEST(MeshExtension, NamesWhatIsWrong) {
  Random random(53, 0);
  Json json = pack_of({any_refined(random, 2, 1)});
  json["meshes"][2]["primitives"][1]["extensions"][mesh_extension]["bounds"].erase("max");
  EXPECT_EQ(read_refined_primitives(json).error().message(),
            "meshes[2].primitives[1].LIGHTWELL_progressive_mesh.bounds.max: is missing");
}

}  // namespace
}  // namespace lightwell
