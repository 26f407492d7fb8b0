// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/scene/scene.h"

namespace lightwell {

/// A scene's images, a quarter as wide and as high, for rays whose light is summed up over much larger places: they
/// wait for memory less (sponza's 200 MB of texels made up a third of a bake's time), and meet less noise. Texels are
/// averaged by their alpha, colours in linear light, so that no light is lost. Images that are small or whose texels
/// are used both as colours and as numbers are as they were.
std::vector<Image> images_from_afar(const Scene& scene);

}  // namespace lightwell
