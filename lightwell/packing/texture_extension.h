// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "lightwell/gltf/json.h"
#include "lightwell/texture/image_format.h"

namespace lightwell {

/// The LIGHTWELL_progressive_texture extension (docs/format.md): names the stream that carries a texture's full image.
inline constexpr const char* texture_extension = "LIGHTWELL_progressive_texture";

/// A smaller image of a texture, in a stream of its own.
struct TextureLevel {
  uint32_t stream = 0;
  uint32_t width = 0, height = 0;  ///< pixels

  bool operator==(const TextureLevel&) const = default;
};

/// A texture whose full image is streamed.
struct RefinedTexture {
  uint32_t stream = 0;
  uint32_t width = 0, height = 0;  ///< pixels
  ImageFormat format = ImageFormat::png;
  size_t texture = 0;                ///< its place in the JSON: textures[texture]
  uint32_t source = 0;               ///< the texture's image, of which the opening holds a preview
  std::vector<TextureLevel> levels;  ///< coarse to fine

  bool operator==(const RefinedTexture&) const = default;
};

/// The extension's JSON, to be stored in that texture.
Json to_json(const RefinedTexture& refined);

/// Reads the extension from all textures of a pack's JSON. Invalid input yields an error naming the element.
Result<std::vector<RefinedTexture>> read_refined_textures(const Json& json);

}  // namespace lightwell
