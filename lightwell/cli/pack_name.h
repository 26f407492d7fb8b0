// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "lightwell/base/result.h"

namespace lightwell {

/// Fails when `path` is not a file but the name of a built-in scene, which other commands accept where this one reads a
/// pack.
Result<void> refuse_builtin_scene(const std::string& path);

}  // namespace lightwell
