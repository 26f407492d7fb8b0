// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "lightwell/scene/scene.h"

namespace lightwell {

/// The materials of a document in its order. Factors outside their range are clamped with a warning; extensions that
/// are not followed get one each.
std::vector<Material> read_materials(const Json& document, Report& report);

/// The image that a texture of a document is read from: EXT_texture_webp's, glTF's own, or another extension's where
/// both are absent; -1 when there is none.
int image_of(const Json& texture);
/// For each image of a document whether a texture is read from it. Of the others are those for viewers that lack an
/// extension.
std::vector<bool> read_by_textures(const Json& document);

/// The images of a document in its order, decoded. One that no texture is read from is a white pixel; one that cannot
/// be read becomes that, and `report` gets a warning.
std::vector<Image> read_images(const Document& document, ImageLimit limit, Report& report);

}  // namespace lightwell
