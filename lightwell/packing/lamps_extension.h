// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "lightwell/gltf/json.h"
#include "lightwell/scene/client_lamp.h"

namespace lightwell {

/// LIGHTWELL_lamps of docs/format.md: the lamps that a client lights by itself, the strongest first.
inline constexpr const char* lamps_extension = "LIGHTWELL_lamps";

/// The most lamps that a pack may list.
inline constexpr size_t most_client_lamps = 16;

/// The extension's JSON. What a lamp's kind has no use for, and `power`, is left out.
Json to_json(std::span<const ClientLamp> lamps);

/// Reads the extension from the JSON of a pack. Any JSON gives lamps or an error that names the element. What a lamp's
/// kind has no use for, and `power`, is as in a new ClientLamp.
Result<std::vector<ClientLamp>> read_lamps(const Json& json);

}  // namespace lightwell
