// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "lightwell/gltf/json.h"
#include "lightwell/scene/client_lamp.h"

namespace lightwell {

/// The LIGHTWELL_lamps extension (docs/format.md): the lamps whose direct light the client computes, strongest first.
inline constexpr const char* lamps_extension = "LIGHTWELL_lamps";

/// Maximum number of lamps in a pack.
inline constexpr size_t most_client_lamps = 16;

/// The lamps as the extension's JSON, without `power` and the fields that do not apply to a lamp's kind.
Json to_json(std::span<const ClientLamp> lamps);

/// Reads the extension from a pack's JSON. Invalid input yields an error naming the element. `power`, and the fields
/// that do not apply to a lamp's kind, keep their defaults.
Result<std::vector<ClientLamp>> read_lamps(const Json& json);

}  // namespace lightwell
