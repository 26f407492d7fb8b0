// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <optional>

#include "lightwell/base/file.h"
#include "lightwell/scene/scene.h"
#include "lightwell/texture/image_file.h"
#include "tests/base/gzipped.h"
#include "tests/temporary_folder.h"

namespace lightwell {
namespace {

namespace fs = std::filesystem;

size_t triangles_of(const Scene& scene) {
  size_t count = 0;
  for (const Instance& instance : scene.instances)
    count += scene.primitives[static_cast<size_t>(instance.primitive)].mesh.faces.size();
  return count;
}

const std::string ply =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 0 2\n3 0 1 2\n";
const std::string obj = "# a triangle\nv 0 0 0\nv 1 0 0\nv 0 0 2\nf 1 2 3\n";

TEST(LoadScene, TellsFormatsByContent) {
  const TemporaryFolder folder;
  for (const std::string& text : {ply, obj, gzipped(ply), gzipped(obj)}) {
    Report report;
    const auto scene = load_scene(folder.write("model.bin", text), {}, report);
    ASSERT_TRUE(scene) << scene.error().message();
    EXPECT_EQ(triangles_of(*scene), 1u);
    EXPECT_EQ(scene->name, "model");
    EXPECT_EQ(scene->bounds().hi, (Vec3f{{1, 0, 2}}));
  }
}

// An OBJ file whose numbers have more digits than floats.
TEST(LoadScene, KeepsTheShapeOfAnObjFarAway) {
  const TemporaryFolder folder;
  Report report;
  const auto scene = load_scene(folder.write("far.obj",
                                             "v 500000.125 4649776.5 100\nv 500000.250 4649776.5 100 1 0 0\n"
                                             "v +500000.125 4649776.75 100\nf 1 2 3\n"),
                                {}, report);
  ASSERT_TRUE(scene) << scene.error().message();
  const Box3f bounds = scene->bounds();
  EXPECT_EQ(bounds.size(), (Vec3f{{0.125f, 0.25f, 0}}));
  EXPECT_EQ(bounds.lo.cast<double>() + scene->origin, (Vec3d{{500000.125, 4649776.5, 100}}));
}

// glTF knows no TGA: what a page gets is a PNG of the same pixels.
TEST(LoadScene, TurnsPicturesThatGltfDoesNotKnowIntoPng) {
  const TemporaryFolder folder;
  const std::string header("\0\0\2\0\0\0\0\0\0\0\0\0\2\0\1\0\30\40", 18);
  folder.write("wood.tga", header + "\3\2\1\6\5\4");
  folder.write("wood.mtl", "newmtl wood\nmap_Kd wood.tga\n");
  const std::string quad = "mtllib wood.mtl\nv 0 0 0\nv 1 0 0\nv 0 0 2\nvt 0 0\nusemtl wood\nf 1/1 2/1 3/1\n";
  Report report;
  const auto scene = load_scene(folder.write("wood.obj", quad), {}, report);
  ASSERT_TRUE(scene) << scene.error().message();
  EXPECT_TRUE(report.warnings.empty());
  ASSERT_EQ(scene->images.size(), 1u);
  EXPECT_EQ(scene->images[0].pixels, (std::vector<uint8_t>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(scene->document.json["images"][0]["mimeType"], "image/png");
  EXPECT_EQ(read_png(read_image(scene->document, 0).value()).value().pixels, scene->images[0].pixels);
}

TEST(LoadScene, TurnsAndScales) {
  const TemporaryFolder folder;
  Report report;
  const auto scene = load_scene(folder.write("scan.ply.gz", gzipped(ply)),
                                {.orientation = {.up = {.axis = 2}, .front = {}, .unit = 0.5f}}, report);
  ASSERT_TRUE(scene) << scene.error().message();
  EXPECT_EQ(scene->name, "scan");
  // z becomes up, y becomes away: (x, y, z) -> (x, z, -y) / 2.
  EXPECT_NEAR(scene->bounds().hi[1], 1, 1e-6);
  EXPECT_NEAR(scene->bounds().hi[0], 0.5, 1e-6);
  EXPECT_NEAR(scene->bounds().hi[2], 0, 1e-6);
}

TEST(LoadScene, RefusesByName) {
  const TemporaryFolder folder;
  const std::string points =
      R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "accessors": [{"componentType": 5126, "count": 1, "type": "VEC3", "min": [0, 0, 0], "max": [0, 0, 0]}],
    "meshes": [{"primitives": [{"mode": 0, "attributes": {"POSITION": 0}}]}]})";
  const std::map<std::string, std::string> refused = {
      {"DRACO\2\2", "damaged Draco data"},
      {"\x76\x2f\x31\x01", "OpenEXR"},
      {"#?RADIANCE\n", "Radiance"},
      {"{\"primitives\": []}", "JSON"},
      {"<?xml version=\"1.0\"?>", "XML"},
      {"\xfe\xff", "UTF-16"},
      {"\xff\xd8\xff", "picture"},
      {"", "empty"},
      {"hello", "neither"},
      {"LASF\1\2", "point cloud"},
      {"NGSP\2", "Gaussian splats"},
      {points, "holds points"},
  };
  for (const auto& [text, word] : refused) {
    Report report;
    const std::string path = folder.write("file", text);
    const auto scene = load_scene(path, {}, report);
    ASSERT_FALSE(scene) << word;
    EXPECT_EQ(scene.error().file, path);
    EXPECT_NE(scene.error().message().find(word), std::string::npos) << scene.error().message();
  }
  Report report;
  EXPECT_NE(load_scene("no-such-scene", {}, report).error().message().find("box-small"), std::string::npos);
}

/// Loads a file of others; prints and returns none when it is not there.
std::optional<Result<Scene>> load_shared(const std::string& name, Report& report) {
  const fs::path path = fs::path(LIGHTWELL_SHARED) / "data" / name;
  if (!fs::exists(path)) {
    std::printf("left out: %s is not there\n", path.c_str());
    return std::nullopt;
  }
  return load_scene(path.string(), {}, report);
}

// The triangles that the collection's README counts; where it counts none, what the file's text says.
TEST(LoadScene, ReadsFilesOfOthers) {
  const std::map<std::string, size_t> triangles = {
      {"scans/armadillo.obj.gz", 86482},
      {"scans/bun_zipper.ply.gz", 69451},
      {"scans/bunny-attributes.ply", 12000},
      {"scans/bunny.ply", 69451},
      {"scans/dragon-47k-big-endian-colours.ply", 47794},
      {"scans/lucy-100k.ply", 99970},
      {"objects/spot.obj", 5856},
      {"rooms/embree-cornell_box.obj", 34},
      {"references/cornell-box/meshes/cbox_ceiling.obj", 4},
      {"formats/assimp-box_without_lineending.obj", 12},
      {"formats/assimp-concave_polygon.obj", 64},
      {"formats/assimp-cube.ply", 12},
      {"formats/assimp-cube_binary.ply", 12},
      {"formats/assimp-cube_binary_header_with_RN_newline.ply", 12},
      {"formats/assimp-cube_binary_starts_with_nl.ply", 12},
      {"formats/assimp-cube_usemtl.obj", 12},
      {"formats/assimp-cube_with_vertexcolors.obj", 12},
      {"formats/assimp-float-color.ply", 1},
      {"formats/assimp-mtl_different_folder.obj", 12},
      {"formats/assimp-multiple_spaces.obj", 1},
      {"formats/assimp-number_formats.obj", 1},
      {"formats/assimp-space_in_material_name.obj", 64},
      {"formats/assimp-testmixed.obj", 12},
      {"formats/everything.obj", 6},
      {"formats/faces-first-extra-elements.ply", 11102},
      {"formats/odd-order-doubles.ply", 11102},
      {"formats/polygons-ascii.ply", 132},
      {"formats/trimesh-cube_blender_uv.ply", 12},
      {"formats/trimesh-featuretype.ply", 3476},
      {"formats/trimesh-fixed_top.ply", 4772},
      {"formats/trimesh-metadata.ply", 2},
      {"formats/trimesh-multi.ply", 2},
      {"formats/trimesh-plane.ply", 2},
      {"formats/trimesh-tet.ply", 4},
      {"formats/tristrips.ply", 11102},
  };
  for (const auto& [name, count] : triangles) {
    Report report;
    const auto scene = load_shared(name, report);
    if (!scene) continue;
    ASSERT_TRUE(*scene) << (*scene).error().message();
    EXPECT_EQ(triangles_of(**scene), count) << name;
  }
}

TEST(LoadScene, RefusesFilesOfOthersInOneLine) {
  for (const std::string name : {"rooms/tungsten-cornell-box.json",
                                 "formats/assimp-box_UTF16BE.obj",
                                 "formats/assimp-box_longline.obj",
                                 "formats/assimp-point_cloud.obj",
                                 "formats/assimp-points.ply",
                                 "formats/assimp-testline.obj",
                                 "formats/trimesh-empty.ply",
                                 "formats/trimesh-points_emptyface.ply",
                                 "broken/assimp-issue623.ply",
                                 "broken/assimp-malformed.obj",
                                 "broken/bad-format-word.ply",
                                 "broken/bunny-corrupt.drc",
                                 "broken/huge-count.ply",
                                 "broken/index-out-of-range.obj",
                                 "broken/index-out-of-range.ply",
                                 "broken/nan-positions.ply",
                                 "broken/negative-index.ply",
                                 "broken/no-end-header.ply",
                                 "broken/no-position.ply",
                                 "broken/not-numbers.obj",
                                 "broken/truncated-faces.ply",
                                 "broken/wrong-count.stl",
                                 "references/cornell-box/ref-cbox-d1-4096.exr"}) {
    Report report;
    const auto scene = load_shared(name, report);
    if (!scene) continue;
    ASSERT_FALSE(*scene) << name;
    EXPECT_EQ((*scene).error().message().find('\n'), std::string::npos);
    std::printf("%s\n", (*scene).error().message().c_str());
  }
}

}  // namespace
}  // namespace lightwell
