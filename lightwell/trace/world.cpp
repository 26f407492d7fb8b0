// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/world.h"

namespace lightwell {

Result<std::unique_ptr<const World>> World::build(const Scene& scene, int threads) {
  LW_TRY(surfaces, TraceScene::build(scene, threads));
  const Lights lights(*surfaces);
  std::unique_ptr<const World> world(new World(std::move(surfaces), lights));
  if (!world->lights().finite())
    return fail(ErrorKind::limit, "lights", "they are too bright: their power is beyond a float");
  return world;
}

std::unique_ptr<const World> World::lit_by(const LuminaireSet& luminaires) const {
  return std::unique_ptr<const World>(new World(surfaces_, lights_.only(luminaires)));
}

}  // namespace lightwell
