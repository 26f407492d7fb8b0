// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/texture/image.h"

namespace lightwell {

/// The image reduced so that its longer side has `longest_side` pixels; an image that is not larger is returned as it
/// is. Each pixel is the mean of the rectangle of pixels that it replaces. With `color` set the channels but alpha are
/// sRGB and averaged as linear light. Colours are weighted by their alpha, so that transparent pixels do not darken
/// edges.
Image smallest_mip(const Image& image, int longest_side, bool color);

}  // namespace lightwell
