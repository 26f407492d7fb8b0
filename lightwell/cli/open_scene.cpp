// SPDX-License-Identifier: Apache-2.0
#include "lightwell/cli/open_scene.h"

#include <filesystem>

#include "lightwell/bake/sky_dome.h"
#include "lightwell/bake/turned.h"
#include "lightwell/cli/input_file.h"
#include "lightwell/cli/memory_limit.h"
#include "lightwell/packing/unpack.h"
#include "lightwell/render/overview.h"
#include "lightwell/scene/builtin.h"
#include "lightwell/scene/import_gltf.h"
#include "lightwell/scene/noted_sky.h"
#include "lightwell/scene/physical_sky.h"
#include "lightwell/scene/sun_of_sky.h"

namespace lightwell {
namespace {

Result<OpenedScene> open_pack(const std::string& path, const MeshLevel& level, ImageLimit images, Report& report) {
  LW_TRY(pack, OpenedPack::open_file(path));
  LW_TRY(document, unpack_document(pack, level, report));
  LW_CHECK(unpack_parts(pack, document));
  LW_TRY(scene, scene_from_document(std::move(document), std::filesystem::path(path).stem().string(), report,
                                    pack.identity().origin, images));
  LW_TRY(surroundings, unpack_environment(pack, images));
  // What the document notes of a sky is exact.
  if (surroundings && scene.environment.radiance == Vec3f{})
    scene.environment = {Vec3f::filled(1), std::make_shared<RadianceImage>(std::move(*surroundings))};
  return OpenedScene{std::move(scene), std::move(pack)};
}

Result<OpenedScene> open_other(const std::string& path, const ImportOptions& options, Report& report) {
  LW_TRY(scene, load_scene(path, options, report));
  return OpenedScene{std::move(scene), std::nullopt};
}

// Replaces the scene's own surroundings by those that are asked for.
Result<void> surround(Scene& scene, const SceneOptions& options) {
  if (options.sky) return light_by_sky(scene, *options.sky);
  if (options.environment.empty()) return {};
  LW_TRY(surroundings, read_environment(options.environment, options.import.images));
  NotedSky noted;
  if (!surroundings.map) noted.radiance = surroundings.radiance;
  note_sky(scene.document.json, noted);
  if (const auto sun = take_sun(surroundings)) add_sun(scene, *sun);
  scene.environment = std::move(surroundings);
  return {};
}

// Refuses --up, --front, --rotate, --unit, --lamp-units and --scene for packs and built-in scenes, which have their
// own.
Result<void> refuse_conventions(const std::string& path, const ImportOptions& asked) {
  if (!asked.scene.empty()) return fail({path, "", "holds one scene; --scene is for files of other programs"});
  if (asked.lamp_units == LampUnits::photometric)
    return fail({path, "", "has lamps in watts; --lamp-units is for files of other programs"});
  if (asked.orientation.none()) return {};
  return fail({path, "", "is in metres with y up; --up, --front, --rotate and --unit are for files of other programs"});
}

Result<OpenedScene> open_named(const std::string& path, const SceneOptions& options, Report& report,
                               const MeshLevel& level) {
  if (options.memory_limit > 0) limit_memory(options.memory_limit);
  const bool pack = is_pack_file(path);
  if (!options.import.orientation.possible()) return fail("--front", "lies along --up: give another axis");
  if (pack || find_builtin_scene(path) != nullptr) LW_CHECK(refuse_conventions(path, options.import));
  auto opened = pack ? open_pack(path, level, options.import.images, report) : open_other(path, options.import, report);
  if (!opened) return fail(in_file(opened.error(), path));
  LW_CHECK(check_memory(opened->scene, options.memory_limit > 0 ? options.memory_limit : machine_memory()));
  LW_CHECK(surround(opened->scene, options));
  LW_CHECK(take_sky_dome(opened->scene, report));
  if (pack && contents_of(opened->pack->grids()).environment && EnvironmentLight(opened->scene.environment).black())
    report.warn("environment: the pack has its light but not its picture: give it with --environment");
  return opened;
}

}  // namespace

Result<OpenedScene> open_scene(const SceneOptions& options, Report& report, const MeshLevel& level) {
  LW_TRY(opened,
         with_input(options.path, [&](const std::string& path) { return open_named(path, options, report, level); }));
  if (options.path == "-") opened.scene.name = "stdin";
  return std::move(opened);
}

Result<std::unique_ptr<const World>> ready(OpenedScene& opened, int threads, Progress& progress, Report& report) {
  if (opened.pack) return World::build(opened.scene, threads);
  return world_facing_light(opened.scene, threads, progress, report);
}

Result<Camera> choose_camera(const World& world, const std::string& choice) {
  const Scene& scene = world.scene();
  if (choice.empty()) return scene.cameras.empty() ? overview_camera(world) : scene.cameras.front();
  for (const Camera& camera : scene.cameras)
    if (camera.name == choice) return camera;
  const auto number = parse_count(choice);
  if (number && *number < scene.cameras.size()) return scene.cameras[*number];
  return fail("camera " + choice, "is not in the scene, which has " + std::to_string(scene.cameras.size()));
}

}  // namespace lightwell
