// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "lightwell/base/result.h"

namespace lightwell {

/// Fails when a glTF's JSON text refers to anything outside the file: a buffer or an image has a `uri` that is not a
/// data URI. A pack refers to nothing, and a client refuses one that does before it hands it to a glTF loader that
/// would fetch it. It reads the text as strings and brackets, which is enough for this and needs no parser of JSON.
Result<void> check_self_contained(std::string_view json);

}  // namespace lightwell
