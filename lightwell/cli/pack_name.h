// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "lightwell/base/result.h"

namespace lightwell {

/// Fails when `path` is no file but the name of a built-in scene, which other commands take where this one reads a
/// pack.
Result<void> refuse_builtin_scene(const std::string& path);

}  // namespace lightwell
