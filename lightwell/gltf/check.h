// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/gltf/json.h"

namespace lightwell {

/// Fails unless the JSON says that it is glTF 2.0 (asset.version and minVersion).
Result<void> check_version(const Json& json);

/// Checks what later reads rely on: arrays and objects where glTF has them, every reference in range, buffer views
/// inside their buffers' stated lengths, accessors inside their views, primitives' attributes of one length, nodes a
/// forest. Takes time linear in the document, and no stack for deep node trees. What is wrong but harmless is warned
/// of.
Result<void> check_document(const Json& json, Report& report);

}  // namespace lightwell
