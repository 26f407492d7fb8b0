// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "lightwell/base/bytes.h"

namespace lightwell {

struct ImageSize {
  uint32_t width = 0, height = 0;  ///< pixels

  bool operator==(const ImageSize&) const = default;
};

/// The size that a PNG, JPEG or WebP file states in its header; none when the file is another or ends before that.
/// Nothing is decoded. Any bytes are safe.
std::optional<ImageSize> image_size(Bytes file);

}  // namespace lightwell
