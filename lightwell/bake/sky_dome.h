// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/scene/scene.h"

namespace lightwell {

/// Takes meshes that stand for the sky out of what is traced: those that shine, or are unlit, far around everything
/// else, as a sphere, a hemisphere or a box of six pictures. What they show from the middle of the scene becomes its
/// environment, unless it has one: a sphere of faces is a poor lamp, and an unlit one would keep the light of sun and
/// sky outside. The document, and so a pack, keeps them, and viewers show them. `report` gets a line that names them.
/// Fails as TraceScene::build does.
Result<void> take_sky_dome(Scene& scene, Report& report);

}  // namespace lightwell
