// SPDX-License-Identifier: Apache-2.0
#include "lightwell/render/render.h"

#include <algorithm>

#include "lightwell/bake/lamps.h"
#include "lightwell/base/file.h"
#include "lightwell/cli/light_factors.h"
#include "lightwell/cli/light_source.h"
#include "lightwell/cli/open_scene.h"
#include "lightwell/render/exposure.h"

namespace lightwell {
namespace {

/// Where the light is looked up for the exposure only: a tenth of an EV needs no more.
constexpr uint64_t exposure_photons = 200'000;
constexpr int exposure_nodes = 12;
/// A pixel.
constexpr int most_samples = 1'000'000;

struct Options {
  SceneOptions scene;
  std::string output;
  std::string camera;
  std::optional<Vec<int, 2>> size;
  std::optional<float> exposure;
  Display display;
  RenderOptions render;
  MeshLevel mesh_level;
  LightLevel light_level;
  std::vector<GroupFactor> factors;
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
    const float height = std::round(static_cast<float>(render.width) / camera.aspect);
    render.height = static_cast<int>(std::clamp(height, 1.f, static_cast<float>(largest_picture_side)));
  }
}

// Whether the picture is for the eye, so that an exposure matters.
bool is_for_the_eye(const std::string& output) { return !output.ends_with(".exr") && !output.ends_with(".pfm"); }

/// Says so when there is nothing to be seen in a picture of all light.
void warn_if_black(const Picture& picture, const World& world, Report& report) {
  if (std::ranges::any_of(picture.pixels, [](float radiance) { return radiance > 0; })) return;
  report.warn(world.lights().dark()
                  ? "the picture is black: nothing shines; --environment 1,1,1 lights the scene from all around"
                  : "the picture is black: no light reaches what the camera sees");
}

Result<Figures> run(const Options& options, Progress& progress, Report& report) {
  LW_CHECK(check_output(options.output, {options.scene.path, options.scene.environment}));
  Stopwatch watch;
  Figures figures;
  LW_TRY(opened, open_scene(options.scene, report, options.mesh_level));
  LW_TRY(world, ready(opened, options.scene.threads, progress, report));
  LW_TRY(camera, choose_camera(*world, options.camera));

  RenderOptions render_options = options.render;
  set_size(options, camera, render_options);
  const bool needs_field = render_options.integrator->needs_field;
  if (needs_field) LW_CHECK(check_environment(opened));
  const LuminaireSet held = contained_in_grids(opened, *world);
  LW_TRY(groups, groups_of(opened, options.scene, *world));
  LW_TRY(factors, luminaire_factors(options.factors, groups));
  render_options.light.factors = factors;
  LightField field, sky;
  Display display = options.display;
  const bool chooses_exposure = !options.exposure && is_for_the_eye(options.output);
  if (needs_field || chooses_exposure) {
    SceneOptions light = options.scene;
    if (!needs_field) {
      light.photons = std::min(light.photons, exposure_photons);
      light.nodes = exposure_nodes;
    }
    LW_TRY(found, light_of(opened, light, *world, held, groups, progress, options.light_level));
    field = std::move(found);
  }
  if (options.exposure)
    display.exposure = *options.exposure;
  else if (chooses_exposure)
    display.exposure = choose_exposure(*world, camera, field, held, options.scene.threads);
  if (needs_field) {
    // After the exposure was chosen: what is dimmed is to look darker.
    field = dimmed(field, options.factors);
    render_options.light.held = held;
    sky = leave_sky_to_rays(*world, field, render_options.light.held);
    if (!sky.empty()) render_options.light.sky = &sky;
    render_options.light.field = &field;
  }
  LampSampling& sampling = render_options.light.sampling;
  if (sampling.most_points > 0) sampling.lamps = opened.pack ? opened.pack->lamps() : plan_lamps(*world).client;
  if (is_for_the_eye(options.output)) {
    render_options.display = display;
    sampling.shown = display;
  }
  figures.prepare_seconds = watch.lap();

  render_options.seed = options.scene.import.seed;
  render_options.threads = options.scene.threads;
  LW_TRY(picture, render(*world, camera, render_options, progress, figures.statistics));
  if (render_options.light.part == LightPart::total) warn_if_black(picture, *world, report);
  LW_CHECK(write_picture(options.output, picture, display));
  return figures;
}

int render_scene(const Options& options, const Console& console) {
  Report report;
  auto figures = with_progress(console, [&](Progress& progress) { return run(options, progress, report); });
  console.warn(report);
  if (!figures) return console.fail(in_file(figures.error(), options.scene.path));
  if (options.output != "-")
    console.print({{"seconds", {{"prepare", figures->prepare_seconds}, {"render", figures->statistics.seconds}}},
                   {"rays", figures->statistics.rays},
                   {"spp", figures->statistics.samples}});
  return 0;
}

Result<Vec<int, 2>> parse_size(const std::string& text) {
  const size_t cross = text.find('x');
  if (cross == std::string::npos) return fail(text, "is not WIDTHxHEIGHT, such as 640x480");
  LW_TRY(width, parse_whole(text.substr(0, cross), {1, largest_picture_side}));
  LW_TRY(height, parse_whole(text.substr(cross + 1), {1, largest_picture_side}));
  return Vec<int, 2>{{static_cast<int>(width), static_cast<int>(height)}};
}

void add_integrator_options(CLI::App& command, RenderOptions& render) {
  add_row_choice(command, "--integrator", render.integrator, integrators());
  add_choice<LightPart>(command, "--only", render.light.part,
                        {{"total", LightPart::total}, {"direct", LightPart::direct}, {"indirect", LightPart::indirect}},
                        "Which light is shown");
  CLI::Option* samples = add_whole(command, "--spp", render.samples, {1, most_samples}, "Samples a pixel");
  add_number(command, "--time", render.seconds, {0, 1e9},
             "Seconds to take samples for, in place of --spp: as many as there is time for, one a pixel at least")
      ->excludes(samples);
  add_whole(command, "--max-depth", render.light.max_bounces, {0, 1024},
            "Bounces between source and surface; 0 is direct light only");
  add_whole(command, "--direct-samples", render.light.sampling.most_points, {1, 1000000},
            "Shadows as the page has them: at most so many points of each lamp, fewer where more are not seen")
      ->option_text("N (default: lamps are sampled at random)");
}

void add_picture_options(CLI::App& command, Options& options) {
  command.add_option("--camera", options.camera, "The camera's name or number (default: the first)")
      ->type_name("NAME|N");
  const auto take_size = [&options](const std::string& text) -> Result<void> {
    LW_TRY(size, parse_size(text));
    options.size = size;
    return {};
  };
  add_text(command, "--size", "WxH", take_size, "The picture's size in pixels (default: the camera's)");
  add_number(command, "--exposure", options.exposure, {-64, 64}, "EV of a PNG (default: chosen for the scene)");
  add_choice<ToneCurve>(command, "--tone", options.display.tone,
                        {{"neutral", ToneCurve::neutral}, {"none", ToneCurve::none}}, "Tone curve of a PNG");
}

}  // namespace

CLI::App* add_render(CLI::App& program, Console& console, std::function<int()>& chosen) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("render", "Makes a picture in software");
  add_output(*command, options->output, {".png", ".exr", ".pfm"},
             "FILE.png, FILE.exr or FILE.pfm; - is a PNG on stdout")
      ->required();
  add_integrator_options(*command, options->render);
  add_picture_options(*command, *options);
  add_level_option(*command, options->mesh_level,
                   "Of a pack: the coarsest level with at least this share of the faces, 0 to 1");
  add_light_level_options(*command, options->light_level);
  add_light_group_option(*command, options->factors);
  add_scene_options(*command, options->scene, "A scene file, a pack, or a built-in scene; - is stdin");
  command->footer(
      "Examples:\n  lightwell render room.glb --spp 256 -o room.png\n"
      "  lightwell render room.lw.glb --integrator ivg --only indirect -o indirect.exr");
  command->callback([=, &console, &chosen] {
    if (options->render.seconds) options->render.samples = most_samples;
    if (options->render.light.sampling.most_points > 0 && !options->render.integrator->takes_points)
      throw CLI::ValidationError("--direct-samples", "the path tracer samples lamps at random");
    chosen = [=, &console] { return render_scene(*options, console); };
  });
  return command;
}

}  // namespace lightwell
