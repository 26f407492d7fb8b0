// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "lightwell/base/bytes.h"

namespace lightwell {

/// The image files that a pack may hold. The numbers stand in texture streams.
enum class ImageFormat : uint8_t { png = 0, jpeg = 1, webp = 2 };

/// The MIME type for glTF's image.mimeType.
constexpr std::string_view mime_type(ImageFormat format) {
  switch (format) {
    case ImageFormat::png: return "image/png";
    case ImageFormat::jpeg: return "image/jpeg";
    case ImageFormat::webp: return "image/webp";
  }
  return "";
}

/// The format that a file's first bytes announce; none when Lightwell does not know it.
inline std::optional<ImageFormat> image_format(Bytes file) {
  const std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
  if (text.starts_with("\x89PNG\r\n\x1a\n")) return ImageFormat::png;
  if (text.starts_with("\xff\xd8\xff")) return ImageFormat::jpeg;
  if (text.starts_with("RIFF") && text.size() >= 12 && text.substr(8, 4) == "WEBP") return ImageFormat::webp;
  return std::nullopt;
}

}  // namespace lightwell
