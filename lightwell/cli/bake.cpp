// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "lightwell/bake/enclosed_lamps.h"
#include "lightwell/bake/lamps.h"
#include "lightwell/bake/turned.h"
#include "lightwell/base/file.h"
#include "lightwell/cli/arguments.h"
#include "lightwell/cli/open_scene.h"
#include "lightwell/packing/pack_scene.h"
#include "lightwell/render/exposure.h"
#include "lightwell/scene/camera.h"

namespace lightwell {
namespace {

struct Options {
  SceneOptions scene;
  std::string output;
  PackOptions pack;
  LightNodeOrder order = LightNodeOrder::lattice;
};

// Everything that a bake makes, in the order in which it is made.
struct Bake {
  Scene scene;
  std::unique_ptr<const World> world;
  Camera camera;  // where a viewer begins
  LampPlan plan;
  LightField field;
  PackLight light;
  std::vector<uint8_t> file;
  LightBakeStatistics light_statistics;
  PackStatistics pack_statistics;
  double import_seconds = 0, light_seconds = 0, geometry_seconds = 0, write_seconds = 0;
  Report report;
};

bool is_dark(const LightField& field) {
  for (const LightField::Layer& layer : field.layers())
    for (const Moments& node : layer.grid.moments)
      for (const Vec3f& moment : node.m)
        if (moment != Vec3f{}) return false;
  return true;
}

Result<void> import_scene(const Options& options, Progress& progress, Bake& bake) {
  LW_TRY(opened, open_scene(options.scene, bake.report));
  bake.scene = std::move(opened.scene);
  LW_TRY(world, world_facing_light(bake.scene, options.scene.threads, progress, bake.report));
  bake.world = std::move(world);
  return {};
}

Result<void> bake_grid(const Options& options, Progress& progress, Bake& bake) {
  const World& world = *bake.world;
  warn_of_enclosed_lamps(world, bake.report);
  bake.plan = plan_lamps(world);
  const LuminaireSet& contained = bake.plan.contained;
  LW_TRY(grids, bake_light(world, options.scene.light(contained), progress, bake.light_statistics));
  bake.light.lamps = bake.plan.client;
  PackGrid stated;
  stated.order = options.order;
  stated.seed = options.scene.import.seed;
  const std::vector<Luminaire>& luminaires = world.lights().luminaires();
  for (size_t i = 0; i < luminaires.size(); i++) {
    if (!contained.contains(static_cast<int>(i))) continue;
    (luminaires[i].kind() == Luminaire::Kind::environment ? stated.contains.environment : stated.contains.lamps) = true;
  }
  LW_TRY(camera, choose_camera(world, ""));
  bake.camera = camera;
  std::vector<float> errors;
  for (const BakedGrid& grid : grids) errors.push_back(grid.estimated_error);
  bake.field = field_of(std::move(grids), stated.contains);
  if (is_dark(bake.field)) bake.report.warn("no light reaches the free space of the scene: its light grid is black");
  for (size_t i = 0; i < errors.size(); i++) {
    const LightField::Layer& layer = bake.field.layers()[i];
    stated.grid = &layer.grid;
    stated.priority = layer.priority;
    stated.estimated_error = errors[i];
    bake.light.grids.push_back(stated);
  }
  bake.light.exposure = choose_exposure(world, camera, bake.field, contained, options.scene.threads);
  return {};
}

Result<void> run(const Options& options, Progress& progress, Bake& bake) {
  LW_CHECK(check_output(options.output, {options.scene.path, options.scene.environment}));
  Stopwatch watch;
  progress.stage("importing", 0, "");
  LW_CHECK(import_scene(options, progress, bake));
  bake.import_seconds = watch.lap();
  LW_CHECK(bake_grid(options, progress, bake));
  bake.light_seconds = watch.lap();
  const float extent = length(bake.world->surfaces().focus().size());
  bake.world.reset();
  if (bake.scene.cameras.empty()) add_camera(bake.scene.document, bake.camera, 1e-3f * extent);
  LW_TRY(file, make_pack(bake.scene, bake.light, options.pack, progress, bake.report, bake.pack_statistics));
  bake.file = std::move(file);
  bake.geometry_seconds = watch.lap();
  LW_CHECK(write_file(options.output, bake.file));
  bake.write_seconds = watch.lap();
  return {};
}

nlohmann::ordered_json figures(const Options& options, const Bake& bake) {
  return {{"triangles", bake.pack_statistics.triangles},
          {"vertices", bake.pack_statistics.vertices},
          {"nodes", bake.light_statistics.nodes},
          {"photons", options.scene.photons},
          {"rays", bake.light_statistics.rays},
          {"seconds",
           {{"import", bake.import_seconds},
            {"light", bake.light_seconds},
            {"geometry", bake.geometry_seconds},
            {"write", bake.write_seconds}}},
          {"rays_per_second", static_cast<double>(bake.light_statistics.rays) / bake.light_seconds},
          {"peak_memory", peak_memory()},
          {"pack_bytes", bake.file.size()},
          {"bytes",
           {{"opening", bake.pack_statistics.opening_bytes},
            {"geometry", bake.pack_statistics.geometry_bytes},
            {"light", bake.pack_statistics.light_bytes},
            {"texture", bake.pack_statistics.texture_bytes}}},
          {"estimated_error", bake.light_statistics.estimated_error},
          {"warnings", bake.report.warnings}};
}

int bake_scene(const Options& options, const Console& console) {
  Bake bake;
  const auto outcome = with_progress(console, [&](Progress& progress) { return run(options, progress, bake); });
  if (!console.json) console.warn(bake.report);
  if (!outcome) return console.fail(in_file(outcome.error(), options.scene.path));
  nlohmann::ordered_json result = figures(options, bake);
  if (!console.json) result.erase("warnings");
  if (options.output != "-") console.print(result);
  return 0;
}

}  // namespace

CLI::App* add_bake(CLI::App& program, Console& console, std::function<int()>& chosen) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add_subcommand("bake", "Imports a scene, traces its light, orders its meshes, writes a pack");
  add_output(*command, options->output, {".glb"}, "The pack to write, FILE.glb; - is stdout")->required();
  add_scene_options(*command, options->scene, "A glTF, OBJ or PLY file, a pack, or a built-in scene");
  add_number(*command, "--position-error", options->pack.position_error, {1e-9, 1e9},
             "How far a vertex may move at most, in metres (default: a 32,000th of its mesh's longest side)");
  add_choice<LightNodeOrder>(
      *command, "--order", options->order, {{"lattice", LightNodeOrder::lattice}, {"slices", LightNodeOrder::slices}},
      "How the light grid is streamed: from coarse to fine, or some nodes of every slice of a regular grid");
  command->footer(
      "Examples:\n  lightwell bake room.glb -o room.lw.glb\n"
      "  lightwell bake scan.ply --unit 0.001 --up z --environment 1,1,1 -o scan.lw.glb");
  command->callback([=, &console, &chosen] {
    options->pack.threads = options->scene.threads;
    chosen = [=, &console] { return bake_scene(*options, console); };
  });
  return command;
}

}  // namespace lightwell
