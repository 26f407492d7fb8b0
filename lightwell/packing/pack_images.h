// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/scene/scene.h"
#include "lightwell/texture/stream.h"

namespace lightwell {

/// An image whose file is streamed; the opening holds a small preview of it. Before it come its levels, coarse to fine:
/// smaller images of it, which are files of their own.
struct StreamedImage {
  int image = 0;  ///< index into Scene::images
  bool is_level = false;
  TextureParameters parameters;
  std::vector<uint8_t> file;
};

/// Replaces the images that textures show by small previews and returns the files that are worth streaming, and those
/// of their levels: a sixteenth and a quarter as wide, where they take at most a fourth of the bytes of the next one.
/// Afterwards no texture needs an extension to find its image: `source` names a PNG or JPEG. Other images stay as they
/// are. The image of that index, if any, is nobody's texture and has no levels.
std::vector<StreamedImage> shrink_images(const Scene& scene, Document& document, int surroundings);

}  // namespace lightwell
