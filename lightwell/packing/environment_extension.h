// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "lightwell/gltf/json.h"

namespace lightwell {

/// The LIGHTWELL_environment extension (docs/format.md): the texture that shows what surrounds the scene.
inline constexpr const char* environment_extension = "LIGHTWELL_environment";

/// What a pack may state as radiance: beyond it, products would leave the range of a float.
inline constexpr float most_environment_radiance = 1e12f;

/// Where the picture of the surroundings is, and which radiance its bytes stand for.
struct EnvironmentPicture {
  uint32_t texture = 0;
  float radiance = 0;  ///< of the byte 255, W/m2/sr
  float stops = 0;     ///< that 255 bytes are; the byte 0 is black

  bool operator==(const EnvironmentPicture&) const = default;
};

/// The extension's JSON, to be stored at the root.
Json to_json(const EnvironmentPicture& picture);

/// Reads the extension; nothing when the pack has none. Invalid input, also a texture that there is not, yields an
/// error naming the element.
Result<std::optional<EnvironmentPicture>> read_environment_picture(const Json& json);

}  // namespace lightwell
