// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/base/bytes.h"
#include "lightwell/base/result.h"

namespace lightwell {

/// Holds the faces and vertices that a Draco mesh announces against its bytes: the library makes room for them before
/// it decodes any. Fails for more than any mesh in use has for its size, for other geometry than meshes, and for
/// streams older than glTF's (2.2). `name` is used in errors.
Result<void> check_draco_counts(Bytes stream, const std::string& name);

}  // namespace lightwell
