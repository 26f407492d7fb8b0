// SPDX-License-Identifier: Apache-2.0
#include "lightwell/cli/light_factors.h"

#include <algorithm>

#include "lightwell/light/grid_sum.h"

namespace lightwell {
namespace {

Result<GroupFactor> parse_factor(const std::string& text) {
  const size_t equals = text.rfind('=');
  if (equals == std::string::npos || equals == 0) return fail(text, "is not NAME=NUMBER or NAME=R,G,B");
  const std::string factor = text.substr(equals + 1);
  if (const auto color = parse_color(factor)) return GroupFactor{text.substr(0, equals), *color};
  LW_TRY(number, parse_number(factor, {0, 1e9}));
  return GroupFactor{text.substr(0, equals), Vec3f::filled(static_cast<float>(number))};
}

std::vector<LightGroup> groups_of_pack(const OpenedPack& pack, const World& world) {
  std::vector<LightGroup> groups;
  const auto group = [&](const std::string& name) -> LuminaireSet& {
    const auto found = std::ranges::find(groups, name, &LightGroup::name);
    return found != groups.end() ? found->luminaires : groups.emplace_back(LightGroup{name, {}}).luminaires;
  };
  for (const GridDescription& grid : pack.grids()) {
    LuminaireSet& luminaires = group(grid.contains.group);
    // A pack need not hold the picture of the sky whose light it has.
    const int sky = world.lights().environment_luminaire();
    if (grid.contains.environment && sky >= 0) luminaires.insert(sky);
  }
  const std::vector<Luminaire>& luminaires = world.lights().luminaires();
  for (const ClientLamp& lamp : pack.lamps()) {
    const auto found = std::ranges::find(luminaires, lamp.luminaire, &Luminaire::id);
    if (found != luminaires.end()) group(lamp.group).insert(static_cast<int>(found - luminaires.begin()));
  }
  return groups;
}

}  // namespace

void add_light_group_option(CLI::App& command, std::vector<GroupFactor>& factors) {
  const auto take = [&factors](const std::vector<std::string>& texts) {
    for (const std::string& text : texts) {
      auto factor = parse_factor(text);
      if (!factor) throw CLI::ValidationError("--light-group", factor.error().message());
      factors.push_back(std::move(*factor));
    }
  };
  command
      .add_option_function<std::vector<std::string>>(
          "--light-group", take,
          "Multiplies the light of a group by a number, 0 switches it off, or by R,G,B; may be given several times")
      ->type_name("NAME=FACTOR")
      ->allow_extra_args(false);
}

Result<std::vector<LightGroup>> groups_of(const OpenedScene& opened, const SceneOptions& options, const World& world) {
  if (opened.pack) return groups_of_pack(*opened.pack, world);
  return group_luminaires(world, options.groups);
}

Result<LuminaireFactors> luminaire_factors(std::span<const GroupFactor> factors, std::span<const LightGroup> groups) {
  LuminaireFactors of_luminaires;
  for (const auto& [name, factor] : factors) {
    const auto group = std::ranges::find(groups, name, &LightGroup::name);
    if (group == groups.end()) {
      std::string known;
      for (const LightGroup& one : groups)
        if (!one.name.empty()) known += (known.empty() ? "" : ", ") + one.name;
      return fail("--light-group " + name, known.empty() ? "the scene's light has no groups: bake it with --groups"
                                                         : "is no group of the scene's light: " + known);
    }
    for (int i = 0; i < group->luminaires.size(); i++)
      if (group->luminaires.contains(i)) of_luminaires.set(i, factor);
  }
  return of_luminaires;
}

LightField dimmed(const LightField& field, std::span<const GroupFactor> factors) {
  std::vector<LightField::Layer> layers = field.layers();
  for (LightField::Layer& layer : layers)
    for (const auto& [name, factor] : factors)
      if (layer.contents.group == name) scale_light(layer.grid, factor);
  return LightField(std::move(layers));
}

}  // namespace lightwell
