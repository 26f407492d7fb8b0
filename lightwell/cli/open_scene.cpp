// SPDX-License-Identifier: Apache-2.0
#include "lightwell/cli/open_scene.h"

#include <filesystem>

#include "lightwell/bake/unpack.h"
#include "lightwell/cli/arguments.h"
#include "lightwell/scene/import_gltf.h"

namespace lightwell {
namespace {

Result<Scene> scene_of_pack(const std::string& path, Report& report) {
  LW_TRY(pack, PackReader::open_file(path));
  LW_TRY(document, unpack_document(pack, MeshLevel{}, report));
  return scene_from_document(std::move(document), std::filesystem::path(path).stem().string(), report);
}

}  // namespace

bool is_pack(const std::string& path) { return PackReader::open_file(path).has_value(); }

Result<Scene> open_scene(const std::string& path, const ImportOptions& options, const std::string& environment,
                         Report& report) {
  auto scene = is_pack(path) ? scene_of_pack(path, report) : load_scene(path, options, report);
  if (!scene) return fail(in_file(scene.error(), path));
  if (!environment.empty()) {
    LW_TRY(surroundings, read_environment(environment));
    scene->environment = std::move(surroundings);
  }
  return scene;
}

Result<LightGrid> open_light(const std::string& path) {
  auto grid = [&]() -> Result<LightGrid> {
    LW_TRY(pack, PackReader::open_file(path));
    LW_TRY(stream, find_light_stream(pack));
    return unpack_light(pack, stream);
  }();
  if (!grid) return fail(in_file(grid.error(), path));
  return grid;
}

}  // namespace lightwell
