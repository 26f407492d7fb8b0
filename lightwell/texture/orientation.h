// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

namespace lightwell {

/// Sets the orientation in the Exif data of a JPEG, WebP or PNG file to upright, in place: glTF ignores it, browsers
/// turn the picture. Returns whether there was another one. Any bytes are safe; damaged Exif data stays as it is.
bool make_upright(std::span<uint8_t> file);

}  // namespace lightwell
