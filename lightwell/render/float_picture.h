// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/render/picture.h"

namespace lightwell {

/// Pictures of floats by their format; read_picture and write_picture choose.

bool is_exr(Bytes file);
/// Any layer-less EXR that has R, G and B (or one channel, taken as grey); any bytes are safe as far as tinyexr is.
Result<Picture> read_exr(Bytes file);

bool is_pfm(Bytes file);
/// Any bytes are safe.
Result<Picture> read_pfm(Bytes file);

}  // namespace lightwell
