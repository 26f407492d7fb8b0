// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/gltf/json.h"

namespace lightwell {

/// Fails, naming the extension, when the document requires one that is not known here.
Result<void> check_required_extensions(const Json& json);

/// Removes the extensions that are not known here and warns of them. The known ones survive rewriting: they are either
/// read here, or hold only values and the references that references.h knows.
void drop_unknown_extensions(Json& json, Report& report);

/// True when extensionsUsed lists `name`.
bool uses_extension(const Json& json, std::string_view name);

/// Removes `name` from extensionsUsed and extensionsRequired; to be called once nothing uses it any more.
void forget_extension(Json& json, std::string_view name);

}  // namespace lightwell
