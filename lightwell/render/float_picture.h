// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/render/picture.h"

namespace lightwell {

/// Pictures of floats by their format; read_picture and write_picture choose.

bool is_exr(Bytes file);
/// A scanline OpenEXR file with channels R, G and B, or a single channel, taken as grey. Bytes are as safe as in
/// tinyexr.
Result<Picture> read_exr(Bytes file);
/// The bytes of an OpenEXR file of 32-bit floats, deflated.
Result<std::vector<uint8_t>> write_exr(const Picture& picture);

bool is_pfm(Bytes file);
/// Colour or grey, either byte order; any bytes are safe.
Result<Picture> read_pfm(Bytes file);
/// The bytes of a PFM file: little-endian floats, first row at the bottom.
std::vector<uint8_t> write_pfm(const Picture& picture);

}  // namespace lightwell
