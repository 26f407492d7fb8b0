// SPDX-License-Identifier: Apache-2.0
#include "lightwell/cli/arguments.h"
#include "lightwell/cli/light_source.h"
#include "lightwell/cli/open_scene.h"
#include "lightwell/render/exposure.h"

namespace lightwell {
namespace {

struct Options {
  std::string scene;
  std::string output;
  std::string environment;
  std::string camera;
  std::optional<Vec<int, 2>> size;
  std::optional<float> exposure;
  Display display;
  ImportOptions import;
  LightBakeOptions light;
  RenderOptions render;
  MeshLevel mesh_level;
  LightLevel light_level;
};

struct Figures {
  double prepare_seconds = 0;
  RenderStatistics statistics;
};

// The picture's size: as asked for, else the camera's own, else 640 pixels wide.
void set_size(const Options& options, const Camera& camera, RenderOptions& render) {
  if (options.size) {
    render.width = (*options.size)[0];
    render.height = (*options.size)[1];
  } else if (camera.width > 0 && camera.height > 0) {
    render.width = camera.width;
    render.height = camera.height;
  } else if (camera.aspect > 0) {
    render.height = std::max(1, static_cast<int>(std::lround(static_cast<float>(render.width) / camera.aspect)));
  }
}

Result<Figures> run(const Options& options, Progress& progress, Report& report) {
  Stopwatch watch;
  Figures figures;
  LW_TRY(scene, open_scene(options.scene, options.import, options.environment, report, options.mesh_level));
  LW_TRY(traced, TraceScene::build(scene));
  LW_TRY(camera, choose_camera(scene, options.camera));

  RenderOptions render_options = options.render;
  set_size(options, camera, render_options);
  if (render_options.integrator == Integrator::ivg) LW_CHECK(check_environment(options.scene, scene));
  LW_TRY(contained, contained_in_grid(options.scene, *traced));
  LightGrid grid;
  Display display = options.display;
  const bool chosen_exposure = !options.exposure && options.output.ends_with(".png");
  if (render_options.integrator == Integrator::ivg || chosen_exposure) {
    LightBakeOptions light = options.light;
    light.seed = options.import.seed;
    light.contained = contained;
    LW_TRY(found, light_of(options.scene, *traced, light, progress, options.light_level));
    grid = std::move(found);
    render_options.grid = &grid;
    render_options.contained = contained;
  }
  if (options.exposure)
    display.exposure = *options.exposure;
  else if (chosen_exposure)
    display.exposure = choose_exposure(*traced, camera, grid, contained);
  figures.prepare_seconds = watch.lap();

  render_options.seed = options.import.seed;
  LW_TRY(picture, render(*traced, camera, render_options, progress, figures.statistics));
  LW_CHECK(write_picture(options.output, picture, display));
  return figures;
}

int render_scene(const Options& options, const Console& console) {
  Report report;
  auto figures = [&] {
    ConsoleProgress progress(console);
    return run(options, progress, report);
  }();
  console.warn(report);
  if (!figures) return console.fail(in_file(figures.error(), options.scene));
  console.print({{"seconds", {{"prepare", figures->prepare_seconds}, {"render", figures->statistics.seconds}}},
                 {"rays", figures->statistics.rays},
                 {"spp", options.render.samples}});
  return 0;
}

const std::map<std::string, Integrator> integrators = {
    {"path", Integrator::path}, {"direct", Integrator::direct}, {"ivg", Integrator::ivg}};
const std::map<std::string, LightPart> parts = {
    {"total", LightPart::total}, {"direct", LightPart::direct}, {"indirect", LightPart::indirect}};
const std::map<std::string, Fill> fills = {
    {"push-pull", Fill::push_pull}, {"push-pull-smooth", Fill::push_pull_smooth}, {"none", Fill::none}};
const std::map<std::string, ToneCurve> tones = {{"neutral", ToneCurve::neutral}, {"none", ToneCurve::none}};

}  // namespace

CLI::App* add_render(CLI::App& program, Console& console, std::function<int()>& chosen) {
  auto options = std::make_shared<Options>();
  RenderOptions& render = options->render;
  CLI::App* command = program.add_subcommand("render", "Makes a picture in software");
  command->add_option("scene", options->scene, "A scene file, a pack, or a built-in scene")->required();
  command->add_option("-o,--output", options->output, "FILE.png, FILE.exr or FILE.pfm")->required();
  command->add_option("--integrator", render.integrator, "path: path tracing; direct: no bounces; ivg: the light grid")
      ->transform(CLI::CheckedTransformer(integrators))
      ->default_str("path");
  command->add_option("--only", render.part, "Which light is shown")
      ->transform(CLI::CheckedTransformer(parts))
      ->default_str("total");
  command->add_option("--spp", render.samples, "Samples a pixel")->capture_default_str()->check(CLI::Range(1, 1 << 20));
  command->add_option("--max-depth", render.max_bounces, "Bounces between source and surface; 0 is direct light only")
      ->capture_default_str()
      ->check(CLI::Range(0, 1024));
  command->add_option("--camera", options->camera, "The camera's name or number (default: the first)");
  command
      ->add_option_function<std::string>(
          "--size",
          [options](const std::string& text) {
            auto size = parse_size(text);
            if (!size) throw CLI::ValidationError("--size", size.error().message());
            options->size = *size;
          },
          "The picture's size in pixels (default: the camera's)")
      ->type_name("WxH");
  command->add_option("--exposure", options->exposure, "EV of a PNG (default: chosen for the scene)");
  command->add_option("--tone", options->display.tone, "Tone curve of a PNG")
      ->transform(CLI::CheckedTransformer(tones))
      ->default_str("neutral");
  command->add_option("--level", options->mesh_level.share, "Of a pack: share of the final faces")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 1.0));
  command->add_option("--light-level", options->light_level.share, "Of a pack: share of the light grid's nodes")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 1.0));
  command
      ->add_option("--fill", options->light_level.fill,
                   "How the other nodes are filled: push-pull, push-pull-smooth or none")
      ->transform(CLI::CheckedTransformer(fills))
      ->default_str("push-pull");
  add_environment_option(*command, options->environment);
  add_grid_options(*command, options->light);
  add_import_options(*command, options->import);
  add_threads_option(*command, render.threads);
  command->footer(
      "Examples:\n  lightwell render room.glb --spp 256 -o room.png\n"
      "  lightwell render room.lw.glb --integrator ivg --only indirect -o indirect.exr");
  command->callback([=, &console, &chosen] {
    options->light.threads = options->render.threads;
    chosen = [=, &console] { return render_scene(*options, console); };
  });
  return command;
}

}  // namespace lightwell
