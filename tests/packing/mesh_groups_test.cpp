// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/mesh_groups.h"

#include <gtest/gtest.h>

#include <map>

#include "lightwell/packing/pack_meshes.h"
#include "lightwell/packing/unpack.h"
#include "lightwell/packing/verify.h"
#include "tests/mesh/knot.h"
#include "tests/mesh/level.h"
#include "tests/mesh/shapes.h"
#include "tests/packing/sample_scenes.h"

namespace lightwell {
namespace {

/// Parts of a mesh, by face.
template <typename PartOf>
std::vector<Mesh> parts_of(const Mesh& whole, size_t count, const PartOf& part_of) {
  std::vector<std::vector<Face>> faces(count);
  for (size_t f = 0; f < whole.faces.size(); f++) faces[part_of(f)].push_back(whole.faces[f]);
  std::vector<Mesh> parts;
  for (std::vector<Face>& of_part : faces) parts.push_back(mesh_of_faces(whole, std::move(of_part)));
  return parts;
}

/// One glTF mesh with a primitive, of a material of its own, for each.
Document document_of(const std::vector<Mesh>& primitives) {
  Document document;
  DocumentBuilder builder(document);
  Json mesh;
  for (const Mesh& of_primitive : primitives) {
    Json primitive = builder.primitive(of_primitive);
    primitive["material"] = builder.add("materials", Json::object());
    mesh["primitives"].push_back(std::move(primitive));
  }
  builder.add("nodes", {{"mesh", builder.add("meshes", std::move(mesh))}});
  document.json["scenes"] = Json::array({{{"nodes", {0}}}});
  document.json["scene"] = 0;
  return document;
}

Mesh smooth_knot(int along, int round) {
  Mesh mesh = knot(along, round);
  mesh.normals = smooth_normals(mesh);
  return mesh;
}

/// A knot in sixteen bands of four materials.
std::vector<Mesh> banded_knot() {
  const Mesh whole = smooth_knot(160, 60);
  return parts_of(whole, 4, [&](size_t f) { return 16 * f / whole.faces.size() % 4; });
}

Mesh moved(Mesh mesh, const Vec3f& by, float scale = 1) {
  for (Vec3f& p : mesh.positions) p = p * scale + by;
  return mesh;
}

std::vector<MeshGroup> groups_of(const std::vector<Mesh>& primitives, const PackOptions& options = {},
                                 const std::vector<ClientLamp>& lamps = {}) {
  Report report;
  const Scene scene = scene_from_document(document_of(primitives), "test", report).value();
  return mesh_groups(scene, position_errors(scene, {}, options).most, lamps);
}

TEST(MeshGroups, WhatTouchesIsTogetherAndWhatIsSmall) {
  EXPECT_EQ(groups_of(banded_knot()), (std::vector<MeshGroup>{{0, 1, 2, 3}}));
  const Mesh small = smooth_knot(40, 20), large = smooth_knot(600, 120);
  ASSERT_GT(large.positions.size(), 65536u);
  const Vec3f away = Vec3f::filled(20);
  EXPECT_EQ(groups_of({small, moved(small, away), large, moved(large, away * 3.0f)}),
            (std::vector<MeshGroup>{{0, 1}, {2}, {3}}));
  const std::vector<Mesh> halves = parts_of(large, 2, [&](size_t f) { return 2 * f / large.faces.size(); });
  ASSERT_GT(halves[0].positions.size() + halves[1].positions.size(), 65536u);
  EXPECT_EQ(groups_of({small, halves[0], halves[1]}), (std::vector<MeshGroup>{{0}, {1, 2}}));
}

TEST(MeshGroups, OtherAttributesAndWhatIsTiny) {
  const Mesh plain = smooth_knot(40, 20);
  Mesh textured = plain;
  textured.texcoords[0].resize(plain.positions.size());
  const Vec3f away = Vec3f::filled(5);
  EXPECT_EQ(groups_of({plain, textured, moved(plain, away), moved(textured, away)}),
            (std::vector<MeshGroup>{{0, 2}, {1, 3}}));
  EXPECT_EQ(groups_of({plain, moved(plain, {}, 1e-5f), moved(plain, away)}), (std::vector<MeshGroup>{{0, 2}, {1}}));
}

// The lattice of a group has 21 bits over all of it.
TEST(MeshGroups, APositionErrorThatIsAskedForHolds) {
  const Mesh small = smooth_knot(40, 20), far = moved(small, {}, 300);
  PackOptions options;
  options.position_error = 1e-5f * max_component(small.bounds().size());
  EXPECT_EQ(groups_of({small, far}), (std::vector<MeshGroup>{{0, 1}}));
  EXPECT_EQ(groups_of({small, far}, options), (std::vector<MeshGroup>{{0}, {1}}));
}

// A client knows the surface of a lamp by a vertex of it, the first at every level.
TEST(MeshGroups, WhatALampNamesIsAlone) {
  const Mesh mesh = smooth_knot(40, 20);
  const Vec3f away = Vec3f::filled(5);
  ClientLamp lamp;
  lamp.luminaire = {.kind = LuminaireId::Kind::surface, .node = 0, .primitive = 1};
  EXPECT_EQ(groups_of({mesh, moved(mesh, away), moved(mesh, -away)}, {}, {lamp}),
            (std::vector<MeshGroup>{{0, 2}, {1}}));
}

TEST(MeshGroups, AreOneStreamThatEndsInEachPrimitive) {
  const std::vector<Mesh> primitives = banded_knot();
  const Packed packed = pack(document_of(primitives));
  const OpenedPack opened = open(packed.file);
  const Verification verification = verify_pack(opened);
  ASSERT_TRUE(verification.errors.empty()) << testing::PrintToString(verification.errors);
  ASSERT_EQ(opened.primitives().size(), 4u);
  for (size_t region = 0; region < 4; region++) {
    EXPECT_EQ(opened.primitives()[region].stream, opened.primitives()[0].stream);
    EXPECT_EQ(opened.primitives()[region].region, region);
    EXPECT_EQ(opened.primitives()[region].faces, primitives[region].faces.size());
  }
  Report report;
  const Scene scene = scene_from_document(unpack_document(opened, {}, report).value(), "again", report).value();
  ASSERT_EQ(scene.primitives.size(), 4u);
  for (size_t i = 0; i < 4; i++) {
    EXPECT_EQ(scene.primitives[i].material, static_cast<int>(i));
    EXPECT_EQ(scene.primitives[i].mesh.faces.size(), primitives[i].faces.size());
    EXPECT_EQ(scene.primitives[i].mesh.positions.size(), primitives[i].positions.size());
  }
}

// What a viewer shows: the knot is closed at the coarsest level, at the finest and between.
TEST(MeshGroups, NoCrackOpensBetweenPrimitives) {
  const Packed packed = pack(document_of(banded_knot()));
  const OpenedPack opened = open(packed.file);
  for (const float share : {0.0f, 0.1f, 0.3f, 0.7f, 1.0f}) {
    Report report;
    const Scene scene =
        scene_from_document(unpack_document(opened, {.share = share}, report).value(), "again", report).value();
    std::map<std::pair<Vec3f, Vec3f>, int> sides;
    size_t faces = 0;
    for (const Primitive& primitive : scene.primitives)
      for (const Face& face : primitive.mesh.faces) {
        faces++;
        for (size_t k = 0; k < 3; k++) {
          const Vec3f a = primitive.mesh.positions[face[k]], b = primitive.mesh.positions[face[(k + 1) % 3]];
          sides[a < b ? std::pair(a, b) : std::pair(b, a)] += a < b ? 1 : -1;
        }
      }
    for (const auto& [edge, open] : sides) EXPECT_EQ(open, 0);
    EXPECT_GT(faces, 10u);
  }
}

// The outlines of a region, at all levels, lie in the bounds by which a viewer leaves it out.
TEST(MeshGroups, BoundsHoldEveryLevel) {
  const Packed packed = pack(document_of(banded_knot()));
  const OpenedPack opened = open(packed.file);
  for (const float share : {0.0f, 0.05f, 0.1f, 0.2f, 0.5f, 1.0f}) {
    Report report;
    const Scene scene =
        scene_from_document(unpack_document(opened, {.share = share}, report).value(), "again", report).value();
    for (size_t i = 0; i < 4; i++)
      for (const Vec3f& p : scene.primitives[i].mesh.positions)
        for (int axis = 0; axis < 3; axis++) {
          EXPECT_GE(p[axis], opened.primitives()[i].bounds.lo[axis]);
          EXPECT_LE(p[axis], opened.primitives()[i].bounds.hi[axis]);
        }
  }
}

/// The same faces from behind.
Mesh turned(Mesh mesh) {
  for (Face& face : mesh.faces) std::swap(face[1], face[2]);
  for (Vec3f& normal : mesh.normals) normal = -normal;
  return mesh;
}

// A coat in another material, or a back: an edge of four faces would stay while all else goes. A decal of few faces
// may.
TEST(MeshGroups, WhatLiesOnOthersIsAlone) {
  const std::vector<Mesh> bands = banded_knot();
  EXPECT_EQ(groups_of({bands[0], bands[1], bands[2], bands[3], bands[1]}), (std::vector<MeshGroup>{{0, 1, 2, 3}, {4}}));
  EXPECT_EQ(groups_of({bands[0], bands[1], bands[2], bands[3], turned(bands[1])}),
            (std::vector<MeshGroup>{{0, 1, 2, 3}, {4}}));
  Mesh decal = bands[1];
  const Mesh apart = moved(bands[0], Vec3f::filled(20));
  append(decal, apart);
  decal.normals.insert(decal.normals.end(), apart.normals.begin(), apart.normals.end());
  decal.faces.erase(decal.faces.begin() + 40, decal.faces.begin() + static_cast<ptrdiff_t>(bands[1].faces.size()));
  EXPECT_EQ(groups_of({bands[0], bands[1], decal}), (std::vector<MeshGroup>{{0, 1, 2}}));
}

TEST(MeshGroups, ADecalIsThereAtTheEnd) {
  std::vector<Mesh> primitives = banded_knot();
  Mesh decal = mesh_of_faces(primitives[1], {primitives[1].faces.begin(), primitives[1].faces.begin() + 30});
  const Mesh apart = moved(smooth_knot(80, 40), Vec3f::filled(20));
  append(decal, apart);
  decal.normals.insert(decal.normals.end(), apart.normals.begin(), apart.normals.end());
  primitives.push_back(decal);
  const Packed packed = pack(document_of(primitives));
  const OpenedPack opened = open(packed.file);
  const Verification verification = verify_pack(opened);
  ASSERT_TRUE(verification.errors.empty()) << testing::PrintToString(verification.errors);
  ASSERT_EQ(opened.primitives().size(), 5u);
  EXPECT_EQ(opened.primitives()[4].stream, opened.primitives()[0].stream);
  Report report;
  const Scene scene = scene_from_document(unpack_document(opened, {}, report).value(), "again", report).value();
  for (size_t i = 0; i < 5; i++) EXPECT_EQ(scene.primitives[i].mesh.faces.size(), primitives[i].faces.size());
}

// A small primitive keeps its form beside a large one whatever error is asked for.
TEST(MeshGroups, ALargePositionErrorKeepsForms) {
  const Mesh ball = smooth_knot(40, 20), large = moved(smooth_knot(160, 60), {}, 100);
  Report report;
  const Scene scene = scene_from_document(document_of({ball, large}), "test", report).value();
  PackOptions options;
  options.position_error = 0.5f;
  const float side = max_component(ball.bounds().size());
  EXPECT_LE(position_errors(scene, {}, options).wanted[0], side / 128);
  EXPECT_EQ(position_errors(scene, {}, options).wanted[1], 0.5f);
}

TEST(MeshGroups, VerifyFindsRegionsThatAreNamedWrongly) {
  const Packed packed = pack(document_of(banded_knot()));
  const OpenedPack opened = open(packed.file);
  const auto errors = [&](const auto& edit) {
    Json json = opened.json();
    std::vector<Json*> said;
    for (Json& primitive : json["meshes"][0]["primitives"]) said.push_back(&primitive["extensions"]);
    edit(said);
    std::vector<PackStream> streams = streams_of(opened.reader());
    const std::vector<uint8_t> file = rewrite(opened, json, std::move(streams));
    return !verify_pack(open(file)).errors.empty();
  };
  using Said = std::vector<Json*>;
  EXPECT_FALSE(errors([](const Said&) {}));
  EXPECT_TRUE(errors([](const Said& said) { (*said[1])[mesh_extension]["region"] = 2; }));
  EXPECT_TRUE(errors([](const Said& said) { (*said[3])[mesh_extension]["region"] = 4; }));
  EXPECT_TRUE(errors([](const Said& said) { std::swap(*said[1], *said[2]); }));
  EXPECT_TRUE(errors([](const Said& said) { (*said[2])[mesh_extension]["faces"] = 7; }));
  EXPECT_TRUE(errors([](const Said& said) { said[3]->erase(mesh_extension); }));
  Json apart = opened.json();
  Json& primitives = apart["meshes"][0]["primitives"];
  apart["meshes"].push_back({{"primitives", {primitives[3]}}});
  primitives.erase(3);
  const std::vector<uint8_t> in_two_meshes = rewrite(opened, apart, streams_of(opened.reader()));
  EXPECT_NE(testing::PrintToString(verify_pack(open(in_two_meshes)).errors).find("belong to two meshes"),
            std::string::npos);
  EXPECT_TRUE(errors([](const Said& said) {
    (*said[1])[mesh_extension]["bounds"]["max"][0] =
        (*said[1])[mesh_extension]["bounds"]["max"][0].get<double>() - 0.05;
  }));
}

}  // namespace
}  // namespace lightwell
