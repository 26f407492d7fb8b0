// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/gltf/document.h"

namespace lightwell {

/// Takes the orientation out of the Exif data of a document's images (texture/orientation.h), so that viewers show them
/// as glTF means them.
void make_images_upright(Document& document);

}  // namespace lightwell
