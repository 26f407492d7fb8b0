// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/mesh_extension.h"

#include <gtest/gtest.h>

#include "tests/packing/extension_properties.h"

namespace lightwell {
namespace {

RefinedPrimitive any_refined(Random& random, size_t mesh, size_t primitive) {
  RefinedPrimitive refined;
  refined.stream = random.below(65536);
  refined.region = random.below(3);
  refined.faces = random.below(1000000);
  if (refined.region == 0) {
    refined.vertices = random.below(1000000);
    refined.error = random.uniform();
  }
  refined.mesh = mesh;
  refined.primitive = primitive;
  for (int axis = 0; axis < 3; axis++) {
    refined.bounds.lo[axis] = -random.uniform();
    refined.bounds.hi[axis] = random.uniform();
  }
  return refined;
}

// A document in which some primitives are refined, and others are not.
struct Meshes {
  using Value = std::vector<RefinedPrimitive>;
  static constexpr const char* place = "meshes[";
  static Value any(Random& random) { return {any_refined(random, 0, 1), any_refined(random, 2, 0)}; }
  static Json pack_of(const Value& list) {
    Json json = {{"meshes", Json::array()}};
    for (size_t mesh = 0; mesh < 3; mesh++)
      json["meshes"].push_back({{"primitives", Json::array({Json::object(), Json::object()})}});
    for (const RefinedPrimitive& refined : list)
      json["meshes"][refined.mesh]["primitives"][refined.primitive]["extensions"][mesh_extension] = to_json(refined);
    return json;
  }
  static Result<Value> read(const Json& json) { return read_refined_primitives(json); }
};

TEST(MeshExtension, ReadsWhatItWritesWhereItStands) { expect_reads_what_it_writes<Meshes>(51); }
TEST(MeshExtension, ReadsAnyJsonAsAListOrAnError) { expect_reads_any_json_or_an_error<Meshes>(52); }

TEST(MeshExtension, NamesWhatIsWrong) {
  Random random(53, 0);
  Json json = Meshes::pack_of({any_refined(random, 2, 1)});
  json["meshes"][2]["primitives"][1]["extensions"][mesh_extension]["bounds"].erase("max");
  EXPECT_EQ(read_refined_primitives(json).error().message(),
            "meshes[2].primitives[1].LIGHTWELL_progressive_mesh.bounds.max: is missing");
}

}  // namespace
}  // namespace lightwell
