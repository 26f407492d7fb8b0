// SPDX-License-Identifier: Apache-2.0
#include "lightwell/cli/light_source.h"

#include "lightwell/bake/contained.h"
#include "lightwell/cli/open_scene.h"

namespace lightwell {

Result<std::vector<uint8_t>> contained_in_grid(const std::string& path, const TraceScene& scene, bool environment) {
  if (is_pack_file(path)) {
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
  if (!is_pack_file(path) || EnvironmentLight(scene.environment).black()) return {};
  LW_TRY(pack, PackReader::open_file(path));
  LW_TRY(json, pack_json(pack));
  if (contains_environment(json)) return {};
  return fail(
      {path, "", "its light was baked without an environment: bake the scene with one, or leave --environment out"});
}

Result<LightGrid> light_of(const SceneOptions& options, const TraceScene& scene, const std::vector<uint8_t>& contained,
                           Progress& progress, const LightLevel& level) {
  if (is_pack_file(options.path)) return open_light(options.path, level);
  LightBakeStatistics statistics;
  return bake_light(scene, options.light(contained), progress, statistics);
}

}  // namespace lightwell
