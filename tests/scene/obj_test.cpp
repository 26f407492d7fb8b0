// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "lightwell/base/file.h"
#include "lightwell/base/random.h"
#include "lightwell/scene/import_gltf.h"
#include "lightwell/scene/import_obj.h"
#include "lightwell/scene/obj_text.h"
#include "lightwell/texture/image_file.h"
#include "lightwell/texture/transfer.h"

namespace lightwell {
namespace {

namespace fs = std::filesystem;

class ObjTest : public testing::Test {
 protected:
  ObjTest() : folder_(fs::temp_directory_path() / ("lightwell-obj-test-" + std::to_string(getpid()))) {
    fs::create_directories(folder_ / "below");
  }
  ~ObjTest() override { fs::remove_all(folder_); }

  void write(const std::string& name, Bytes bytes) { EXPECT_TRUE(write_file(folder_ / name, bytes)); }
  Result<Scene> read(const std::string& text) {
    auto document = obj_document(as_bytes(text), folder_, report);
    if (!document) return fail(document.error());
    return scene_from_document(std::move(*document), "test", report);
  }
  Scene read_well(const std::string& text) {
    auto scene = read(text);
    EXPECT_TRUE(scene) << (scene ? "" : scene.error().message());
    return scene ? std::move(*scene) : Scene{};
  }

  fs::path folder_;
  Report report;
};

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST_F(ObjTest, SharesEqualCornersAndMakesNormalsSmooth) {
  const Scene scene = read_well(square + "f 1 2 3\nf -4 -2 -1\n");
  ASSERT_EQ(scene.primitives.size(), 1u);
  const Mesh& mesh = scene.primitives[0].mesh;
  EXPECT_EQ(mesh.positions.size(), 4u);
  EXPECT_EQ(mesh.faces, (std::vector<Face>{{0, 1, 2}, {0, 2, 3}}));
  for (const Vec3f& normal : mesh.normals) EXPECT_NEAR(normal[2], 1, 1e-6);
  EXPECT_TRUE(report.warnings.empty());
}

TEST_F(ObjTest, SplitsVerticesWhereTexturesOrNormalsDiffer) {
  const Scene scene = read_well(square +
                                "vt 0 0\nvt 1 0.25\nvt 1 1\nvt 0.5 0\nvn 0 0 2\nvn 1 0 0\n"
                                "f 1/1/1 2/2/1 3/3/1\nf 1/4/1 3/3/2 4/1/1\n");
  const Mesh& mesh = scene.primitives[0].mesh;
  ASSERT_EQ(mesh.positions.size(), 6u);
  EXPECT_EQ(mesh.texcoords[0][1], (Vec2f{{1, 0.75f}}));
  EXPECT_EQ(mesh.normals[0], (Vec3f{{0, 0, 1}}));
}

TEST_F(ObjTest, ReadsMaterialsOfFilesBelow) {
  const Image image{1, 1, 3, {10, 20, 30}};
  write("below/some wood.png", write_png(image));
  write("below/materials.mtl",
        as_bytes("newmtl warm wood\r\nKd 0.5 0.25 0.125\r\nmap_Kd some wood.png\r\n"
                 "newmtl lamp\nKd 0 0 0\nKe 20 10 5\nnewmtl glass\nKd 1 1 1\nd 0.5\nnewmtl unused\n"));
  const Scene scene = read_well("mtllib below/materials.mtl\nvt 0 0\n" + square +
                                "o first\nusemtl warm wood\nf 1/1 2/1 3/1\nusemtl lamp\nf 1 3 4\n"
                                "o second\nusemtl glass\nf 1 2 4\nusemtl nowhere\nf 2 3 4\n");
  ASSERT_EQ(scene.primitives.size(), 4u);
  ASSERT_EQ(scene.instances.size(), 4u);
  const auto material_named = [&](const std::string& name) {
    for (const Material& material : scene.materials) {
      if (material.name == name) return material;
    }
    ADD_FAILURE() << name;
    return Material{};
  };
  const Material wood = material_named("warm_wood");
  EXPECT_EQ(wood.base_color, (Vec4f{{0.5f, 0.25f, 0.125f, 1}}));
  EXPECT_EQ(wood.metallic, 0);
  ASSERT_EQ(wood.base_color_texture.image, 0);
  EXPECT_EQ(scene.images[0].pixels, image.pixels);
  EXPECT_EQ(material_named("lamp").emission, (Vec3f{{20, 10, 5}}));
  EXPECT_EQ(material_named("glass").alpha, Material::Alpha::blend);
  EXPECT_FLOAT_EQ(material_named("glass").base_color[3], 0.5f);
  EXPECT_EQ(material_named("surface").base_color[0], 0.8f);
  EXPECT_EQ(report.warnings.size(), 1u);  // of "nowhere"
}

// Exporters leave indices empty that they do not use.
TEST_F(ObjTest, TakesAnEmptyIndexForNone) {
  const std::string extra = "vt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\n";
  for (const char* face :
       {"f 1// 2// 3//\n", "f 1/ 2/ 3/\n", "f 1/1/ 2/2/ 3/3/\n", "f 1//1 2//1 3//1\n", "f 1 2/ 3//\n"}) {
    const Scene scene = read_well(square + extra + face);
    ASSERT_EQ(scene.primitives.size(), 1u) << face;
    EXPECT_EQ(scene.primitives[0].mesh.faces.size(), 1u) << face;
    EXPECT_EQ(scene.primitives[0].mesh.texcoords[0].size(), std::string_view(face).starts_with("f 1/1") ? 3u : 0u)
        << face;
  }
}

TEST_F(ObjTest, ReadsKeywordsOfAMaterialInAnyCaseAndEitherSlash) {
  EXPECT_EQ(checked_mtl_text(
                as_bytes(std::string("newmtl a b\nKD 1 0 0\nmap_KD .\\sub\\a.png\nmap_kd -o 1 1 b.png\nPm 1\n"))),
            "newmtl a_b\nKd 1 0 0\nmap_Kd ./sub/a.png\nmap_Kd -o 1 1 b.png\nPm 1\n");
}

// Options of a map are no part of its name: the image lies where they put it.
TEST_F(ObjTest, PutsImagesWhereTheirOptionsSay) {
  write("tex.png", write_png(Image{1, 2, 3, {255, 0, 0, 0, 0, 255}}));
  write("all.mtl", as_bytes("newmtl a\nmap_Kd -o 0.5 -7 0 -s 1 10 1 -clamp on tex.png\nnewmtl b\nmap_Kd tex.png\n"));
  const Scene scene =
      read_well("mtllib all.mtl\nvt 0.25 0.75\n" + square + "usemtl a\nf 1/1 2/1 3/1\nusemtl b\nf 1/1 3/1 4/1\n");
  EXPECT_EQ(scene.images.size(), 1u);
  for (const Material& material : scene.materials) {
    const TextureLookup& texture = material.base_color_texture;
    if (texture.image < 0) continue;
    const bool placed = material.name == "a";
    EXPECT_EQ(texture.wrap_u, placed ? TextureLookup::Wrap::clamp : TextureLookup::Wrap::repeat);
    // u: 0.25 + 0.5; v, counted from below: 10 * 0.75 - 7.
    const Vec3f corner{{0.25f, 1 - 0.75f, 1}};
    EXPECT_NEAR(dot(Vec3f{texture.row_u}, corner), placed ? 0.75f : 0.25f, 1e-6f);
    EXPECT_NEAR(1 - dot(Vec3f{texture.row_v}, corner), placed ? 0.5f : 0.75f, 1e-5f);
  }
}

// Materials that share an image share its texture, and what of them is not read is named once.
TEST_F(ObjTest, SharesImagesAndNamesWhatItLeavesOut) {
  write("wood.png", write_png(Image{1, 1, 3, {10, 20, 30}}));
  write("all.mtl", as_bytes("newmtl a\nmap_Kd wood.png\nmap_Bump wood.png\nnewmtl b\nmap_Kd wood.png\nPm 0.5\n"));
  const Scene scene =
      read_well("mtllib all.mtl\nvt 0 0\n" + square + "usemtl a\nf 1/1 2/1 3/1\nusemtl b\nf 1/1 3/1 4/1\n");
  EXPECT_EQ(scene.images.size(), 1u);
  EXPECT_EQ(report.warnings,
            (std::vector<std::string>{"materials: bump is not supported and left out; surfaces are diffuse",
                                      "materials: Pm is not supported and left out; surfaces are diffuse"}));
}

TEST_F(ObjTest, ReadsNothingOutsideItsFolder) {
  write("outside.mtl", as_bytes("newmtl secret\nKd 1 0 0\n"));
  folder_ /= "below";
  const std::string absolute = (folder_.parent_path() / "outside.mtl").string();
  for (const std::string& name : std::vector<std::string>{"../outside.mtl", absolute, "..\\outside.mtl"}) {
    report = {};
    const Scene scene = read_well("mtllib " + name + "\n" + square + "usemtl secret\nf 1 2 3\n");
    EXPECT_EQ(scene.materials.at(0).name, "surface") << name;
    EXPECT_FALSE(report.warnings.empty());
  }
  folder_ = folder_.parent_path();
}

TEST_F(ObjTest, ReadsColoursContinuedLinesAndComments) {
  const Scene scene =
      read_well("\xef\xbb\xbf# comment\r\nv 0 0 0 1 0 0.5\r\nv 1 0 0 1 1 1\nv 1 1 0 # inline\nf 1 \\\r\n 2 \\\n 3\n");
  const Mesh& mesh = scene.primitives[0].mesh;
  ASSERT_EQ(mesh.colors.size(), 3u);
  // Stored in glTF as normalised bytes or shorts: half a step of a byte.
  EXPECT_NEAR(mesh.colors[0][2], srgb_to_linear(0.5f), 0.5 / 255);
  EXPECT_EQ(mesh.colors[2], Vec4f::filled(1));
}

TEST_F(ObjTest, LeavesOutPointsAndLinesWithAWarning) {
  const Scene scene = read_well(square + "p 1\nl 1 2 3\ncurv 0 1 1 2\nf 1 2 3 4\n");
  EXPECT_EQ(scene.primitives[0].mesh.faces.size(), 2u);
  EXPECT_EQ(report.warnings.size(), 1u);
}

TEST_F(ObjTest, RefusesFaultsByLine) {
  for (const std::string text : {"v 0 0\n", "v a b c\n", "v 0 0 nan\n", "vn 1 0\n", "vt\n", "f 0 1 2\n", "f 1//x 2 3\n",
                                 "f 1 2 x\n", "f 1/// 2 3\n", "f // 2 3\n"}) {
    const auto scene = read(square + text);
    ASSERT_FALSE(scene) << text;
    EXPECT_EQ(scene.error().element, "line 5") << text;
  }
  std::string many = "f";
  for (int i = 0; i < 256; i++) many += " 1";
  EXPECT_FALSE(read(square + many + "\n"));
  EXPECT_FALSE(read(square + "f 1 2 5\n"));
  EXPECT_FALSE(read(square + "f 1 2 -5\n"));
  EXPECT_FALSE(read(square + "f 1/7 2 3\n"));
  EXPECT_FALSE(read(square + "v 1e999 0 0\nf 1 2 5\n"));
  EXPECT_FALSE(read(square));
  EXPECT_FALSE(read(square + std::string("f 1 2\0 3\n", 9)));
}

// A statement that makes the library reserve much memory for a short line is not passed on.
TEST(ObjText, KeepsOnlyStatementsThatMatter) {
  Report report;
  const auto text =
      checked_obj_text(as_bytes("t a 8192/8192/8192\nvw 0 1 1\ns 1\n\nv 1 2 3 # c\n  g  b  c \n"), report);
  ASSERT_TRUE(text);
  EXPECT_EQ(*text, "\n\n\n\nv 1 2 3\ng b__c\n");
}

TEST(ObjText, IsToldByTheFirstStatement) {
  EXPECT_TRUE(is_obj(as_bytes("# text\n\n mtllib a.mtl\n")));
  EXPECT_TRUE(is_obj(as_bytes("v 0 0 0")));
  EXPECT_FALSE(is_obj(as_bytes("# text\nversion 1\nv 0 0 0")));
  EXPECT_FALSE(is_obj({}));
}

TEST_F(ObjTest, SurvivesDamageAndPrefixes) {
  const std::string text = "mtllib none.mtl\n" + square +
                           "vt 0.5 1e-1\nvn 0 0 1\no a b\nusemtl x y\ng c\nf 1/1/1 2/1/1 3//1 4\nf -1 -2 \\\n-3\n";
  Random random(8, 0);
  for (size_t size = 0; size < text.size(); size++) (void)read(text.substr(0, size));
  for (int i = 0; i < 1500; i++) {
    std::string damaged = text;
    for (uint32_t n = 1 + random.below(3); n > 0; n--)
      damaged[random.below(static_cast<uint32_t>(text.size()))] = "0129-./ \nvfnt\\#\0\xff"[random.below(18)];
    const auto scene = read(damaged);
    EXPECT_TRUE(scene || scene.error().message().find('\n') == std::string::npos);
  }
}

// The mask is grey and of another size; what it cuts out is in the alpha of the colours.
TEST_F(ObjTest, MapsOfOpacityCutOut) {
  write("leaf.png", write_png(Image{2, 1, 3, {10, 20, 30, 40, 50, 60}}));
  write("mask.png", write_png(Image{4, 1, 1, {255, 255, 0, 0}}));
  write("all.mtl", as_bytes("newmtl a\nmap_Kd .\\below\\..\\leaf.png\nmap_d mask.png\nnewmtl b\nmap_d mask.png\n"
                            "newmtl c\nmap_Kd leaf.png\nmap_d leaf.png\nnewmtl d\nmap_Kd leaf.png\nmap_d none.png\n"));
  const Scene scene = read_well("mtllib all.mtl\n" + square + "vt 0 0\nvt 1 0\nvt 1 1\n" +
                                "usemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 1/1 2/2 3/3\nusemtl c\nf 1/1 2/2 3/3\n" +
                                "usemtl d\nf 1/1 2/2 3/3\n");
  const auto image_of = [&](size_t primitive) -> const Image& {
    const Material& material = scene.material_of(scene.primitives.at(primitive));
    EXPECT_EQ(material.alpha, Material::Alpha::mask);
    return scene.images.at(static_cast<size_t>(material.base_color_texture.image));
  };
  EXPECT_EQ(image_of(0).pixels, (std::vector<uint8_t>{10, 20, 30, 255, 40, 50, 60, 0}));
  EXPECT_EQ(image_of(1).pixels.size(), 16u);
  EXPECT_EQ(image_of(1).pixels[3], 255);
  EXPECT_EQ(image_of(1).pixels[15], 0);
  EXPECT_EQ(image_of(2).channels, 3);  // its own opacity, of which it has none
  EXPECT_EQ(image_of(3).channels, 3);
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_EQ(report.warnings[0].rfind("material d: map_d is left out", 0), 0u) << report.warnings[0];
}

// Names as Windows writes them; a texture is looked for beside its MTL file.
TEST_F(ObjTest, TakesBackslashesForSlashes) {
  write("below/leaf.png", write_png(Image{1, 1, 3, {10, 20, 30}}));
  write("below/all.mtl", as_bytes("newmtl a\nmap_KD .\\leaf.png\n"));
  const Scene scene = read_well("mtllib below\\all.mtl\n" + square + "vt 0 0\nusemtl a\nf 1/1 2/1 3/1\n");
  EXPECT_EQ(scene.images.at(0).pixels, (std::vector<uint8_t>{10, 20, 30}));
  EXPECT_TRUE(report.warnings.empty());
}

TEST_F(ObjTest, SaysWhichTexturesCannotBeShown) {
  write("leaf.png", write_png(Image{1, 1, 3, {10, 20, 30}}));
  write("all.mtl", as_bytes("newmtl a\nmap_Kd leaf.png\n"));
  read_well("mtllib all.mtl\n" + square + "usemtl a\nf 1 2 3\n");
  EXPECT_EQ(report.warnings, std::vector<std::string>{"material a: its textures are left out where faces have no vt"});
}

}  // namespace
}  // namespace lightwell
