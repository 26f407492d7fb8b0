// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <optional>
#include <string_view>

#include "lightwell/base/file.h"
#include "lightwell/scene/builtin.h"
#include "lightwell/scene/import_assimp.h"
#include "lightwell/scene/import_draco.h"
#include "lightwell/scene/import_gltf.h"
#include "lightwell/scene/import_obj.h"
#include "lightwell/scene/lamp_units.h"
#include "lightwell/scene/obj_text.h"
#include "lightwell/scene/plain_images.h"
#include "lightwell/scene/ply.h"
#include "lightwell/scene/scene.h"
#include "lightwell/scene/stl.h"
#include "lightwell/texture/image_format.h"

namespace lightwell {
namespace {

std::string_view text_of(Bytes bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

std::string_view without_leading_space(std::string_view text) {
  return text.substr(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
}

/// The name of a file format that Lightwell recognises but does not read.
std::optional<std::string> unsupported_format(Bytes file) {
  using namespace std::string_view_literals;
  constexpr std::pair<std::string_view, const char*> beginnings[] = {
      {"\x76\x2f\x31\x01"sv, "an OpenEXR picture"},
      {"#?"sv, "a Radiance picture; --environment takes it"},
      {"Kaydara FBX Binary"sv, "an FBX file; export it as glTF"},
      {"; FBX"sv, "an FBX file; export it as glTF"},
      {"BLENDER"sv, "a Blender file; export it as glTF"},
      {"PXR-USDC"sv, "a USD file; export it as glTF"},
      {"#usda"sv, "a USD file; export it as glTF"},
      {"PK\x03\x04"sv, "a ZIP archive"},
      {"<"sv, "an XML file"},
      {"LASF"sv, "a point cloud (LAS); Lightwell takes meshes"},
      {"NGSP"sv, "Gaussian splats (SPZ); Lightwell takes meshes"},
      {"\xfe\xff"sv, "UTF-16 text; save it as UTF-8"},
      {"\xff\xfe"sv, "UTF-16 text; save it as UTF-8"},
  };
  const std::string_view text = text_of(file);
  for (const auto& [beginning, name] : beginnings) {
    if (text.starts_with(beginning)) return name;
  }
  if (image_format(file)) return "a picture";
  if (without_leading_space(text).starts_with('{') && text.find("\"asset\"") == text.npos)
    return "JSON that is no glTF";
  return std::nullopt;
}

std::string list_of_builtin_scenes() {
  std::string list;
  for (const BuiltinScene& scene : builtin_scenes()) list += (list.empty() ? "" : ", ") + std::string(scene.name);
  return list;
}

/// "dragon" of "scans/dragon.ply.gz".
std::string scene_name(std::filesystem::path path) {
  if (path.extension() == ".gz") path = path.stem();
  return path.stem().string();
}

/// What a file of no format of ours becomes: a document where assimp was built in, else the refusal.
Result<Document> document_of_other([[maybe_unused]] Bytes file, [[maybe_unused]] const std::filesystem::path& path,
                                   const std::string& refusal, [[maybe_unused]] Report& report) {
#ifdef LIGHTWELL_ASSIMP
  auto document = assimp_document(file, path, report);
  if (document) return document;
  return fail(ErrorKind::unsupported, "", refusal + " (" + document.error().message() + ")");
#else
  return fail(ErrorKind::unsupported, "", refusal);
#endif
}

Result<Document> document_of(Bytes file, const std::filesystem::path& path, ImageLimit limit, Report& report) {
  const std::filesystem::path folder = path.parent_path();
  if (file.empty()) return fail("", "is empty");
  if (is_ply(file)) return ply_document(file, folder, scene_name(path), report);
  if (const auto format = unsupported_format(file))
    return document_of_other(file, path, "cannot be read: it is " + *format, report);
  if (is_draco(file)) return draco_document(file);
  if (is_stl(file)) return stl_document(file, report);
  if (is_gltf(file)) return read_document(file, folder, report);
  if (is_obj(file)) return obj_document(file, folder, report, limit);
  return document_of_other(file, path, "is neither glTF, OBJ, PLY, STL nor Draco", report);
}

Result<Scene> load_file(const std::filesystem::path& path, const ImportOptions& options, Report& report) {
  constexpr bool inflate = true;
  LW_TRY(file, read_file(path, inflate));
  LW_TRY(document, document_of(file, path, options.images, report));
  file = {};  // the document has its own copy of what it needs
  LW_CHECK(choose_scene(document, options.scene, report));
  name_variants(document.json, report);
  make_lamps_radiometric(document, options.lamp_units, report);
  reorient(document, options.orientation);
  make_images_plain(document, options.images);
  return scene_from_document(std::move(document), scene_name(path), report, {}, options.images);
}

}  // namespace

Result<Scene> load_scene(const std::string& path, const ImportOptions& options, Report& report) {
  if (const BuiltinScene* builtin = find_builtin_scene(path))
    return scene_from_document(builtin->make(options.seed), path, report);
  std::error_code code;
  if (!std::filesystem::exists(path, code))
    return fail({path, "", "no such file, nor one of the built-in scenes " + list_of_builtin_scenes(), ErrorKind::io});
  auto scene = load_file(path, options, report);
  if (!scene) return fail(in_file(std::move(scene.error()), path));
  return scene;
}

}  // namespace lightwell
