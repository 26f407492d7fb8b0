// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/trace/trace_scene.h"

namespace lightwell {

/// The box of what a scene is about. That is all of it, unless it is a 32nd of the whole or less: then the box
/// leaves out surroundings, which are faces that are each larger than all the rest (a ground plane of kilometres, a sky
/// dome), and strays, which are few faces far away from all others. Lamps, and cameras within the scene, are always in
/// it.
Box3f focus_of(const TraceScene& scene);

}  // namespace lightwell
