// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "lightwell/bake/enclosed_lamps.h"
#include "lightwell/bake/lamps.h"
#include "lightwell/bake/node_journal.h"
#include "lightwell/bake/turned.h"
#include "lightwell/base/file.h"
#include "lightwell/cli/arguments.h"
#include "lightwell/cli/memory_limit.h"
#include "lightwell/cli/number_text.h"
#include "lightwell/cli/open_scene.h"
#include "lightwell/packing/grids_extension.h"
#include "lightwell/packing/pack_scene.h"
#include "lightwell/render/exposure.h"
#include "lightwell/scene/camera.h"
#include "lightwell/scene/up_axis.h"

namespace lightwell {
namespace {

struct Options {
  SceneOptions scene;
  std::string output;
  PackOptions pack;
  LightNodeOrder order = LightNodeOrder::lattice;
  LightRecord record = LightRecord::moments;
  std::optional<double> target_error;  // percent
  uint64_t budget = 0;                 // bytes; 0: not said
  std::optional<double> stop_after;    // seconds
  bool preview = false, resume = false;
  SkyApart sky_apart = SkyApart::as_needed;
};

/// What --preview stands for: enough to see whether a scene comes out right.
constexpr double preview_seconds = 2;

// Everything that a bake makes, in the order in which it is made.
struct Bake {
  Scene scene;
  std::unique_ptr<const World> world;
  Camera camera;  // where a viewer begins
  LampPlan plan;
  std::vector<LightGroup> groups;
  LightField field;
  bool dark = false;  // there is no light in it
  PackLight light;
  std::vector<uint8_t> file;
  std::unique_ptr<NodeJournal> journal;  // with --resume
  size_t resumed_nodes = 0;
  uint64_t photons = 0;
  LightBakeStatistics light_statistics;
  PackStatistics pack_statistics;
  uint64_t expected_memory = 0;
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

// Few scenes are kilometres long, many files are in millimetres or centimetres and do not say so.
void advise_on_unit(const Box3f& focus, Report& report) {
  constexpr float longest = 1000;
  const float extent = max_component(focus.size());
  if (extent > longest)
    report.warn("what the scene is about is " + grouped(static_cast<uint64_t>(extent)) +
                " m long: if the file's unit is the millimetre, --unit 0.001 says so");
}

void advise_on_conventions(const ImportOptions& asked, const World& world, Report& report) {
  if (asked.orientation.unit == 1) advise_on_unit(world.surfaces().focus(), report);
  if (asked.orientation.up == Orientation().up && asked.orientation.rotate == Vec3d{} && seems_z_up(world.scene()))
    report.warn("the scene seems to lie on its side: if the file's z axis points up, --up z says so");
}

Result<void> import_scene(const Options& options, Progress& progress, Bake& bake) {
  LW_TRY(opened, open_scene(options.scene, bake.report));
  bake.scene = std::move(opened.scene);
  bake.expected_memory = expected_memory(bake.scene, peak_memory());
  LW_TRY(world, world_facing_light(bake.scene, options.scene.threads, progress, bake.report));
  bake.world = std::move(world);
  if (!opened.pack) advise_on_conventions(options.scene.import, *bake.world, bake.report);
  return {};
}

std::string journal_name(const Options& options) { return options.output + ".journal"; }

/// Whether the nodes of the light are counted, not found.
bool is_regular(const Options& options) {
  // The stratified slices of S08 are those of a regular grid.
  return options.scene.nodes || options.order == LightNodeOrder::slices || !options.scene.method->node_by_node;
}

/// Refuses options that do not go together, before any work.
Result<void> check_options(const Options& options) {
  const bool limited = options.budget > 0 || options.stop_after || options.preview;
  if (limited && is_regular(options))
    return fail("--budget, --stop-after and --preview",
                "go with --grid auto, --order lattice and --method gather: a regular grid has the nodes that it has");
  if (options.order == LightNodeOrder::slices && options.record != LightRecord::moments)
    return fail("--record", "goes with --order lattice");
  if (options.resume && options.output == "-") return fail("--resume", "needs an output that is a file");
  return {};
}

Result<void> open_journal(const Options& options, Bake& bake) {
  if (!options.resume) return {};
  LW_TRY(journal, NodeJournal::open(journal_name(options)));
  bake.resumed_nodes = journal->size();
  bake.journal = std::move(journal);
  return {};
}

/// Removes the journal of a bake that is complete. One that the clock ended can still be continued.
void close_journal(const Options& options, Bake& bake) {
  if (bake.journal == nullptr || bake.light_statistics.refinement == Refinement::to_deadline) return;
  bake.journal.reset();
  std::error_code ignored;
  std::filesystem::remove(journal_name(options), ignored);
}

LightBakeOptions light_options(const Options& options, const Bake& bake) {
  LightBakeOptions light = options.scene.light(bake.plan.contained);
  light.groups = bake.groups;
  light.sky_apart = options.sky_apart;
  if (is_regular(options)) light.nodes = options.scene.nodes.value_or(SceneOptions::regular);
  if (options.target_error) light.target_error = static_cast<float>(*options.target_error / 100);
  if (options.budget > 0) light.most_bytes = options.budget;
  if (options.stop_after) light.seconds = *options.stop_after;
  light.draft = options.preview;
  if (options.preview) light.seconds = std::min(light.seconds, preview_seconds);
  light.estimator.journal = bake.journal.get();
  return light;
}

/// What to look at when a grid is black: where all light comes from outside, the surfaces have no opening.
std::string reason_of_darkness(const World& world) {
  bool sun = false, sky = false;
  for (const Luminaire& luminaire : world.lights().luminaires()) {
    if (!(mean_of_channels(luminaire.power) > 0)) continue;
    const bool is_sky = luminaire.kind() == Luminaire::Kind::environment;
    const bool is_sun = luminaire.kind() == Luminaire::Kind::lamp &&
                        world.scene().lamps[static_cast<size_t>(luminaire.index)].kind == Lamp::Kind::sun;
    if (!is_sky && !is_sun) return {};
    sky |= is_sky;
    sun |= is_sun;
  }
  return std::string("; ") +
         (sun && sky ? "the sun and the sky meet"
          : sun      ? "the sun meets"
                     : "the sky meets") +
         " only outsides: the rooms have no opening";
}

Result<void> bake_grid(const Options& options, Progress& progress, Bake& bake) {
  const World& world = *bake.world;
  warn_of_enclosed_lamps(world, bake.report);
  bake.plan = plan_lamps(world);
  const LuminaireSet& contained = bake.plan.contained;
  LW_TRY(groups, group_luminaires(world, options.scene.groups));
  bake.groups = std::move(groups);
  for (ClientLamp& lamp : bake.plan.client) lamp.group = group_of(lamp.luminaire, world, bake.groups);
  LW_CHECK(open_journal(options, bake));
  const LightBakeOptions light = light_options(options, bake);
  bake.photons = light.estimator.photons;
  LW_TRY(grids, bake_light(world, light, progress, bake.light_statistics));
  bake.light.lamps = bake.plan.client;
  PackGrid stated;
  stated.order = options.order;
  stated.record = options.record;
  stated.seed = options.scene.import.seed;
  LW_TRY(camera, choose_camera(world, ""));
  bake.camera = camera;
  std::vector<PackGrid> all;
  for (const BakedGrid& grid : grids) {
    stated.contains = grid.contains;
    stated.priority = grid.priority;
    stated.estimated_error = grid.estimated_error;
    stated.estimate = grid.estimate;
    all.push_back(stated);
  }
  bake.field = LightField(layers_of(std::move(grids)));
  bake.dark = is_dark(bake.field);
  if (bake.dark)
    bake.report.warn("no light reaches the free space of the scene: its light grid is black" +
                     reason_of_darkness(world));
  else if (bake.light_statistics.dark)
    bake.report.warn("next to no light reaches the fronts of surfaces" + reason_of_darkness(world));
  for (size_t i = 0; i < all.size(); i++) all[i].grid = &bake.field.layers()[i].grid;
  bake.light.grids = std::move(all);
  bake.light.exposure = choose_exposure(world, camera, bake.field, contained, options.scene.threads);
  return {};
}

/// What lets a grid that ended as its stream was full, well short of its target, come nearer to that.
void advise_budget(const LightBakeOptions& light, const LightBakeStatistics& statistics, ConsoleProgress& progress) {
  constexpr float well = 1.5f;  // estimates themselves err by so much (docs/decisions/036)
  if (statistics.refinement != Refinement::to_budget || statistics.estimated_error < well * light.target_error) return;
  progress.note("the light grid reached its --budget of " + size_text(light.most_bytes) + " at an estimated error of " +
                short_number(100 * statistics.estimated_error) + " %, not " + short_number(100 * light.target_error) +
                " %: a larger one lets it be finer");
}

Result<void> run(const Options& options, ConsoleProgress& progress, Bake& bake) {
  LW_CHECK(check_options(options));
  LW_CHECK(check_output(options.output, {options.scene.path, options.scene.environment}));
  Stopwatch watch;
  progress.stage("importing", 0, "");
  LW_CHECK(import_scene(options, progress, bake));
  progress.note("memory: up to about " + size_text(bake.expected_memory));
  bake.import_seconds = watch.lap();
  LW_CHECK(bake_grid(options, progress, bake));
  bake.light_seconds = watch.lap();
  const float extent = length(bake.world->surfaces().focus().size());
  bake.world.reset();
  if (bake.scene.cameras.empty()) add_camera(bake.scene.document, bake.camera, 1e-3f * extent, bake.scene.origin);
  LW_TRY(file, make_pack(std::move(bake.scene), bake.light, options.pack, progress, bake.report, bake.pack_statistics));
  bake.file = std::move(file);
  bake.geometry_seconds = watch.lap();
  LW_CHECK(write_file(options.output, bake.file));
  close_journal(options, bake);
  bake.write_seconds = watch.lap();
  advise_budget(light_options(options, bake), bake.light_statistics, progress);
  return {};
}

std::string name_of(Refinement refinement) {
  switch (refinement) {
    case Refinement::to_target: return "target error";
    case Refinement::to_budget: return "budget";
    case Refinement::to_finest: return "finest cells";
    case Refinement::to_deadline: return "time";
    case Refinement::to_no_gain: return "no gain";
  }
  return {};
}

/// Of the kinds of points that there are: an error is never 0.
nlohmann::ordered_json estimate_figures(const ErrorEstimate& estimate) {
  nlohmann::ordered_json figures = {{"surface", nullptr}, {"free", nullptr}};
  if (estimate.surface > 0) figures["surface"] = estimate.surface;
  if (estimate.free > 0) figures["free"] = estimate.free;
  return figures;
}

/// What was chosen for each grid.
nlohmann::ordered_json grid_figures(const LightField::Layer& layer) {
  const LightGrid& grid = layer.grid;
  const GridDescription described{.shape = grid.shape, .contains = layer.contents};
  return {{"nodes", grid.shape.count() + BrickNodes(grid.tree).nodes().size()},
          {"cell", grid.shape.cell.e},
          {"levels", grid.tree.levels()},
          {"bricks", grid.tree.bricks().size()},
          {"contains", to_json(std::span(&described, 1))["grids"][0]["contains"]}};
}

nlohmann::ordered_json figures(const Options& options, const Bake& bake) {
  nlohmann::ordered_json figures = {
      {"triangles", bake.pack_statistics.triangles},
      {"vertices", bake.pack_statistics.vertices},
      {"nodes", bake.light_statistics.nodes},
      {"invalid_nodes", bake.light_statistics.invalid_nodes},
      {"photons", bake.photons},
      {"rays", bake.light_statistics.rays},
      {"seconds",
       {{"import", bake.import_seconds},
        {"light", bake.light_seconds},
        {"geometry", bake.geometry_seconds},
        {"write", bake.write_seconds}}},
      {"rays_per_second", static_cast<double>(bake.light_statistics.rays) / bake.light_seconds},
      {"expected_memory", bake.expected_memory},
      {"peak_memory", peak_memory()},
      {"pack_bytes", bake.file.size()},
      {"bytes",
       {{"opening", bake.pack_statistics.opening_bytes},
        {"geometry", bake.pack_statistics.geometry_bytes},
        {"light", bake.pack_statistics.light_bytes},
        {"texture", bake.pack_statistics.texture_bytes}}},
      {"estimated_error", bake.light_statistics.estimated_error},
      {"estimate", estimate_figures(bake.light_statistics.estimate)},
      {"warnings", bake.report.warnings}};
  // Of no light there is nothing to be wrong by, and a 0 would look like praise.
  if (bake.dark) figures["estimated_error"] = figures["estimate"] = nullptr;
  for (const LightField::Layer& layer : bake.field.layers()) figures["grids"].push_back(grid_figures(layer));
  if (bake.light_statistics.refinement) figures["refined_to"] = name_of(*bake.light_statistics.refinement);
  if (options.resume) figures["resumed_nodes"] = bake.resumed_nodes;
  return figures;
}

int bake_scene(const Options& options, const Console& console) {
  Bake bake;
  const auto outcome = with_progress(console, [&](ConsoleProgress& progress) { return run(options, progress, bake); });
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
  add_scene_options(*command, options->scene,
                    "A glTF, OBJ, PLY, STL or Draco file, a pack, or a built-in scene; - is stdin");
  add_number(*command, "--position-error", options->pack.position_error, {1e-9, 1e9},
             "How far a vertex may move at most, in metres (default: a 16,384th of its mesh's longest side)");
  add_choice<LightNodeOrder>(
      *command, "--order", options->order, {{"lattice", LightNodeOrder::lattice}, {"slices", LightNodeOrder::slices}},
      "How the light grid is streamed: from coarse to fine, or some nodes of every slice of a regular grid");
  add_choice<LightRecord>(*command, "--record", options->record,
                          {{"moments", LightRecord::moments},
                           {"shared-exponent", LightRecord::shared_exponent},
                           {"floats", LightRecord::floats},
                           {"direction-colour", LightRecord::direction_colour},
                           {"direction-magnitude", LightRecord::direction_magnitude}},
                          "Of --order lattice: how the light of a node is written (docs/light.md section 6)");
  add_number(*command, "--target-error", options->target_error, {0, 100},
             "The error of the irradiance, root mean square in percent, at which rays are enough and cells fine enough")
      ->default_str("1");
  add_count(*command, "--budget", options->budget,
            "Of --grid auto: bytes that the light may take, of each group: 40k, 128k, 1M",
            "a count, such as 40k, 128k or 1M")
      ->default_str("131072");
  add_number(*command, "--stop-after", options->stop_after, {0, 1e9},
             "Of --grid auto: about so many seconds the light may take; what there is then, is written");
  command->add_flag("--preview", options->preview, "A first light in seconds: fewer rays, and --stop-after 2");
  add_choice<SkyApart>(
      *command, "--sky-apart", options->sky_apart,
      {{"auto", SkyApart::as_needed}, {"always", SkyApart::always}, {"never", SkyApart::never}},
      "Keep the sky's own light in a grid apart from what surfaces reflect: the page then refines its shadows. auto: "
      "where one grid would miss --target-error and what is reflected alone errs less; not with --grid N, --preview or "
      "--stop-after");
  command->add_flag("--resume", options->resume,
                    "Keep the light of each node in PACK.journal, and go on with what an interrupted run left there");
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
