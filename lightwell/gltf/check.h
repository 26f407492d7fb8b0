// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/gltf/json.h"

namespace lightwell {

/// Fails unless asset.version is 2.x and asset.minVersion, if present, is 2.0.
Result<void> check_version(const Json& json);

/// Checks the structure that later reads rely on: arrays and objects where glTF has them, references in range, buffer
/// views inside their buffers' stated lengths, accessors inside their views, attributes of a primitive of equal count,
/// nodes in a forest. Takes linear time and does not recurse into the node tree. Harmless faults become warnings.
Result<void> check_document(const Json& json, Report& report);

}  // namespace lightwell
