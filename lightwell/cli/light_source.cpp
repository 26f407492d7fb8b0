// SPDX-License-Identifier: Apache-2.0
#include "lightwell/cli/light_source.h"

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

void leave_sky_to_rays(const World& world, LightField& field, LuminaireSet& held) {
  const int sky = world.lights().environment_luminaire();
  std::vector<LightField::Layer> layers = field.layers();
  const auto is_sky_alone = [](const LightField::Layer& layer) {
    return layer.contents.environment && !layer.contents.indirect;
  };
  if (sky < 0 || std::erase_if(layers, is_sky_alone) == 0) return;
  held.erase(sky);
  field = LightField(std::move(layers));
}

Result<LightField> light_of(const OpenedScene& scene, const SceneOptions& options, const World& world,
                            const LuminaireSet& contained, std::span<const LightGroup> groups, Progress& progress,
                            const LightLevel& level) {
  if (scene.pack) return light_of_pack(*scene.pack, level);
  LightBakeStatistics statistics;
  LightBakeOptions light = options.light(contained);
  light.groups = groups;
  LW_TRY(grids, bake_light(world, light, progress, statistics));
  for (BakedGrid& baked : grids) baked.grid.lookup = level.lookup;
  return LightField(layers_of(std::move(grids)));
}

}  // namespace lightwell
