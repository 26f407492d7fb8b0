// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/gltf/document.h"
#include "lightwell/texture/image.h"

namespace lightwell {

/// Makes the images of a document such as every viewer shows them: a BMP or TGA, which glTF does not know, becomes a
/// PNG, and the orientation in the Exif data of others (texture/orientation.h), which glTF ignores, goes.
void make_images_plain(Document& document, ImageLimit limit);

}  // namespace lightwell
