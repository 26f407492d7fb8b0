// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/base/bytes.h"
#include "lightwell/base/result.h"
#include "lightwell/texture/image.h"

namespace lightwell {

/// The streams of a BasisLZ image of ETC1S blocks (KTX 2.0, appendices "BasisLZ Global Data" and "BasisLZ/ETC1S
/// Bitstream Specification").
struct Etc1sStreams {
  size_t endpoint_count = 0, selector_count = 0;
  Bytes endpoints, selectors, tables;
  Bytes colors;               ///< the slice that fills red, green and blue
  Bytes second;               ///< the slice that fills one channel more; empty when there is none
  size_t second_channel = 3;  ///< alpha, or green where the first slice is red
};

/// Decodes to RGBA when there is a second slice that is alpha, else to RGB.
Result<Image> decode_etc1s(const Etc1sStreams& streams, int width, int height);

}  // namespace lightwell
