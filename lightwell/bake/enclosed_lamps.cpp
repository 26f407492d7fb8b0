// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/enclosed_lamps.h"

#include "lightwell/bake/mesh_name.h"
#include "lightwell/trace/enclosure.h"

namespace lightwell {

void warn_of_enclosed_lamps(const World& world, Report& report) {
  const TraceScene& surfaces = world.surfaces();
  for (const Lamp& lamp : world.scene().lamps) {
    if (lamp.kind == Lamp::Kind::sun || bulb_radius(surfaces, lamp) > 0) continue;
    const auto around = enclosure_of(surfaces, lamp.position);
    if (!around) continue;
    const auto primitive = static_cast<size_t>(world.scene().instances[around->instance].primitive);
    report.warn("lamp \"" + lamp.name + "\" stands inside of " +
                mesh_name(world.scene(), world.scene().primitives[primitive]) + ", which lets none of its light out");
  }
}

}  // namespace lightwell
