// SPDX-License-Identifier: Apache-2.0
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
};

Result<std::vector<ProbeValue>> run(const Options& options, const std::vector<ProbePoint>& points, Progress& progress,
                                    Report& report) {
  LW_TRY(scene, open_scene(options.scene, report));
  LW_TRY(traced, TraceScene::build(scene));
  ProbeOptions probe_options = options.probe;
  probe_options.environment = !options.without_environment;
  probe_options.seed = options.scene.import.seed;
  probe_options.threads = options.scene.threads;
  LightGrid grid;
  std::vector<uint8_t> contained;
  if (probe_options.integrator == Integrator::ivg) {
    LW_CHECK(check_environment(options.scene.path, scene));
    LW_TRY(held, contained_in_grid(options.scene.path, *traced, !options.without_environment));
    contained = std::move(held);
    LW_TRY(found, light_of(options.scene, *traced, contained, progress));
    grid = std::move(found);
    probe_options.grid = &grid;
    probe_options.contained = contained;
  }
  return probe(*traced, points, probe_options, progress);
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
  add_choice<Integrator>(*command, "--integrator", options->probe.integrator,
                         {{"path", Integrator::path}, {"ivg", Integrator::ivg}},
                         "path: path tracing; ivg: the light grid (an irradiance vector grid)");
  add_choice<LightPart>(*command, "--quantity", options->probe.quantity,
                        {{"total", LightPart::total}, {"direct", LightPart::direct}, {"indirect", LightPart::indirect}},
                        "Which light is measured");
  command->add_flag("--without-environment", options->without_environment,
                    "Leave out light straight from the environment");
  add_whole(*command, "--spp", options->probe.samples, {1, 100000000}, "Paths a point");
  add_whole(*command, "--max-depth", options->probe.max_bounces, {0, 1024},
            "Bounces between source and point; 0 is direct light only");
  add_scene_options(*command, options->scene, "A scene file, a pack, or a built-in scene");
  command->footer("Example:\n  lightwell probe room.glb --points points.csv --integrator ivg > irradiance.csv");
  command->callback([=, &console, &chosen] { chosen = [=, &console] { return probe_scene(*options, console); }; });
  return command;
}

}  // namespace lightwell
