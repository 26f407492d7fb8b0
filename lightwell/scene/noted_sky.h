// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "lightwell/gltf/document.h"

namespace lightwell {

/// What a document notes of its sky, in extras.lightwell of the scene that it shows, so that a pack keeps it.
struct NotedSky {
  std::optional<Vec3f> radiance;   ///< skyRadiance, of a constant one
  std::optional<float> turbidity;  ///< skyTurbidity, of the physical sky of its sun
};

/// What the document notes. Values out of range are brought into it.
NotedSky noted_sky(const Json& document);

/// Notes this and nothing else: a sky without values is one that packs do not keep, a picture.
void note_sky(Json& document, const NotedSky& sky);

}  // namespace lightwell
