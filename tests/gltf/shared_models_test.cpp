// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <fstream>
#include <iostream>
#include <map>
#include <sstream>

#include "lightwell/base/file.h"
#include "lightwell/gltf/document.h"

namespace lightwell {
namespace {

namespace fs = std::filesystem;

const fs::path data = fs::path(LIGHTWELL_SHARED) / "data";

Result<Document> read_file_document(const fs::path& path, Report& report) {
  LW_TRY(bytes, read_file(path));
  return read_document(bytes, path.parent_path(), report);
}

/// Triangles of all primitives, each counted once.
Result<size_t> count_triangles(const Document& document, Report& report) {
  size_t triangles = 0;
  const Json& meshes = member(document.json, "meshes");
  for (size_t m = 0; m < meshes.size(); m++)
    for (size_t p = 0; p < meshes[m]["primitives"].size(); p++) {
      if (!has_triangles(meshes[m]["primitives"][p])) continue;
      LW_TRY(mesh, read_primitive(document, static_cast<int>(m), static_cast<int>(p), report));
      triangles += mesh.faces.size();
    }
  return triangles;
}

bool is_gltf_file(const std::string& name) { return name.ends_with(".glb") || name.ends_with(".gltf"); }

/// The column "triangles" of data/README.md by path below data/.
std::map<std::string, size_t> stated_triangles() {
  std::map<std::string, size_t> stated;
  std::ifstream readme(data / "README.md");
  std::string folder;
  for (std::string line; std::getline(readme, line);) {
    if (line.starts_with("## ")) folder = line.substr(3);
    std::istringstream cells(line);
    std::string cell[4];
    for (std::string& c : cell) std::getline(cells, c, '|');
    const auto trim = [](const std::string& text) {
      const size_t begin = text.find_first_not_of(' '), end = text.find_last_not_of(' ');
      return begin == std::string::npos ? std::string() : text.substr(begin, end - begin + 1);
    };
    const std::string name = trim(cell[1]), triangles = trim(cell[3]);
    if (is_gltf_file(name) && !triangles.empty()) stated[folder + name] = std::stoull(triangles);
  }
  return stated;
}

TEST(SharedModels, HaveTheStatedTriangles) {
  if (!fs::exists(data)) GTEST_SKIP() << data << " is missing";
  for (const auto& [name, triangles] : stated_triangles()) {
    SCOPED_TRACE(name);
    Report report;
    const auto document = read_file_document(data / name, report);
    if (name.ends_with("Compatibility_04.gltf") || name.ends_with("Compatibility_05.gltf")) {
      EXPECT_FALSE(document);  // asks for glTF 2.1; requires an extension that nobody knows
      continue;
    }
    ASSERT_TRUE(document) << document.error().message();
    const auto counted = count_triangles(*document, report);
    ASSERT_TRUE(counted) << counted.error().message();
    EXPECT_EQ(*counted, triangles);
  }
}

TEST(SharedModels, BrokenOnesAreRefusedInOneLineOrRead) {
  if (!fs::exists(data)) GTEST_SKIP() << data << " is missing";
  for (const auto& entry : fs::recursive_directory_iterator(data / "broken")) {
    if (!is_gltf_file(entry.path().filename())) continue;
    SCOPED_TRACE(entry.path());
    Report report;
    const auto document = read_file_document(entry.path(), report);
    const auto counted = document ? count_triangles(*document, report) : fail(document.error());
    if (counted) continue;
    EXPECT_FALSE(counted.error().reason.empty());
    EXPECT_EQ(counted.error().message().find('\n'), std::string::npos);
  }
}

}  // namespace
}  // namespace lightwell
