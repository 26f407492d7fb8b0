// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/base/bytes.h"
#include "lightwell/base/result.h"
#include "lightwell/texture/image.h"

namespace lightwell {

/// Whether a file announces itself as KTX 2.0. Such a file cannot be in a pack (image_format.h).
bool is_ktx2(Bytes file);

/// Decodes the largest level of a KTX 2.0 file as glTF's KHR_texture_basisu has them: one 2D picture of Basis
/// Universal, ETC1S with BasisLZ or UASTC, the latter as it is or compressed with Zstandard. Four channels when the
/// file says that there is alpha, else three; of red alone or red and green the channels that are left over mean
/// nothing. Key/value data is passed over: orientation and swizzle are the usual ones in glTF.
Result<Image> read_ktx2(Bytes file, ImageLimit limit = {});

}  // namespace lightwell
