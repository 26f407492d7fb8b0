// SPDX-License-Identifier: Apache-2.0
//
// Whole files of others and of the truth.
#include <gtest/gtest.h>

#include <filesystem>
#include <numbers>

#include "lightwell/base/file.h"
#include "lightwell/scene/import_gltf.h"

namespace lightwell {
namespace {

namespace fs = std::filesystem;

#define EXPECT_NEAR_VEC(a, b, tolerance) EXPECT_LE(length((a) - (b)), tolerance)

Scene import_file(const fs::path& path, Report& report) {
  const auto bytes = read_file(path);
  EXPECT_TRUE(bytes) << path;
  auto document = read_document(*bytes, path.parent_path(), report);
  EXPECT_TRUE(document) << path << document.error().message();
  if (!document) return {};
  auto scene = scene_from_document(std::move(*document), "test", report);
  EXPECT_TRUE(scene) << path << scene.error().message();
  return scene ? std::move(*scene) : Scene();
}

// docs of the truth scenes: sizes in metres, triangles, the lamp's radiance and the pictures' sizes.
TEST(ImportGltf, TruthScenesReadRight) {
  struct Truth {
    const char* name;
    size_t triangles;
    Vec3f radiance;
    int width, height;
  };
  for (const Truth& truth :
       {Truth{"a_cornell", 46, {{17, 12, 4}}, 160, 160}, Truth{"b_tworooms", 82, {{20, 18, 15}}, 160, 120},
        Truth{"c_furnace", 12, {{1, 1, 1}}, 160, 120}, Truth{"d_blob", 20572, {{0, 0, 0}}, 160, 120}}) {
    SCOPED_TRACE(truth.name);
    Report report;
    const Scene scene =
        import_file(fs::path(LIGHTWELL_TEST_DATA) / "truth" / (std::string(truth.name) + ".glb"), report);
    EXPECT_TRUE(report.warnings.empty());
    size_t triangles = 0;
    for (const Primitive& primitive : scene.primitives) triangles += primitive.mesh.faces.size();
    EXPECT_EQ(triangles, truth.triangles);
    EXPECT_EQ(scene.instances.size(), scene.primitives.size());
    ASSERT_EQ(scene.cameras.size(), 1u);
    EXPECT_EQ(scene.cameras[0].name, "cam1");
    EXPECT_EQ(scene.cameras[0].width, truth.width);
    EXPECT_EQ(scene.cameras[0].height, truth.height);
    bool shines = truth.radiance == Vec3f{};
    for (const Material& material : scene.materials) {
      shines |= length(material.emission - truth.radiance) < 1e-5f;
      EXPECT_EQ(material.metallic, 0);
      EXPECT_EQ(material.roughness, 1);
    }
    EXPECT_TRUE(shines);
    for (const Primitive& primitive : scene.primitives) EXPECT_TRUE(primitive.mesh.normals.empty());
  }
}

TEST(ImportGltf, SharedFilesBecomeScenes) {
  const fs::path data = fs::path(LIGHTWELL_SHARED) / "data";
  if (!fs::exists(data)) GTEST_SKIP() << data << " is missing";
  for (const char* folder : {"rooms", "scans", "objects"})
    for (const auto& entry : fs::directory_iterator(data / folder)) {
      if (entry.path().extension() != ".glb") continue;
      SCOPED_TRACE(entry.path());
      Report report;
      const Scene scene = import_file(entry.path(), report);
      EXPECT_FALSE(scene.instances.empty());
      // Some have coats, which are ignored by name.
      for (const std::string& warning : report.warnings)
        EXPECT_NE(warning.find("is ignored; the light is that without it"), std::string::npos) << warning;
    }
}

// data/README.md: many-lights.glb draws 29 356 triangles, with 32 + 10 lamps; the dragon room is a cube of 6 m.
TEST(ImportGltf, SharedRoomsHaveTheStatedContents) {
  const fs::path rooms = fs::path(LIGHTWELL_SHARED) / "data" / "rooms";
  if (!fs::exists(rooms)) GTEST_SKIP() << rooms << " is missing";
  Report report;
  const Scene hall = import_file(rooms / "many-lights.glb", report);
  size_t drawn = 0;
  for (const Instance& instance : hall.instances)
    drawn += hall.primitives[static_cast<size_t>(instance.primitive)].mesh.faces.size();
  EXPECT_EQ(drawn, 29356u);
  EXPECT_EQ(hall.lamps.size(), 10u);

  const Scene room = import_file(rooms / "dragon-room.glb", report);
  Box3f box;
  for (const Instance& instance : room.instances)
    for (const Vec3f& p : room.primitives[static_cast<size_t>(instance.primitive)].mesh.positions)
      box.extend(instance.to_scene.point(p));
  EXPECT_NEAR_VEC(box.size(), Vec3f::filled(6), 1e-5f);
}

TEST(ImportGltf, BrokenFilesNeverCrash) {
  const fs::path broken = fs::path(LIGHTWELL_SHARED) / "data" / "broken";
  if (!fs::exists(broken)) GTEST_SKIP() << broken << " is missing";
  for (const auto& entry : fs::recursive_directory_iterator(broken)) {
    if (entry.path().extension() != ".glb" && entry.path().extension() != ".gltf") continue;
    SCOPED_TRACE(entry.path());
    Report report;
    const auto bytes = read_file(entry.path());
    auto document = read_document(*bytes, entry.path().parent_path(), report);
    if (!document) continue;
    const auto scene = scene_from_document(std::move(*document), "", report);
    EXPECT_TRUE(scene || scene.error().message().find('\n') == std::string::npos);
  }
}

}  // namespace
}  // namespace lightwell
