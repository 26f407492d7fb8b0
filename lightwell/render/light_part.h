// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/base/vector.h"

namespace lightwell {

/// A part of the light: all of it, only light straight from its source, or only light reflected at least once. A
/// picture of the total also shows emissive surfaces and the environment; one of another part does not.
enum class LightPart { total, direct, indirect };

inline bool wants_direct(LightPart part) { return part != LightPart::indirect; }
inline bool wants_indirect(LightPart part) { return part != LightPart::direct; }

}  // namespace lightwell
