// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "lightwell/gltf/json.h"

namespace lightwell {

/// LIGHTWELL_streams of docs/format.md: which pack this is.
inline constexpr const char* streams_extension = "LIGHTWELL_streams";

struct PackIdentity {
  uint32_t version = 0;   ///< of the format
  std::string id;         ///< 32 hexadecimal digits
  std::string generator;  ///< the program that baked it
  float exposure = 0;     ///< EV that the baker chose
};

/// The extension's JSON.
Json to_json(const PackIdentity& identity);

/// Reads the extension from the JSON of a pack. Any JSON gives an identity or an error that names the element.
Result<PackIdentity> read_identity(const Json& json);

}  // namespace lightwell
