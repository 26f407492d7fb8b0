// SPDX-License-Identifier: Apache-2.0
#include "lightwell/cli/light_source.h"

#include "lightwell/bake/contained.h"
#include "lightwell/cli/open_scene.h"
#include "lightwell/packing/grids_extension.h"
#include "lightwell/packing/lamps_extension.h"

namespace lightwell {

Result<LuminaireSet> contained_in_grid(const std::string& path, const World& world, bool environment) {
  if (is_pack_file(path)) {
    LW_TRY(pack, PackReader::open_file(path));
    LW_TRY(json, pack_json(pack));
    LW_TRY(grids, read_grids(json));
    LW_TRY(lamps, read_lamps(json));
    return contained_luminaires(lamps, contents_of(grids), world);
  }
  LuminaireSet contained;
  if (environment && world.lights().environment_luminaire() >= 0)
    contained.insert(world.lights().environment_luminaire());
  return contained;
}

Result<void> check_environment(const std::string& path, const Scene& scene) {
  if (!is_pack_file(path) || EnvironmentLight(scene.environment).black()) return {};
  LW_TRY(pack, PackReader::open_file(path));
  LW_TRY(json, pack_json(pack));
  LW_TRY(grids, read_grids(json));
  if (contents_of(grids).environment) return {};
  return fail(
      {path, "", "its light was baked without an environment: bake the scene with one, or leave --environment out"});
}

Result<LightField> light_of(const SceneOptions& options, const World& world, const LuminaireSet& contained,
                            Progress& progress, const LightLevel& level) {
  if (is_pack_file(options.path)) return open_light(options.path, level);
  LightBakeStatistics statistics;
  LW_TRY(grid, bake_light(world, options.light(contained), progress, statistics));
  return LightField({{std::move(grid), {}, 0}});
}

}  // namespace lightwell
