// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/world.h"

namespace lightwell {

Result<std::unique_ptr<const World>> World::build(const Scene& scene, int threads) {
  LW_TRY(surfaces, TraceScene::build(scene, threads));
  std::unique_ptr<const World> world(new World(std::move(surfaces)));
  if (!world->lights().finite())
    return fail(ErrorKind::limit, "lights", "they are too bright: their power is beyond a float");
  return world;
}

}  // namespace lightwell
