// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "lightwell/base/bytes.h"
#include "lightwell/base/result.h"
#include "lightwell/texture/image.h"

namespace lightwell {

/// A PNG file of an image's colours with the opacity of another one, a mask: its alpha channel if it has one, else its
/// first channel. It has the size of `color`, or of the mask where `color` is empty and white stands for it. Both are
/// image files.
Result<std::vector<uint8_t>> cut_out(Bytes color, Bytes mask, ImageLimit limit);

}  // namespace lightwell
