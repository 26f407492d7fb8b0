// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/enclosed_lamps.h"

#include "lightwell/bake/mesh_name.h"
#include "lightwell/trace/enclosure.h"

namespace lightwell {

std::vector<EnclosedLamp> enclosed_lamps(const World& world) {
  const TraceScene& surfaces = world.surfaces();
  std::vector<EnclosedLamp> found;
  for (const Lamp& lamp : world.scene().lamps) {
    if (lamp.kind == Lamp::Kind::sun || bulb_radius(surfaces, lamp) > 0) continue;
    const auto around = enclosure_of(surfaces, lamp.position);
    if (!around) continue;
    found.push_back(
        {lamp.name, static_cast<size_t>(world.scene().instances[around->instance].primitive), around->reach});
  }
  return found;
}

void warn_of_enclosed_lamps(const World& world, Report& report) {
  for (const EnclosedLamp& enclosed : enclosed_lamps(world))
    report.warn("lamp \"" + enclosed.lamp + "\" stands inside of " +
                mesh_name(world.scene(), world.scene().primitives[enclosed.primitive]) +
                ", which lets none of its light out");
}

}  // namespace lightwell
