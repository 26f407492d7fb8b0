// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/contained.h"

#include <algorithm>

namespace lightwell {

LuminaireSet contained_luminaires(std::span<const ClientLamp> lamps, const GridContents& contents, const World& world) {
  LuminaireSet contained;
  const std::vector<Luminaire>& luminaires = world.lights().luminaires();
  for (size_t i = 0; i < luminaires.size(); i++) {
    const LuminaireId& id = luminaires[i].id;
    const bool held =
        id.kind == LuminaireId::Kind::environment
            ? contents.environment
            : std::none_of(lamps.begin(), lamps.end(), [&](const ClientLamp& lamp) { return lamp.luminaire == id; });
    if (held) contained.insert(static_cast<int>(i));
  }
  return contained;
}

}  // namespace lightwell
