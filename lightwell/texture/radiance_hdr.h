// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/base/bytes.h"
#include "lightwell/base/result.h"
#include "lightwell/texture/image.h"

namespace lightwell {

/// Decodes a Radiance picture (.hdr, .pic): RGBE, flat or run-length coded in the old or the new way (Ward, "Real
/// Pixels", Graphics Gems II; Radiance's color.c). A mantissa m and exponent e are m * 2^(e - 136), divided by the
/// header's EXPOSURE. The first row may be at the top or bottom, the first column left or right; XYZE and pictures
/// stored by columns are refused. Memory grows with what was decoded. Any bytes are safe.
Result<RadianceImage> read_radiance_hdr(Bytes file, ImageLimit limit = {});

}  // namespace lightwell
