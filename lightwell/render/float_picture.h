// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/render/picture.h"

namespace lightwell {

// Readers and writers of pictures of floats; read_picture and write_picture choose among them.

bool is_exr(Bytes file);
/// Reads a scanline OpenEXR file with channels R, G and B, or a single channel, taken as grey. As safe for untrusted
/// bytes as tinyexr.
Result<Picture> read_exr(Bytes file);
/// The bytes of an OpenEXR file of 32-bit floats, deflated.
Result<std::vector<uint8_t>> write_exr(const Picture& picture);

bool is_pfm(Bytes file);
/// Reads a PFM file, colour or grey, of either byte order. Safe for any bytes.
Result<Picture> read_pfm(Bytes file);
/// The bytes of a PFM file: little-endian floats, first row at the bottom.
std::vector<uint8_t> write_pfm(const Picture& picture);

}  // namespace lightwell
