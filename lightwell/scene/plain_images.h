// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/gltf/document.h"
#include "lightwell/texture/image.h"

namespace lightwell {

/// Makes the images that a document's textures show such as every viewer shows them: a BMP or TGA, which glTF does not
/// know, and a KTX2, which few viewers decode, become PNGs, and the orientation in the Exif data of others
/// (texture/orientation.h), which glTF ignores, goes.
void make_images_plain(Document& document, ImageLimit limit);

}  // namespace lightwell
