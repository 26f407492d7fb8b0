// SPDX-License-Identifier: Apache-2.0
#include "lightwell/cli/light_source.h"

#include "lightwell/bake/contained.h"
#include "lightwell/cli/arguments.h"
#include "lightwell/cli/open_scene.h"

namespace lightwell {
namespace {

constexpr int default_nodes = 32;
constexpr int most_nodes = 256;

int parse_nodes(const std::string& text) {
  if (text == "auto") return default_nodes;
  auto nodes = parse_count(text);
  if (!nodes || *nodes < 2 || *nodes > most_nodes)
    throw CLI::ValidationError("--grid", "is auto, or 2 to " + std::to_string(most_nodes));
  return static_cast<int>(*nodes);
}

}  // namespace

void add_grid_options(CLI::App& command, LightBakeOptions& options) {
  options.nodes = default_nodes;
  command
      .add_option_function<std::string>(
          "--grid", [&options](const std::string& text) { options.nodes = parse_nodes(text); },
          "Nodes on the light grid's longest axis, or auto (32)")
      ->default_str("auto");
  add_count(command, "--photons", options.photons, "Photons to trace into the grid")->default_str("8M");
}

Result<std::vector<uint8_t>> contained_in_grid(const std::string& path, const TraceScene& scene, bool environment) {
  if (is_pack(path)) {
    LW_TRY(pack, PackReader::open_file(path));
    LW_TRY(json, pack_json(pack));
    return contained_luminaires(json, scene);
  }
  std::vector<uint8_t> contained;
  for (const Luminaire& luminaire : scene.lights().luminaires())
    contained.push_back(luminaire.kind == Luminaire::Kind::environment && environment);
  return contained;
}

Result<void> check_environment(const std::string& path, const Scene& scene) {
  if (!is_pack(path) || EnvironmentLight(scene.environment).black()) return {};
  LW_TRY(pack, PackReader::open_file(path));
  LW_TRY(json, pack_json(pack));
  if (contains_environment(json)) return {};
  return fail(path, "its light was baked without an environment: bake the scene with one, or leave --environment out");
}

Result<LightGrid> light_of(const std::string& path, const TraceScene& scene, const LightBakeOptions& options,
                           Progress& progress, const LightLevel& level) {
  if (is_pack(path)) return open_light(path, level);
  LightBakeStatistics statistics;
  return bake_light(scene, options, progress, statistics);
}

}  // namespace lightwell
