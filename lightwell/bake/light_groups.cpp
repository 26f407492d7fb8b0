// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/light_groups.h"

#include <algorithm>

#include "lightwell/scene/sun_of_sky.h"

namespace lightwell {
namespace {

constexpr const char *of_sky = "sky", *of_others = "others";

}  // namespace

Result<std::vector<LightGroup>> group_luminaires(const World& world, GroupedBy by) {
  const std::vector<Luminaire>& luminaires = world.lights().luminaires();
  if (by == GroupedBy::nothing) return std::vector{LightGroup{{}, LuminaireSet::all(luminaires.size())}};
  const Scene& scene = world.scene();
  const std::vector<std::string> names = group_names(scene, by);
  std::vector<LightGroup> groups;
  for (size_t i = 0; i < luminaires.size(); i++) {
    const Luminaire& luminaire = luminaires[i];
    const bool sky =
        luminaire.kind() == Luminaire::Kind::environment ||
        (luminaire.kind() == Luminaire::Kind::lamp && is_sun_of_sky(scene.lamps[static_cast<size_t>(luminaire.index)]));
    const auto node = static_cast<size_t>(luminaire.id.node);
    std::string name = sky ? of_sky : node < names.size() ? names[node] : std::string();
    if (name.empty()) name = of_others;
    auto group = std::ranges::find(groups, name, &LightGroup::name);
    if (group == groups.end()) group = groups.insert(group, {std::move(name), {}});
    group->luminaires.insert(static_cast<int>(i));
  }
  if (groups.size() > most_light_groups)
    return fail(ErrorKind::limit, "--groups",
                std::to_string(groups.size()) + " groups of light, a pack holds " + std::to_string(most_light_groups));
  return groups;
}

std::string group_of(const LuminaireId& id, const World& world, std::span<const LightGroup> groups) {
  const std::vector<Luminaire>& luminaires = world.lights().luminaires();
  const auto found = std::ranges::find(luminaires, id, &Luminaire::id);
  if (found == luminaires.end()) return {};
  const auto number = static_cast<int>(found - luminaires.begin());
  const auto group = std::ranges::find_if(groups, [&](const LightGroup& of) { return of.luminaires.contains(number); });
  return group == groups.end() ? std::string() : group->name;
}

}  // namespace lightwell
