// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/client_lamp.h"

#include "lightwell/base/assert.h"
#include "lightwell/scene/scene.h"

namespace lightwell {

ClientLamp describe_lamp(const Lamp& source) {
  ClientLamp lamp;
  switch (source.kind) {
    case Lamp::Kind::point: lamp.kind = ClientLamp::Kind::point; break;
    case Lamp::Kind::spot: lamp.kind = ClientLamp::Kind::spot; break;
    case Lamp::Kind::sun: lamp.kind = ClientLamp::Kind::sun; break;
  }
  lamp.name = source.name;
  lamp.center = source.position;
  lamp.normal = source.direction;
  lamp.intensity = source.intensity;
  lamp.range = source.range;
  lamp.inner_cone = source.inner_cone;
  lamp.outer_cone = source.outer_cone;
  return lamp;
}

Lamp punctual_lamp(const ClientLamp& lamp) {
  LW_ASSERT(lamp.kind == ClientLamp::Kind::point || lamp.kind == ClientLamp::Kind::spot ||
            lamp.kind == ClientLamp::Kind::sun);
  Lamp source;
  source.kind = lamp.kind == ClientLamp::Kind::sun    ? Lamp::Kind::sun
                : lamp.kind == ClientLamp::Kind::spot ? Lamp::Kind::spot
                                                      : Lamp::Kind::point;
  source.name = lamp.name;
  source.position = lamp.center;
  source.direction = lamp.normal;
  source.intensity = lamp.intensity;
  source.range = lamp.range;
  source.inner_cone = lamp.inner_cone;
  source.outer_cone = lamp.outer_cone;
  return source;
}

}  // namespace lightwell
