// SPDX-License-Identifier: Apache-2.0
//
// Scenes of very many parts: merged in the pack, taken apart again (LIGHTWELL_parts).
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "lightwell/asset/parts_asset.h"
#include "lightwell/base/gzip.h"
#include "lightwell/packing/parts_file.h"
#include "lightwell/packing/unpack.h"
#include "lightwell/packing/verify.h"
#include "tests/mesh/shapes.h"
#include "tests/packing/sample_scenes.h"
#include "tests/packing/spoilt_packs.h"

namespace lightwell {
namespace {

/// A box with a corner at the origin, each side with vertices of its own.
Mesh box(const Vec3f& size) {
  Mesh mesh;
  for (int axis = 0; axis < 3; axis++)
    for (const int side : {0, 1}) {
      const auto first = static_cast<uint32_t>(mesh.positions.size());
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      for (const auto& [a, b] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
        Vec3f corner{}, normal{};
        corner[axis] = static_cast<float>(side) * size[axis];
        corner[u] = static_cast<float>(a) * size[u];
        corner[v] = static_cast<float>(b) * size[v];
        normal[axis] = side == 1 ? 1 : -1;
        mesh.positions.push_back(corner);
        mesh.normals.push_back(normal);
      }
      for (const auto& [second, third] : {std::pair{1u, 2u}, {2u, 3u}})
        mesh.faces.push_back({first, first + (side == 1 ? second : third), first + (side == 1 ? third : second)});
    }
  return mesh;
}

/// A building of boxes that touch, `count` of them, of three materials, in storeys: nodes with names and extras under
/// others that turn, stretch and mirror them.
class Building {
 public:
  explicit Building(size_t count) : builder_(document_) {
    for (int i = 0; i < 3; i++)
      builder_.add("materials", {{"name", "material " + std::to_string(i)}});  // but for it alike
    const std::vector<Json> storeys = {{{"name", "ground"}},
                                       {{"name", "first"}, {"translation", {0, 3, 0}}, {"scale", {-1, 1, 1}}},
                                       {{"name", "second"}, {"rotation", {0, 0.6, 0, 0.8}}, {"scale", {1, 2, 0.5}}}};
    for (const Json& storey : storeys) roots_.push_back(node(storey));
    for (size_t i = 0; i < count; i++) {
      const double at = static_cast<double>(i / 3);
      child(static_cast<int>(i % 3), {{"name", "box " + std::to_string(i)},
                                      {"mesh", mesh(static_cast<int>(i / 2 % 3), "mesh " + std::to_string(i))},
                                      {"extras", {{"id", i}}},
                                      {"translation", {at, 0.1, 0}}});
    }
  }

  int mesh(int material, const std::string& name) {
    Json primitive = builder_.primitive(box({{1, 1 + 0.25f * static_cast<float>(material), 1}}));
    primitive["material"] = material;
    primitive["extras"] = {{"of", name}};
    return builder_.add("meshes", {{"name", name}, {"primitives", Json::array({primitive})}});
  }
  int node(const Json& json) { return builder_.add("nodes", json); }
  int child(int of, const Json& json) {
    const int added = node(json);
    document_.json["nodes"][static_cast<size_t>(of)]["children"].push_back(added);
    return added;
  }
  void root(int node) { roots_.push_back(node); }

  Document finish() {
    builder_.add("scenes", {{"nodes", roots_}});
    return document_;
  }
  DocumentBuilder& builder() { return builder_; }
  Json& json() { return document_.json; }

 private:
  Document document_;
  DocumentBuilder builder_;
  std::vector<int> roots_;
};

Document apart(const OpenedPack& pack, const MeshLevel& level = {}) {
  Report report;
  Document document = unpack_document(pack, level, report).value();
  const auto done = unpack_parts(pack, document);
  EXPECT_TRUE(done) << done.error().message();
  return document;
}

Scene scene_of(Document document) {
  Report report;
  return scene_from_document(std::move(document), "", report, Vec3d{}).value();
}

std::string name_of_node(const Scene& scene, const Instance& instance) {
  return text(scene.document.json["nodes"][static_cast<size_t>(instance.node)], "name");
}

/// A face from that corner on from which it is least: its winding counts, where it begins does not.
std::array<Vec3f, 3> from_its_least(const std::array<Vec3f, 3>& face) {
  return std::min({face, {face[1], face[2], face[0]}, {face[2], face[0], face[1]}});
}

/// The corners of each face in scene space, of each named node.
using Corners = std::vector<std::array<Vec3f, 3>>;
std::map<std::string, Corners> faces_by_node(const Scene& scene) {
  std::map<std::string, Corners> found;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.primitives[static_cast<size_t>(instance.primitive)].mesh;
    Corners& corners = found[name_of_node(scene, instance)];
    for (const Face& f : mesh.faces) {
      std::array<Vec3f, 3> face;
      for (size_t i = 0; i < 3; i++) face[i] = instance.to_scene.point(mesh.positions[f[i]]);
      corners.push_back(face);
    }
  }
  return found;
}

/// Corners to the nearest step of a lattice, so that both sides can be sorted alike, and sorts them.
void round_to(std::map<std::string, Corners>& faces, float step) {
  for (auto& [name, corners] : faces) {
    for (auto& face : corners) {
      for (Vec3f& p : face)
        for (int i = 0; i < 3; i++) p[i] = std::round(p[i] / step) * step + 0.0f;
      face = from_its_least(face);
    }
    std::sort(corners.begin(), corners.end());
  }
}

const Json& named(const Json& json, const char* array, const std::string& name) {
  static const Json none;
  for (const Json& element : member(json, array))
    if (text(element, "name") == name) return element;
  return none;
}

TEST(Parts, OfASceneOfFewStayMeshesOfTheirOwn) {
  const Packed packed = pack(Building(32).finish());
  EXPECT_FALSE(open(packed.file).parts());
  EXPECT_EQ(open(packed.file).json()["meshes"].size(), 32u);
}

TEST(Parts, OfASceneOfManyAreOneMeshWithAPrimitiveAMaterial) {
  const Packed packed = pack(Building(600).finish());
  const OpenedPack opened = open(packed.file);
  ASSERT_TRUE(opened.parts());
  EXPECT_EQ(opened.json()["nodes"].size(), 1u);
  EXPECT_EQ(opened.json()["meshes"].size(), 1u);
  EXPECT_EQ(opened.json()["meshes"][0]["primitives"].size(), 3u);
  // As the design asks of the first request (streaming.md); 600 primitives with JSON of their own take ten times that.
  EXPECT_LT(packed.statistics.opening_bytes, 64u << 10);
  EXPECT_TRUE(verify_pack(opened).errors.empty());
}

// A lattice of 21 bits over all would make boxes of them.
TEST(Parts, ThatAreTinyBesideTheOthersKeepTheirForm) {
  Building building(0);
  building.root(building.node({{"name", "floor"}, {"mesh", building.mesh(0, "floor")}, {"scale", {100, 1, 100}}}));
  for (int i = 0; i < 80; i++) {
    Json primitive = building.builder().primitive(seamed_sphere(4, 6));
    primitive["material"] = 0;
    const int mesh = building.builder().add("meshes", {{"primitives", Json::array({primitive})}});
    const double size = i < 40 ? 0.003 : 1;
    building.root(building.node({{"name", "ball " + std::to_string(i)},
                                 {"mesh", mesh},
                                 {"translation", {1.25 * i, 0, 0}},
                                 {"scale", {size, size, size}}}));
  }
  const Packed packed = pack(building.finish());
  const OpenedPack opened = open(packed.file);
  ASSERT_TRUE(opened.parts());
  EXPECT_FALSE(named(opened.json(), "nodes", "ball 7").is_null());
  EXPECT_TRUE(named(opened.json(), "nodes", "ball 70").is_null());
  const auto expected = faces_by_node(packed.scene), found = faces_by_node(scene_of(apart(opened)));
  for (const auto& [name, corners] : expected) {
    ASSERT_EQ(found.at(name).size(), corners.size()) << name;
    if (name == "floor") continue;
    // Of each ball the longest side, which a 1024th may change.
    const auto side = [](const Corners& of) {
      Box3f box;
      for (const auto& face : of)
        for (const Vec3f& p : face) box.extend(p);
      return max_component(box.size());
    };
    EXPECT_NEAR(side(found.at(name)) / side(corners), 1, 2e-3) << name;
  }
}

TEST(Parts, OfFarTextureCoordinatesStayByThemselves) {
  Building building(60);
  Mesh far = box({{1, 1, 1}});
  for (size_t v = 0; v < far.positions.size(); v++) far.texcoords[0].push_back({{1e5f * static_cast<float>(v), 0}});
  Json primitive = building.builder().primitive(far);
  building.root(building.node(
      {{"name", "far"}, {"mesh", building.builder().add("meshes", {{"primitives", Json::array({primitive})}})}}));
  const Packed packed = pack(building.finish());
  EXPECT_FALSE(named(open(packed.file).json(), "nodes", "far").is_null());
}

// A reader refuses what inflates to very much more than its bytes.
TEST(Parts, OfWordsThatRepeatThemselvesAreReadAgain) {
  Document source = Building(60).finish();
  for (Json& node : source.json["nodes"]) node["extras"] = std::string(100'000, 'x');
  const Packed packed = pack(source);
  EXPECT_TRUE(verify_pack(open(packed.file)).errors.empty());
  EXPECT_EQ(named(apart(open(packed.file)).json, "nodes", "box 7")["extras"], std::string(100'000, 'x'));
}

TEST(Parts, StayWhereAnimationsNameThemByTheirPlace) {
  Document source = Building(60).finish();
  source.json["animations"] = Json::parse(R"([{"samplers": [], "channels": [{"sampler": 0, "target": {"path": "pointer",
      "extensions": {"KHR_animation_pointer": {"pointer": "/nodes/7/translation"}}}}]}])");
  EXPECT_FALSE(open(pack(source).file).parts());
}

// Exporters make a material for each part.
TEST(Parts, OfMaterialsThatDifferInTheirNamesAreMerged) {
  Document source = Building(300).finish();
  Json materials = Json::array();
  for (size_t i = 0; i < 300; i++) {
    Json& primitive = source.json["meshes"][i]["primitives"][0];
    materials.push_back({{"name", "of part " + std::to_string(i)},
                         {"pbrMetallicRoughness", {{"metallicFactor", primitive["material"].get<int>() / 2.0}}}});
    primitive["material"] = i;
  }
  source.json["materials"] = materials;
  const Packed packed = pack(source);
  const OpenedPack opened = open(packed.file);
  ASSERT_TRUE(opened.parts());
  EXPECT_EQ(opened.json()["materials"].size(), 3u);
  EXPECT_EQ(opened.json()["meshes"][0]["primitives"].size(), 3u);
  EXPECT_TRUE(verify_pack(opened).errors.empty());
  const Document restored = apart(opened);
  ASSERT_EQ(restored.json["materials"].size(), 300u);
  for (const Json& mesh : source.json["meshes"]) {
    const auto material_of = [](const Document& document, const Json& of) {
      return document.json["materials"][of["primitives"][0]["material"].get<size_t>()];
    };
    EXPECT_EQ(material_of(restored, named(restored.json, "meshes", text(mesh, "name"))), material_of(source, mesh));
  }
}

// A mesh that many nodes show is merged once for each where that takes less than their JSON; else they keep it.
TEST(Parts, OfOneMeshAreMergedWhereACopyIsSmall) {
  for (const bool small : {true, false}) {
    Building building(0);
    int mesh = building.mesh(0, "chair");
    if (!small) {
      Json primitive = building.builder().primitive(seamed_sphere(24, 32));
      primitive["material"] = 0;
      mesh = building.builder().add("meshes", {{"name", "bush"}, {"primitives", Json::array({primitive})}});
    }
    for (int i = 0; i < 200; i++)
      building.child(i % 3,
                     {{"name", "copy " + std::to_string(i)}, {"mesh", mesh}, {"translation", {2 * (i / 3), 0, 0}}});
    const Packed packed = pack(building.finish());
    const OpenedPack opened = open(packed.file);
    EXPECT_EQ(opened.parts().has_value(), small);
    EXPECT_EQ(opened.json()["nodes"].size(), small ? 1u : 203u);
    EXPECT_TRUE(verify_pack(opened).errors.empty());
    if (!small) continue;
    auto expected = faces_by_node(packed.scene), found = faces_by_node(scene_of(apart(opened)));
    for (auto* faces : {&expected, &found}) round_to(*faces, 1e-2f);
    EXPECT_EQ(found, expected);
  }
}

TEST(Parts, ComeBackWithTheirNodesNamesAndExtras) {
  const Document source = Building(200).finish();
  const Packed packed = pack(source);
  const Document restored = apart(open(packed.file));
  for (const char* array : {"nodes", "meshes"}) {
    ASSERT_EQ(restored.json[array].size(), source.json[array].size());
    for (const Json& element : source.json[array]) {
      const Json& found = named(restored.json, array, text(element, "name"));
      for (const char* member_name : {"extras", "translation", "rotation", "scale"})
        EXPECT_EQ(member(found, member_name), member(element, member_name)) << found;
      if (std::string(array) != "meshes") continue;
      EXPECT_EQ(found["primitives"][0]["extras"], element["primitives"][0]["extras"]);
      EXPECT_EQ(found["primitives"][0]["material"], element["primitives"][0]["material"]);
    }
  }
}

TEST(Parts, ComeBackFaceForFaceWhereTheyTouchToo) {
  const Packed packed = pack(Building(200).finish());
  const Scene restored = scene_of(apart(open(packed.file)));
  auto expected = faces_by_node(packed.scene), found = faces_by_node(restored);
  // Boxes of 2.5 m at most have steps of 1/4096 m or less; a thousandth holds each corner apart from its rounding.
  for (auto* faces : {&expected, &found}) round_to(*faces, 1e-2f);
  EXPECT_EQ(found, expected);
}

/// The positions of a mesh on multiples of 1/64 within 4 m, which the lattice of a merged mesh has exactly; nothing
/// else.
Mesh on_lattice(const Mesh& mesh) {
  Mesh rounded;
  rounded.faces = mesh.faces;
  const Box3f bounds = mesh.bounds();
  const float scale = 4 / std::max(1e-3f, max_component(bounds.size()));
  for (const Vec3f& p : mesh.positions) {
    rounded.positions.push_back((p - bounds.lo) * scale);
    for (int i = 0; i < 3; i++) rounded.positions.back()[i] = std::round(64 * rounded.positions.back()[i]) / 64;
  }
  return rounded;
}

// Soups, fans, borders, repeated and degenerate faces, parts that coincide with others or cross them.
TEST(Parts, OfAnyMeshesComeBackFaceForFace) {
  Document source;
  DocumentBuilder builder(source);
  Json roots = Json::array();
  builder.add("materials", Json::object());
  int count = 0;
  for (const int copy : {0, 1, 2})
    for (const auto& [name, mesh] : nasty_meshes()) {
      if (mesh.faces.empty() || mesh.faces.size() > 5000) continue;
      Json primitive = builder.primitive(on_lattice(mesh));
      primitive["material"] = 0;
      const int of = builder.add("meshes", {{"name", name}, {"primitives", Json::array({primitive})}});
      roots.push_back(builder.add(
          "nodes",
          {{"name", name + " " + std::to_string(copy)}, {"mesh", of}, {"translation", {copy * 2, count++ % 3, 0}}}));
    }
  ASSERT_GT(count, 32);
  builder.add("scenes", {{"nodes", roots}});
  const Packed packed = pack(source);
  const OpenedPack opened = open(packed.file);
  ASSERT_TRUE(opened.parts());
  auto expected = faces_by_node(packed.scene), found = faces_by_node(scene_of(apart(opened)));
  for (auto* faces : {&expected, &found}) round_to(*faces, 1.0f / 64);
  ASSERT_EQ(found.size(), expected.size());
  for (const auto& [name, corners] : expected) EXPECT_EQ(found[name], corners) << name;
}

TEST(Parts, AreApartAtEveryLevel) {
  const Packed packed = pack(Building(300).finish());
  const OpenedPack opened = open(packed.file);
  const auto whole = faces_by_node(scene_of(apart(opened)));
  size_t before = 0;
  for (const float share : {0.0f, 0.3f, 0.7f, 1.0f}) {
    size_t all = 0;
    for (const auto& [name, corners] : faces_by_node(scene_of(apart(opened, {.share = share})))) {
      ASSERT_TRUE(whole.contains(name));
      all += corners.size();
      EXPECT_LE(corners.size(), whole.at(name).size());
    }
    EXPECT_GE(all, before);
    before = all;
  }
  EXPECT_EQ(before, 300u * 12);
}

TEST(Parts, StayWhereSomethingMovesThemOrTellsThemApart) {
  Building building(100);
  const auto own = [&](const std::string& name, const Json& more) {
    Json json = {{"name", name}, {"mesh", building.mesh(0, name)}};
    json.update(more);
    const int node = building.node(json);
    building.root(node);
    return node;
  };
  const int animated = own("animated", Json::object());
  own("lamp", {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  building.json()["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
  building.json()["extensionsUsed"] = {"KHR_lights_punctual"};
  const int luminaire = own("luminaire", Json::object());
  const int watched = own("watched", {{"camera", 0}});
  building.json()["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
  building.child(watched, {{"name", "below the camera"}, {"mesh", building.mesh(1, "below the camera")}});
  DocumentBuilder& builder = building.builder();
  const std::vector<Vec3f> places = {{}, {{1, 0, 0}}};
  const int values = builder.accessor(places, false);
  const std::vector<float> times = {0, 1};
  const Bytes bytes(reinterpret_cast<const uint8_t*>(times.data()), sizeof(float) * times.size());
  const int input = builder.add(
      "accessors",
      {{"bufferView", builder.buffer_view(bytes)}, {"componentType", 5126}, {"count", 2}, {"type", "SCALAR"}});
  building.json()["animations"] = {
      {{"samplers", {{{"input", input}, {"output", values}}}},
       {"channels", {{{"sampler", 0}, {"target", {{"node", animated}, {"path", "translation"}}}}}}}};
  const int glass = building.builder().add("materials", {{"alphaMode", "BLEND"}});
  own("pane", Json::object());
  building.json()["meshes"].back()["primitives"][0]["material"] = glass;
  const int twice = building.mesh(0, "shown twice");
  building.root(building.node({{"name", "one"}, {"mesh", twice}, {"translation", {0, 0, 9}}}));
  building.root(building.node({{"name", "two"}, {"mesh", twice}, {"translation", {0, 0, 12}}}));

  ClientLamp lamp;
  lamp.kind = ClientLamp::Kind::rectangle;
  lamp.half_u = {{1, 0, 0}};
  lamp.half_v = {{0, 1, 0}};
  lamp.luminaire = {.kind = LuminaireId::Kind::surface, .node = luminaire, .primitive = 0};
  const Document source = building.finish();
  const Packed packed = pack(source, {lamp});
  const OpenedPack opened = open(packed.file);
  ASSERT_TRUE(opened.parts());
  const Json& json = opened.json();
  for (const char* stays : {"animated", "lamp", "luminaire", "pane"}) {
    ASSERT_FALSE(named(json, "nodes", stays).is_null()) << stays;
    EXPECT_EQ(text(json["meshes"][static_cast<size_t>(index_of(named(json, "nodes", stays), "mesh"))], "name"), stays);
  }
  // A camera's node stays, its mesh goes.
  EXPECT_FALSE(named(json, "nodes", "watched").is_null());
  EXPECT_FALSE(named(json, "nodes", "watched").contains("mesh"));
  for (const char* gone : {"below the camera", "one", "two", "box 0", "ground"})
    EXPECT_TRUE(named(json, "nodes", gone).is_null()) << gone;
  const auto node = [&](int64_t index) { return text(json["nodes"][static_cast<size_t>(index)], "name"); };
  EXPECT_EQ(node(whole_number(json["animations"][0]["channels"][0]["target"]["node"])), "animated");
  EXPECT_EQ(node(opened.lamps()[0].luminaire.node), "luminaire");
  EXPECT_TRUE(verify_pack(opened).errors.empty());

  const Document restored = apart(opened);
  EXPECT_EQ(restored.json["nodes"].size(), source.json["nodes"].size());
  EXPECT_EQ(restored.json["meshes"].size(), source.json["meshes"].size());
  auto expected = faces_by_node(packed.scene), found = faces_by_node(scene_of(restored));
  for (auto* faces : {&expected, &found}) round_to(*faces, 1e-2f);
  EXPECT_EQ(found, expected);
}

TEST(Parts, KeepThePlaceOfAFarScene) {
  Building building(60);
  const Vec3d far{{4e5, 12, 5.6e6}};
  const int root = building.node({{"name", "site"}, {"translation", far.e}, {"children", {0, 1, 2}}});
  Document source = building.finish();
  source.json["scenes"][0]["nodes"] = {root};
  const Packed packed = pack(source);
  const OpenedPack opened = open(packed.file);
  ASSERT_TRUE(opened.parts());
  Report report;
  const Document restored = apart(opened);
  const Scene scene = scene_from_document(restored, "", report, opened.identity().origin).value();
  auto expected = faces_by_node(packed.scene), found = faces_by_node(scene);
  for (auto* faces : {&expected, &found}) round_to(*faces, 1e-2f);
  EXPECT_EQ(found, expected);
}

/// The pack with another file of parts.
std::vector<uint8_t> with_parts(const OpenedPack& pack, const Json& parts) {
  const std::string text = parts.dump();
  PartsParameters parameters{0, static_cast<uint32_t>(text.size())};
  const std::vector<uint8_t> file = gzip(as_bytes(text));
  parameters.bytes = static_cast<uint32_t>(file.size());
  std::vector<PackStream> streams = streams_of(pack.reader());
  PackStream& stream = streams[pack.parts()->stream];
  stream.parameters = parameters.write();
  stream.blocks.clear();
  for (const Bytes block : file_blocks(file))
    stream.blocks.push_back({{block.begin(), block.end()}, static_cast<uint32_t>(block.size()), 0});
  return rewrite(pack, pack.json(), std::move(streams));
}

Json parts_json(const OpenedPack& pack) {
  auto parts = open_asset_as<PartsAsset>(pack.reader(), pack.parts()->stream).value();
  for (uint32_t i = 0; i < pack.reader().directory().streams[pack.parts()->stream].blocks; i++)
    EXPECT_TRUE(parts->append(pack.reader().block(pack.parts()->stream, i).value()));
  return parse_json(gunzip(parts->file(), parts->parameters().inflated).value()).value();
}

// What verify accepts comes apart; whatever the stream says, nothing breaks.
TEST(Parts, OfAnyWordsComeApartOrAreRefused) {
  const Packed packed = pack(Building(40).finish());
  const OpenedPack opened = open(packed.file);
  const Json right = parts_json(opened);
  int refused = 0;
  for (uint64_t seed = 0; seed < 150; seed++) {
    Random random(53, seed);
    Json parts = right;
    spoil(parts, random);
    const std::vector<uint8_t> file = with_parts(opened, parts);
    const auto edited = try_open(file);
    if (!edited) continue;
    const Verification verification = verify_pack(*edited);
    if (!verification.errors.empty()) {
      refused++;
      continue;
    }
    const Document document = apart(*edited);
    Report report;
    EXPECT_TRUE(write_glb(document, report));
  }
  EXPECT_GT(refused, 30);
}

}  // namespace
}  // namespace lightwell
