// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "lightwell/base/result.h"

namespace lightwell {

/// Fails when a glTF's JSON text refers to another file, i.e. when a buffer or an image has a `uri` that is not a data
/// URI. A client refuses such a pack before a glTF loader would fetch the file. The text is scanned as strings and
/// brackets only, so that the client needs no JSON parser.
Result<void> check_self_contained(std::string_view json);

}  // namespace lightwell
