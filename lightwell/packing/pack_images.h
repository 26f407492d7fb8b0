// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/scene/scene.h"
#include "lightwell/texture/stream.h"

namespace lightwell {

/// An image whose file is streamed; the opening holds a small preview of it.
struct StreamedImage {
  int image = 0;  ///< index into Scene::images
  TextureParameters parameters;
  std::vector<uint8_t> file;
};

/// Replaces the images that textures show by small previews and returns the files that are worth streaming. Afterwards
/// no texture needs an extension to find its image: `source` names a PNG or JPEG. Other images stay as they are.
std::vector<StreamedImage> shrink_images(const Scene& scene, Document& document);

}  // namespace lightwell
