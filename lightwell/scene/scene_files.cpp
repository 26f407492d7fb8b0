// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/scene_files.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "lightwell/base/file.h"
#include "lightwell/base/glb.h"
#include "lightwell/gltf/document.h"
#include "lightwell/gltf/resource.h"
#include "lightwell/scene/obj_text.h"
#include "lightwell/scene/ply.h"

namespace lightwell {
namespace {

namespace fs = std::filesystem;

/// The JSON of a glTF or GLB file; null when it cannot be read.
Json json_of(Bytes file) {
  ByteReader reader(file);
  Bytes text = file;
  if (reader.u32() == glb_magic) {
    reader.take(8);  // version and length
    const uint32_t length = reader.u32();
    reader.u32();  // the kind of chunk, which is JSON
    text = reader.take(length);
  }
  auto json = parse_json(text);
  return json ? std::move(*json) : Json();
}

std::vector<std::string> names_in_gltf(Bytes file) {
  const Json json = json_of(file);
  std::vector<std::string> names;
  for (const char* array : {"buffers", "images"})
    for (const Json& element : member(json, array))
      if (const std::string uri = text(element, "uri"); !uri.empty() && !uri.starts_with("data:"))
        names.push_back(decode_percent(uri));
  return names;
}

/// Names in the text of OBJ, MTL and PLY files: what follows a keyword, as a name with spaces or behind options.
std::vector<std::string> names_in_text(std::string_view text) {
  constexpr std::array<std::string_view, 8> keywords = {"mtllib ", "map_",  "bump ", "disp ",
                                                        "decal ",  "refl ", "norm ", "comment TextureFile "};
  std::vector<std::string> names;
  while (!text.empty()) {
    std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    line.remove_prefix(std::min(line.size(), line.find_first_not_of(" \t")));
    line = line.substr(0, line.find_last_not_of(" \t\r") + 1);
    const auto keyword = std::ranges::find_if(keywords, [&](std::string_view word) { return line.starts_with(word); });
    const size_t space = line.find(' ', keyword == keywords.end() ? 0 : keyword->size() - 1);
    if (keyword == keywords.end() || space == line.npos) continue;
    for (const size_t before : {space, line.find_last_of(" \t")}) {
      names.emplace_back(line.substr(before + 1));
      std::ranges::replace(names.back(), '\\', '/');
    }
  }
  return names;
}

std::vector<std::string> names_in(const fs::path& path) {
  const auto file = read_file(path, true);
  if (!file) return {};
  const std::string_view text(reinterpret_cast<const char*>(file->data()), file->size());
  if (is_gltf(*file)) return names_in_gltf(*file);
  if (is_ply(*file)) return names_in_text(text.substr(0, text.find("end_header")));
  return path.extension() == ".mtl" || is_obj(*file) ? names_in_text(text) : std::vector<std::string>{};
}

void add_file(const fs::path& path, std::vector<fs::path>& files) {
  if (std::ranges::find(files, path) != files.end()) return;
  files.push_back(path);
  for (const std::string& name : names_in(path)) {
    const fs::path named = path.parent_path() / fs::path(name);
    if (named.extension() == ".mtl")
      add_file(named, files);
    else if (std::ranges::find(files, named) == files.end())
      files.push_back(named);
  }
}

}  // namespace

std::vector<fs::path> files_of_scene(const fs::path& path) {
  std::vector<fs::path> files;
  add_file(path, files);
  return files;
}

}  // namespace lightwell
