// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/ply.h"

#include <gtest/gtest.h>

#include <sstream>

#include "lightwell/base/random.h"
#include "lightwell/scene/ply_header.h"
#include "lightwell/texture/transfer.h"

namespace lightwell {
namespace {

const char* const all_formats[] = {"ascii", "binary_little_endian", "binary_big_endian"};

/// Writes PLY data in one of the three formats.
class PlyWriter {
 public:
  explicit PlyWriter(std::string format) : format_(std::move(format)) {}

  void number(const std::string& type, double value) {
    if (format_ == "ascii") {
      std::ostringstream word;
      word.precision(9);
      word << value << ' ';
      text(word.str());
    } else if (type == "float") {
      bytes(std::bit_cast<uint32_t>(static_cast<float>(value)), 4);
    } else if (type == "double") {
      bytes(std::bit_cast<uint64_t>(value), 8);
    } else {
      const size_t size = type.find("char") != type.npos ? 1 : type.find("short") != type.npos ? 2 : 4;
      bytes(static_cast<uint64_t>(static_cast<int64_t>(value)), size);
    }
  }
  void text(const std::string& text) { data_.insert(data_.end(), text.begin(), text.end()); }
  void end_line() {
    if (format_ == "ascii") text("\n");
  }
  const std::vector<uint8_t>& data() const { return data_; }

 private:
  void bytes(uint64_t bits, size_t size) {
    for (size_t i = 0; i < size; i++) {
      const size_t place = format_ == "binary_little_endian" ? i : size - 1 - i;
      data_.push_back(static_cast<uint8_t>(bits >> (8 * place)));
    }
  }

  std::string format_;
  std::vector<uint8_t> data_;
};

std::vector<uint8_t> bytes_of(const std::string& text) { return {text.begin(), text.end()}; }

/// Two triangles in space over four vertices; `type` is that of the positions, `index` and `count` those of the lists.
std::vector<uint8_t> square(const std::string& format, const std::string& type, const std::string& count,
                            const std::string& index, const std::string& newline = "\n") {
  PlyWriter writer(format);
  const std::string property = "property " + type + " ";
  const std::string list = "property list " + count + " " + index + " vertex_indices";
  for (const std::string& line :
       std::vector<std::string>{"ply", "format " + format + " 1.0", "comment made", "element vertex 4", property + "x",
                                property + "y", property + "z", "element face 2", list, "end_header"})
    writer.text(line + newline);
  for (const auto& [x, y, z] : std::vector<std::array<double, 3>>{{0, 0, 5}, {3, 0, 5}, {3, 2, 5}, {0, 2, 5}}) {
    for (const double value : {x, y, z}) writer.number(type, value);
    writer.end_line();
  }
  for (const auto& face : std::vector<std::vector<double>>{{0, 1, 2}, {0, 2, 3}}) {
    writer.number(count, 3);
    for (const double corner : face) writer.number(index, corner);
    writer.end_line();
  }
  return writer.data();
}

void expect_square(const Result<Mesh>& mesh) {
  ASSERT_TRUE(mesh) << mesh.error().message();
  EXPECT_EQ(mesh->positions, (std::vector<Vec3f>{{{0, 0, 5}}, {{3, 0, 5}}, {{3, 2, 5}}, {{0, 2, 5}}}));
  EXPECT_EQ(mesh->faces, (std::vector<Face>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(mesh->normals, std::vector<Vec3f>(4, {{0, 0, 1}}));
}

/// The only part of a file.
Result<Mesh> mesh_of(Bytes file, Report& report) {
  LW_TRY(content, read_ply(file, report));
  EXPECT_EQ(content.parts.size(), 1u);
  EXPECT_EQ(content.origin, Vec3d{});
  return std::move(content.parts.at(0).mesh);
}

Result<Mesh> read(const std::string& text) {
  Report report;
  return mesh_of(bytes_of(text), report);
}

TEST(Ply, ReadsEveryFormatTypeAndLineEnd) {
  Report report;
  for (const std::string format : all_formats) {
    for (const std::string type : {"float", "double", "char", "uchar", "short", "ushort", "int", "uint"}) {
      expect_square(mesh_of(square(format, type, "uchar", "int"), report));
      expect_square(mesh_of(square(format, "float", "int", type == "float" ? "uint" : type), report));
    }
    for (const std::string newline : {"\n", "\r\n", "\r"})
      expect_square(mesh_of(square(format, "float", "uchar", "int", newline), report));
  }
  EXPECT_TRUE(report.warnings.empty());
}

TEST(Ply, KeepsABinaryBodyThatBeginsLikeALineEnd) {
  auto file = square("binary_little_endian", "float", "uchar", "int");
  const auto body =
      std::search(file.begin(), file.end(), std::begin("end_header\n"), std::end("end_header\n") - 1) + 11;
  const float x = std::bit_cast<float>(0x3f80000du);  // its first byte is a carriage return
  std::memcpy(&*body, &x, 4);
  Report report;
  const auto mesh = mesh_of(file, report);
  ASSERT_TRUE(mesh) << mesh.error().message();
  EXPECT_EQ(mesh->positions[0][0], x);
}

TEST(Ply, ReadsAttributesInAnyOrder) {
  const auto mesh = read(
      "ply\nformat ascii 1.0\nelement face 1\nproperty float quality\nproperty list uchar int vertex_index\n"
      "element odd 1\nproperty list int float numbers\nproperty short tag\n"
      "element vertex 4\nproperty uchar blue\nproperty uchar red\nproperty uchar green\nproperty uchar alpha\n"
      "property float nz\nproperty float nx\nproperty float ny\nproperty list uchar uchar labels\n"
      "property float t\nproperty float s\nproperty float z\nproperty float y\nproperty float x\nend_header\n"
      "0.5 3 3 1 0\n"
      "2 1.5 2.5 -7\n"
      "255 0 128 51  2 0 0  0  0.25 0.5  3 2 1\n"
      "0 0 0 255  0 1 0  2 9 9  0 0  0 0 0\n"
      "9 9 9 9  9 9 9  0  9 9  9 9 9\n"
      "0 255 0 255  0 0 0  0  1 1  0 0 1\n");
  ASSERT_TRUE(mesh) << mesh.error().message();
  ASSERT_EQ(mesh->positions.size(), 3u);  // vertex 2 has no face
  EXPECT_EQ(mesh->faces, (std::vector<Face>{{2, 1, 0}}));
  EXPECT_EQ(mesh->positions[0], (Vec3f{{1, 2, 3}}));
  EXPECT_EQ(mesh->normals[0], (Vec3f{{0, 0, 1}}));
  EXPECT_NEAR(length(mesh->normals[2]), 1, 1e-6);  // made, since the file's has no length
  EXPECT_EQ(mesh->texcoords[0][0], (Vec2f{{0.5f, 0.75f}}));
  EXPECT_NEAR(mesh->colors[0][0], 0, 1e-6);
  EXPECT_NEAR(mesh->colors[0][1], srgb_to_linear(uint8_t(128)), 1e-6);
  EXPECT_NEAR(mesh->colors[0][2], 1, 1e-6);
  EXPECT_NEAR(mesh->colors[0][3], 0.2, 1e-6);
}

const std::string five_points =
    "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n";
const std::string five_positions = "0 0 0\n2 0 0\n2 2 0\n1 0.5 0\n0 2 0\n";

TEST(Ply, CutsPolygonsAndWarnsOfFacesWithoutArea) {
  Report report;
  const auto mesh =
      mesh_of(bytes_of(five_points + "element face 3\nproperty list uchar int vertex_indices\nend_header\n" +
                       five_positions + "5 0 1 2 3 4\n2 0 1\n0\n"),
              report);
  ASSERT_TRUE(mesh) << mesh.error().message();
  EXPECT_EQ(mesh->faces.size(), 3u);
  for (const Vec3f& normal : mesh->normals) EXPECT_GT(normal[2], 0.9f);
  EXPECT_EQ(report.warnings.size(), 1u);
}

TEST(Ply, NamesWhatItLeavesOut) {
  Report report;
  ASSERT_TRUE(mesh_of(bytes_of("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                               "property float z\nproperty float confidence\nelement face 1\n"
                               "property list uchar int vertex_indices\nproperty list uchar float texcoord\n"
                               "end_header\n0 0 0 1\n1 0 0 1\n0 1 0 1\n3 0 1 2 0\n"),
                      report));
  EXPECT_EQ(report.warnings,
            std::vector<std::string>{"properties left out, not supported: vertex.confidence, face.texcoord"});
}

TEST(Ply, ReadsStrips) {
  const auto mesh = read(five_points + "element tristrips 1\nproperty list int int vertex_indices\nend_header\n" +
                         five_positions + "9 0 1 4 2 -1 0 3 3 1\n");
  ASSERT_TRUE(mesh) << mesh.error().message();
  EXPECT_EQ(mesh->faces, (std::vector<Face>{{0, 1, 3}, {3, 1, 2}}));  // vertex 3 is dropped
}

TEST(Ply, RefusesFaultsByName) {
  const std::string faces = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const auto element_of_error = [&](const std::string& text) {
    const auto mesh = read(text);
    EXPECT_FALSE(mesh) << text;
    if (mesh) return std::string();
    EXPECT_EQ(mesh.error().message().find('\n'), std::string::npos);
    return mesh.error().element;
  };
  EXPECT_EQ(element_of_error(five_points + faces + five_positions + "3 0 1 5\n"), "face 0");
  EXPECT_EQ(element_of_error(five_points + faces + five_positions + "3 0 1 -1\n"), "face 0");
  EXPECT_EQ(element_of_error(five_points + faces + five_positions + "3 0 1 0.5\n"), "face 0");
  EXPECT_EQ(element_of_error(five_points + faces + five_positions + "-3 0 1 2\n"), "face 0");
  EXPECT_EQ(element_of_error(five_points + faces + five_positions + "3 0 1\n"), "face 0");
  EXPECT_EQ(element_of_error(five_points + faces + "0 0 0\n0 zero 0\n2 2 0\n1 1 0\n0 2 0\n3 0 1 2\n"), "vertex 1");
  EXPECT_EQ(element_of_error(five_points + faces + "0 0 0\n2 0 0\n2 nan 0\n1 1 0\n0 2 0\n3 0 1 2\n"), "vertex 2");
  EXPECT_EQ(element_of_error(five_points + faces + "0 0 0\n2 0 0\n2 2 0\n1 1e30 0\n0 2 0\n3 0 1 2\n"), "vertex 3");
  EXPECT_EQ(element_of_error(five_points + "end_header\n" + five_positions), "");
  EXPECT_EQ(element_of_error("ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nend_header\n"),
            "header");
  EXPECT_EQ(element_of_error("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n" + faces + "1\n3 0 0 0\n"),
            "header");
  EXPECT_EQ(
      element_of_error("ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int corners\nend_header\n1 0\n"),
      "header");
  EXPECT_EQ(element_of_error("ply\nelement vertex 0\nend_header\n"), "header");
  EXPECT_EQ(element_of_error("ply\nformat binary_middle_endian 1.0\nend_header\n"), "header");
  EXPECT_EQ(element_of_error("ply\nformat ascii 1.0\nelement vertex -1\nend_header\n"), "header");
  EXPECT_EQ(element_of_error("ply\nformat ascii 1.0\nproperty float x\nend_header\n"), "header");
  EXPECT_EQ(element_of_error("ply\nformat ascii 1.0\nelement v 1\nproperty list float x\nend_header\n"), "header");
  EXPECT_EQ(element_of_error("ply\nformat ascii 1.0\nelement v 1\nproperty real x\nend_header\n"), "header");
  EXPECT_EQ(element_of_error("ply\nformat ascii 1.0\nnonsense\nend_header\n"), "header");
  EXPECT_EQ(element_of_error("ply\nformat ascii 1.0\nelement vertex 3\n"), "header");
  EXPECT_EQ(element_of_error("plymouth\n"), "header");
}

TEST(Ply, AsksForNoMoreMemoryThanTheFileAccountsFor) {
  // Lists that announce more than can follow.
  const std::string header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uint int vertex_indices\nend_header\n";
  PlyWriter writer("binary_little_endian");
  writer.text(header);
  for (int i = 0; i < 3; i++) writer.number("float", 0);
  writer.number("uint", 4e9);
  Report report;
  const auto mesh = mesh_of(writer.data(), report);
  ASSERT_FALSE(mesh);
  EXPECT_EQ(mesh.error().element, "face 0");
}

TEST(Ply, RefusesEveryPrefix) {
  for (const std::string format : {"binary_little_endian", "binary_big_endian"}) {
    const auto file = square(format, "short", "uchar", "ushort");
    for (size_t size = 0; size < file.size(); size++) {
      Report report;
      ASSERT_FALSE(mesh_of(Bytes(file).first(size), report)) << size;
    }
  }
  // A shorter text may still be whole: the last number has fewer digits.
  const auto file = square("ascii", "float", "uchar", "int");
  for (size_t size = 0; size + 2 < file.size(); size++) {
    Report report;
    ASSERT_FALSE(mesh_of(Bytes(file).first(size), report)) << size;
  }
}

TEST(Ply, SurvivesDamage) {
  Random random(4, 0);
  for (const std::string format : all_formats) {
    const auto file = square(format, "float", "uchar", "int");
    for (int i = 0; i < 3000; i++) {
      auto damaged = file;
      for (uint32_t n = 1 + random.below(3); n > 0; n--)
        damaged[random.below(static_cast<uint32_t>(file.size()))] = static_cast<uint8_t>(random.below(256));
      Report report;
      const auto mesh = mesh_of(damaged, report);
      if (!mesh) continue;
      ASSERT_EQ(mesh->normals.size(), mesh->positions.size());
      for (const Face& face : mesh->faces) {
        for (const uint32_t corner : face) ASSERT_LT(corner, mesh->positions.size());
      }
    }
  }
}

// The cube of doubles at coordinates of a survey, to whose digits floats do not reach.
TEST(Ply, CountsFarPositionsFromAnOriginAmidThem) {
  const Vec3d place{{500000.125, 4649776.25, 100}};
  for (const std::string format : all_formats) {
    PlyWriter writer(format);
    writer.text("ply\nformat " + format + " 1.0\nelement vertex 4\nproperty double x\nproperty double y\n" +
                "property double z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n");
    const std::vector<Vec3d> corners = {{{0, 0, 0}}, {{0.1, 0, 0}}, {{0.1, 0.1, 0}}, {{0, 0.1, 0.1}}};
    for (const Vec3d& corner : corners)
      for (const double x : (place + corner).e) writer.number("double", x);
    for (const auto& face : std::vector<std::vector<double>>{{0, 1, 2}, {0, 2, 3}}) {
      writer.number("uchar", 3);
      for (const double corner : face) writer.number("int", corner);
    }
    Report report;
    const auto content = read_ply(writer.data(), report);
    ASSERT_TRUE(content) << content.error().message();
    for (size_t i = 0; i < corners.size(); i++) {
      // Of a double at 4.6e6: 1e-9; the text has 9 digits.
      const double tolerance = format == "ascii" ? 0.02 : 2e-8;
      const Vec3d found = content->parts[0].mesh.positions[i].cast<double>() + content->origin;
      EXPECT_LE(length(found - place - corners[i]), tolerance);
    }
  }
}

/// A square of two triangles with what a test adds to its faces and header.
std::string textured(const std::string& comments, const std::string& vertex, const std::string& face,
                     const std::string& data) {
  return "ply\nformat ascii 1.0\n" + comments +
         "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n" + vertex +
         "element face 2\nproperty list uchar int vertex_indices\n" + face + "end_header\n" + data;
}

PlyContent content_of(const std::string& text, Report& report) {
  auto content = read_ply(bytes_of(text), report);
  EXPECT_TRUE(content) << content.error().message();
  return content ? std::move(*content) : PlyContent();
}

TEST(Ply, TakesTexturesByVertex) {
  Report report;
  const PlyContent content =
      content_of(textured("comment TextureFile a photo.png\n", "property float texture_u\nproperty float texture_v\n",
                          "", "0 0 0 0 0\n1 0 0 1 0\n1 1 0 1 1\n0 1 0 0 1\n3 0 1 2\n3 0 2 3\n"),
                 report);
  ASSERT_EQ(content.parts.size(), 1u);
  EXPECT_EQ(content.parts[0].texture, 0);
  EXPECT_EQ(content.textures, std::vector<std::string>{"a photo.png"});
  EXPECT_EQ(content.parts[0].mesh.positions.size(), 4u);
  EXPECT_EQ(content.parts[0].mesh.texcoords[0][2], (Vec2f{{1, 0}}));  // v is downwards in glTF
  EXPECT_EQ(report.warnings, std::vector<std::string>());
}

// As MeshLab and OpenMVS write them: coordinates for every corner, and the number of the texture.
TEST(Ply, TakesTexturesByFace) {
  Report report;
  const PlyContent content =
      content_of(textured("comment TextureFile a.png\ncomment texturefile b.png\n", "",
                          "property list uchar float texcoord\nproperty int texnumber\n",
                          "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 6 0 0 1 0 1 1 1\n3 0 2 3 6 0.5 0.25 0 0 0 0 0\n"),
                 report);
  ASSERT_EQ(content.parts.size(), 2u);
  EXPECT_EQ(content.parts[0].texture, 0);
  EXPECT_EQ(content.parts[1].texture, 1);
  EXPECT_EQ(content.parts[0].mesh.texcoords[0], (std::vector<Vec2f>{{{0.5f, 0.75f}}, {{0, 1}}, {{0, 1}}}));
  EXPECT_EQ(content.parts[1].mesh.texcoords[0], (std::vector<Vec2f>{{{0, 1}}, {{1, 1}}, {{1, 0}}}));
  for (const PlyPart& part : content.parts) EXPECT_EQ(part.mesh.normals, std::vector<Vec3f>(3, {{0, 0, 1}}));
  EXPECT_EQ(report.warnings, std::vector<std::string>());
}

TEST(Ply, FacesWithoutCoordinatesHaveNoTexture) {
  Report report;
  const PlyContent content =
      content_of(textured("comment TextureFile a.png\n", "", "property list uchar float texcoord\n",
                          "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 6 0 0 1 0 1 1\n3 0 2 3 0\n"),
                 report);
  ASSERT_EQ(content.parts.size(), 2u);
  EXPECT_EQ(content.parts[0].texture, -1);
  EXPECT_EQ(content.parts[1].texture, 0);
}

TEST(Ply, SaysWhichTextureIsNotUsed) {
  Report report;
  content_of(textured("comment TextureFile a.png\n", "", "", "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n"), report);
  EXPECT_EQ(report.warnings,
            std::vector<std::string>{"texture a.png: no face has texture coordinates in it; left out"});
}

TEST(Ply, TexturesAreNamedAfterTheFile) {
  Report report;
  const std::string text = textured("comment TextureFile <this>_A.png\n", "property float s\nproperty float t\n", "",
                                    "0 0 0 0 0\n1 0 0 1 0\n1 1 0 1 1\n0 1 0 0 1\n3 0 1 2\n3 0 2 3\n");
  const auto document = ply_document(bytes_of(text), "folder", "my scan", report);
  ASSERT_TRUE(document);
  EXPECT_EQ(document->json["images"][0]["uri"], "my%20scan_A.png");
  EXPECT_EQ(document->json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"], 0);
}

TEST(Ply, RefusesPointsAsWhatTheyAre) {
  const auto reason = [](const std::string& properties) {
    Report report;
    const auto content =
        read_ply(bytes_of("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                          "property float z\n" +
                          properties + "end_header\n0 0 0 1\n"),
                 report);
    return content ? std::string() : content.error().reason;
  };
  EXPECT_NE(reason("").find("point cloud"), std::string::npos);
  EXPECT_NE(reason("property float f_dc_0\n").find("Gaussian splats"), std::string::npos);
}

}  // namespace
}  // namespace lightwell
