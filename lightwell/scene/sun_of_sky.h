// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "lightwell/scene/scene.h"

namespace lightwell {

/// Takes the sun out of the picture of a sky, where it has one: a spot of few degrees that is far brighter than what is
/// around it and sends a good part of all light. The picture keeps the brightness of the sky around. As a lamp the sun
/// casts sharp shadows, which no light grid resolves, and is shown by the client itself. Nothing in other pictures.
std::optional<Lamp> take_sun(Environment& environment);

/// Gives a scene, and its document, the sun of its sky, unless the document has it already: a pack keeps it.
void add_sun(Scene& scene, const Lamp& sun);

/// Whether a lamp is one that add_sun() has added, to this scene or to that of which it is the pack.
bool is_sun_of_sky(const Lamp& lamp);

}  // namespace lightwell
