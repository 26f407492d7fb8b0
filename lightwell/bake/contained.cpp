// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/contained.h"

#include <optional>

namespace lightwell {
namespace {

/// What LIGHTWELL_lamps says of a lamp's place.
struct Place {
  Luminaire::Kind kind = Luminaire::Kind::lamp;
  int node = -1;
  Vec3f center{};
};

Place place_of(const Json& lamp) {
  Place place;
  const Json& kind = member(lamp, "kind");
  if (kind == "rectangle" || kind == "sphere") place.kind = Luminaire::Kind::surface;
  place.node = index_of(lamp, "node");
  place.center = numbers<3>(lamp, "center", {}).cast<float>();
  return place;
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

bool contains_environment(const Json& pack) {
  for (const Json& grid : member(extension(pack, "LIGHTWELL_light_grids"), "grids"))
    for (const Json& what : member(grid, "contains"))
      if (what == "environment") return true;
  return false;
}

LuminaireSet contained_luminaires(const Json& pack, const World& world) {
  std::vector<Place> places;
  LuminaireSet contained;
  for (const Luminaire& luminaire : world.lights().luminaires()) {
    if (luminaire.kind() != Luminaire::Kind::environment || contains_environment(pack))
      contained.insert(static_cast<int>(places.size()));
    places.push_back(place_of(luminaire, world.scene()));
  }
  for (const Json& lamp : member(extension(pack, "LIGHTWELL_lamps"), "lamps")) {
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
