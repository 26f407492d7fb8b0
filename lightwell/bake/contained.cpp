// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/contained.h"

#include <optional>

namespace lightwell {
namespace {

// Where a lamp or a luminaire stands.
struct Place {
  Luminaire::Kind kind = Luminaire::Kind::lamp;
  int node = -1;
  Vec3f center{};
};

Place place_of(const ClientLamp& lamp) {
  const bool surface = lamp.kind == ClientLamp::Kind::rectangle || lamp.kind == ClientLamp::Kind::sphere;
  return {surface ? Luminaire::Kind::surface : Luminaire::Kind::lamp, lamp.node, lamp.center};
}

Place place_of(const Luminaire& luminaire, const Scene& scene) {
  const auto index = static_cast<size_t>(luminaire.index);
  switch (luminaire.kind()) {
    case Luminaire::Kind::lamp: return {luminaire.kind(), scene.lamps[index].node, scene.lamps[index].position};
    case Luminaire::Kind::surface: return {luminaire.kind(), scene.instances[index].node, luminaire.center};
    case Luminaire::Kind::environment: break;
  }
  return {luminaire.kind()};
}

}  // namespace

LuminaireSet contained_luminaires(std::span<const ClientLamp> lamps, const GridContents& contents,
                                  const World& world) {
  std::vector<Place> places;
  LuminaireSet contained;
  for (const Luminaire& luminaire : world.lights().luminaires()) {
    if (luminaire.kind() != Luminaire::Kind::environment || contents.environment)
      contained.insert(static_cast<int>(places.size()));
    places.push_back(place_of(luminaire, world.scene()));
  }
  for (const ClientLamp& lamp : lamps) {
    const Place place = place_of(lamp);
    std::optional<size_t> nearest;
    for (size_t i = 0; i < places.size(); i++) {
      if (!contained.contains(static_cast<int>(i)) || places[i].kind != place.kind || places[i].node != place.node)
        continue;
      const auto distance = [&](size_t j) { return length(places[j].center - place.center); };
      if (!nearest || distance(i) < distance(*nearest)) nearest = i;
    }
    if (nearest) contained.erase(static_cast<int>(*nearest));
  }
  return contained;
}

}  // namespace lightwell
