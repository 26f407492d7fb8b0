// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/gltf/json.h"

namespace lightwell {

/// Fails with the name of an extension that the document requires and that is not known here.
Result<void> check_required_extensions(const Json& json);

/// Removes the extensions that are not known here, each with a warning. What is left is read, or holds nothing but
/// numbers and references that references.h knows, and so survives into a file that is written.
void drop_unknown_extensions(Json& json, Report& report);

/// True when extensionsUsed names it.
bool uses_extension(const Json& json, std::string_view name);

/// Removes `name` from extensionsUsed and extensionsRequired, once nothing uses it any more.
void forget_extension(Json& json, std::string_view name);

}  // namespace lightwell
