// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/light_parts.h"

namespace lightwell {

std::vector<LightPart> light_parts(const World& world, const LuminaireSet& contained,
                                   std::span<const LightGroup> groups, bool sky_apart) {
  const int count = static_cast<int>(world.lights().luminaires().size());
  const int sky = world.lights().environment_luminaire();
  std::vector<LightPart> parts;
  const auto add = [&](std::string group, const LuminaireSet& luminaires) {
    LightPart part{.group = std::move(group), .luminaires = luminaires, .contained = {}};
    for (int i = 0; i < count; i++)
      if (luminaires.contains(i) && contained.contains(i)) part.contained.insert(i);
    const bool apart = sky_apart && part.contained.contains(sky);
    if (apart) part.contained.erase(sky);
    parts.push_back(part);
    if (!apart) return;
    LuminaireSet only_sky;
    only_sky.insert(sky);
    parts.push_back({.group = part.group, .luminaires = only_sky, .contained = only_sky, .reflected = false});
  };
  if (groups.size() <= 1) {
    add(groups.empty() ? "" : groups.front().name, LuminaireSet::all(static_cast<size_t>(count)));
    return parts;
  }
  for (const LightGroup& group : groups) add(group.name, group.luminaires);
  return parts;
}

GridContents contents_of(const LightPart& part, const World& world) {
  GridContents contents{.indirect = part.reflected, .group = part.group};
  const std::vector<Luminaire>& luminaires = world.lights().luminaires();
  for (size_t i = 0; i < luminaires.size(); i++)
    if (part.contained.contains(static_cast<int>(i)))
      (luminaires[i].kind() == Luminaire::Kind::environment ? contents.environment : contents.lamps) = true;
  return contents;
}

}  // namespace lightwell
