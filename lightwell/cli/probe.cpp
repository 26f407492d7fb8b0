// SPDX-License-Identifier: Apache-2.0
#include "lightwell/cli/arguments.h"
#include "lightwell/cli/light_source.h"
#include "lightwell/cli/open_scene.h"
#include "lightwell/cli/probe_points.h"

namespace lightwell {
namespace {

struct Options {
  std::string scene;
  std::string points;
  std::string environment;
  ImportOptions import;
  LightBakeOptions light;
  ProbeOptions probe;
  bool without_environment = false;
};

Result<std::vector<ProbeValue>> run(const Options& options, const std::vector<ProbePoint>& points, Progress& progress,
                                    Report& report) {
  LW_TRY(scene, open_scene(options.scene, options.import, options.environment, report));
  LW_TRY(traced, TraceScene::build(scene));
  ProbeOptions probe_options = options.probe;
  probe_options.environment = !options.without_environment;
  probe_options.seed = options.import.seed;
  LightGrid grid;
  std::vector<uint8_t> contained;
  if (probe_options.integrator == Integrator::ivg) {
    LW_CHECK(check_environment(options.scene, scene));
    LW_TRY(held, contained_in_grid(options.scene, *traced, !options.without_environment));
    contained = std::move(held);
    LightBakeOptions light = options.light;
    light.seed = options.import.seed;
    light.contained = contained;
    LW_TRY(found, light_of(options.scene, *traced, light, progress));
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
  auto values = [&] {
    ConsoleProgress progress(console);
    return run(options, *points, progress, report);
  }();
  console.warn(report);
  if (!values) return console.fail(in_file(values.error(), options.scene));
  if (console.json)
    console.print(figures(*values));
  else
    std::fputs(probe_csv(*points, *values).c_str(), stdout);
  return 0;
}

const std::map<std::string, Integrator> integrators = {{"path", Integrator::path}, {"ivg", Integrator::ivg}};
const std::map<std::string, LightPart> quantities = {
    {"total", LightPart::total}, {"direct", LightPart::direct}, {"indirect", LightPart::indirect}};

}  // namespace

CLI::App* add_probe(CLI::App& program, Console& console, std::function<int()>& chosen) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("probe", "Irradiance (W/m2) at points with normals, as CSV");
  command->add_option("scene", options->scene, "A scene file, a pack, or a built-in scene")->required();
  command->add_option("--points", options->points, "CSV with the columns x,y,z,nx,ny,nz")->required();
  command->add_option("--integrator", options->probe.integrator, "path: path tracing; ivg: the light grid")
      ->transform(CLI::CheckedTransformer(integrators))
      ->default_str("path");
  command->add_option("--quantity", options->probe.quantity, "Which light is measured")
      ->transform(CLI::CheckedTransformer(quantities))
      ->default_str("indirect");
  command->add_flag("--without-environment", options->without_environment,
                    "Leave out light straight from the environment");
  command->add_option("--spp", options->probe.samples, "Paths a point")
      ->capture_default_str()
      ->check(CLI::Range(1, 1 << 26));
  command
      ->add_option("--max-depth", options->probe.max_bounces,
                   "Bounces between source and point; 0 is direct light only")
      ->capture_default_str()
      ->check(CLI::Range(0, 1024));
  add_environment_option(*command, options->environment);
  add_grid_options(*command, options->light);
  add_import_options(*command, options->import);
  add_threads_option(*command, options->probe.threads);
  command->footer("Example:\n  lightwell probe room.glb --points points.csv --integrator ivg > irradiance.csv");
  command->callback([=, &console, &chosen] {
    options->light.threads = options->probe.threads;
    chosen = [=, &console] { return probe_scene(*options, console); };
  });
  return command;
}

}  // namespace lightwell
