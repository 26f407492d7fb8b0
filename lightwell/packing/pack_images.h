// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/scene/scene.h"
#include "lightwell/texture/stream.h"

namespace lightwell {

/// An image whose file is streamed; the opening holds a small picture for it.
struct StreamedImage {
  int image = 0;  ///< of the scene
  TextureParameters parameters;
  std::vector<uint8_t> file;
};

/// Puts small pictures in place of the document's images, and gives back the files of those that are worth a stream.
/// Afterwards the document needs no extension to find its images: `source` names a PNG or JPEG.
std::vector<StreamedImage> shrink_images(const Scene& scene, Document& document);

}  // namespace lightwell
