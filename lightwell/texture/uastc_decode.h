// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/base/bytes.h"
#include "lightwell/base/result.h"
#include "lightwell/texture/image.h"

namespace lightwell {

/// Bytes of a block of 4 x 4 texels.
constexpr size_t uastc_block_bytes = 16;

/// Decodes UASTC LDR blocks in rows from the top (Khronos Data Format Specification 1.4, chapter "UASTC Compressed
/// Texture Image Format"), as many as cover the image, to RGBA or, with three channels, to RGB. Interpolates as for a
/// linear transfer function whatever the image's is, as the reference transcoder to RGBA32 does.
Result<Image> decode_uastc(Bytes blocks, int width, int height, int channels);

}  // namespace lightwell
