// SPDX-License-Identifier: Apache-2.0
#include "lightwell/cli/light_factors.h"
#include "lightwell/cli/light_source.h"
#include "lightwell/cli/open_scene.h"
#include "lightwell/cli/probe_points.h"

namespace lightwell {
namespace {

struct Options {
  SceneOptions scene;
  std::string points;
  ProbeOptions probe;
  bool without_environment = false;
  LightLevel light_level;
  std::vector<GroupFactor> factors;
};

Result<std::vector<ProbeValue>> run(const Options& options, const std::vector<ListedPoint>& points, Progress& progress,
                                    Report& report) {
  LW_TRY(opened, open_scene(options.scene, report));
  LW_TRY(world, ready(opened, options.scene.threads, progress, report));
  ProbeOptions probe_options = options.probe;
  probe_options.seed = options.scene.import.seed;
  probe_options.threads = options.scene.threads;
  IntegratorOptions& light = probe_options.light;
  if (options.without_environment && world->lights().environment_luminaire() >= 0)
    light.left_out.insert(world->lights().environment_luminaire());
  LW_TRY(groups, groups_of(opened, options.scene, *world));
  LW_TRY(factors, luminaire_factors(options.factors, groups));
  light.factors = factors;
  LightField field;
  if (probe_options.integrator->needs_field) {
    LW_CHECK(check_environment(opened));
    const LuminaireSet held = contained_in_grids(opened, *world, !options.without_environment);
    light.held = held;
    LW_TRY(found, light_of(opened, options.scene, *world, held, groups, progress, options.light_level));
    field = dimmed(found, options.factors);
    light.field = &field;
  }
  return probe(*world, counted_from(world->scene().origin, points), probe_options, progress);
}

nlohmann::ordered_json figures(const std::vector<ProbeValue>& values) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const ProbeValue& value : values)
    list.push_back({{"rgb", value.irradiance.e}, {"stderr", value.standard_error}});
  return {{"points", list}};
}

int probe_scene(const Options& options, const Console& console) {
  auto points = read_probe_points(options.points);
  if (!points) return console.fail(points.error());
  Report report;
  auto values = with_progress(console, [&](Progress& progress) { return run(options, *points, progress, report); });
  console.warn(report);
  if (!values) return console.fail(in_file(values.error(), options.scene.path));
  if (console.json)
    console.print(figures(*values));
  else
    std::fputs(probe_csv(*points, *values).c_str(), stdout);
  return 0;
}

}  // namespace

CLI::App* add_probe(CLI::App& program, Console& console, std::function<int()>& chosen) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("probe", "Irradiance (W/m2) at points with normals, as CSV");
  command->add_option("--points", options->points, "CSV with the columns x,y,z,nx,ny,nz")
      ->required()
      ->type_name("FILE");
  add_row_choice<IntegratorKind>(*command, "--integrator", options->probe.integrator, integrators(),
                                 [](const IntegratorKind& row) { return row.finds_indirect; });
  add_choice<LightPart>(*command, "--quantity", options->probe.light.part,
                        {{"total", LightPart::total}, {"direct", LightPart::direct}, {"indirect", LightPart::indirect}},
                        "Which light is measured");
  command->add_flag("--without-environment", options->without_environment,
                    "Leave out light straight from the environment");
  add_whole(*command, "--spp", options->probe.samples, {1, 100000000}, "Paths a point");
  add_whole(*command, "--max-depth", options->probe.light.max_bounces, {0, 1024},
            "Bounces between source and point; 0 is direct light only");
  add_light_level_options(*command, options->light_level);
  add_light_group_option(*command, options->factors);
  add_scene_options(*command, options->scene, "A scene file, a pack, or a built-in scene; - is stdin");
  command->footer("Example:\n  lightwell probe room.glb --points points.csv --integrator ivg > irradiance.csv");
  command->callback([=, &console, &chosen] { chosen = [=, &console] { return probe_scene(*options, console); }; });
  return command;
}

}  // namespace lightwell
