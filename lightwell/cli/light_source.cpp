// SPDX-License-Identifier: Apache-2.0
#include "lightwell/cli/light_source.h"

#include <algorithm>

#include "lightwell/bake/contained.h"

namespace lightwell {

Result<LightField> light_of_pack(const OpenedPack& pack, const LightLevel& level) {
  if (pack.grids().empty()) return fail("", "holds no light");
  std::vector<LightField::Layer> layers;
  for (const GridDescription& described : pack.grids()) {
    LW_TRY(grid, unpack_light(pack.reader(), described.stream, level));
    grid.lookup = level.lookup;
    layers.push_back({std::move(grid), described.contains, described.priority});
  }
  return LightField(std::move(layers));
}

LuminaireSet contained_in_grids(const OpenedScene& scene, const World& world, bool environment) {
  if (scene.pack) return contained_luminaires(scene.pack->lamps(), contents_of(scene.pack->grids()), world);
  LuminaireSet contained;
  if (environment && world.lights().environment_luminaire() >= 0)
    contained.insert(world.lights().environment_luminaire());
  return contained;
}

Result<void> check_environment(const OpenedScene& scene) {
  if (!scene.pack || contents_of(scene.pack->grids()).environment || EnvironmentLight(scene.scene.environment).black())
    return {};
  return fail(
      "", "its light was baked without an environment: bake the scene with one, or leave --environment and --sky out");
}

LightField leave_sky_to_rays(const World& world, LightField& field, LuminaireSet& held) {
  const int sky = world.lights().environment_luminaire();
  std::vector<LightField::Layer> layers = field.layers();
  const auto of_sky = std::ranges::stable_partition(
      layers, [](const LightField::Layer& layer) { return layer.contents.indirect || !layer.contents.environment; });
  if (sky < 0 || of_sky.empty()) return {};
  held.erase(sky);
  LightField left_out(std::vector<LightField::Layer>(of_sky.begin(), of_sky.end()));
  layers.erase(of_sky.begin(), of_sky.end());
  field = LightField(std::move(layers));
  return left_out;
}

Result<LightField> light_of(const OpenedScene& scene, const SceneOptions& options, const World& world,
                            const LuminaireSet& contained, std::span<const LightGroup> groups, Progress& progress,
                            const LightLevel& level) {
  if (scene.pack) return light_of_pack(*scene.pack, level);
  LightBakeStatistics statistics;
  LightBakeOptions light = options.light(contained);
  light.sky_apart = SkyApart::as_needed;
  light.groups = groups;
  LW_TRY(grids, bake_light(world, light, progress, statistics));
  for (BakedGrid& baked : grids) baked.grid.lookup = level.lookup;
  return LightField(layers_of(std::move(grids)));
}

}  // namespace lightwell
