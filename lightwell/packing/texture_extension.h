// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "lightwell/gltf/json.h"
#include "lightwell/texture/image_format.h"

namespace lightwell {

/// LIGHTWELL_progressive_texture of docs/format.md: a stream brings a texture's whole image.
inline constexpr const char* texture_extension = "LIGHTWELL_progressive_texture";

/// A texture whose image a stream brings.
struct RefinedTexture {
  uint32_t stream = 0;
  uint32_t width = 0, height = 0;  ///< pixels
  ImageFormat format = ImageFormat::png;
  size_t texture = 0;   ///< where it stands: textures[texture]
  uint32_t source = 0;  ///< that texture's image, which the opening holds small
};

/// The extension's JSON, for the texture where it stands.
Json to_json(const RefinedTexture& refined);

/// Reads the extension from all textures of a pack's JSON. Any JSON gives a list or an error that names the element.
Result<std::vector<RefinedTexture>> read_refined_textures(const Json& json);

}  // namespace lightwell
