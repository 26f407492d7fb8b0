// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/base/vector.h"

namespace lightwell {

/// Where light comes from: all of it, straight from its source, or after at least one reflection. A picture's total
/// also shows what shines by itself; its other parts do not.
enum class LightPart { total, direct, indirect };

inline bool wants_direct(LightPart part) { return part != LightPart::indirect; }
inline bool wants_indirect(LightPart part) { return part != LightPart::direct; }

}  // namespace lightwell
