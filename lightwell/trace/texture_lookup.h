// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/scene/scene.h"

namespace lightwell {

/// The texture's RGBA at texture coordinates, bilinear between the texels' centres. With `srgb`, RGB is decoded to
/// linear light before interpolation; alpha is linear already. White where there is no image. Grey images give three
/// equal channels.
Vec4f look_up(const TextureLookup& texture, const std::vector<Image>& images, const std::array<Vec2f, 2>& texcoords,
              bool srgb);

/// Where the texture is read for texture coordinates, in images: KHR_texture_transform applied.
Vec2f transformed(const TextureLookup& texture, const std::array<Vec2f, 2>& texcoords);

}  // namespace lightwell
