// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "lightwell/gltf/json.h"

namespace lightwell {

/// The LIGHTWELL_streams extension (docs/format.md): the identity of a pack.
inline constexpr const char* streams_extension = "LIGHTWELL_streams";

struct PackIdentity {
  uint32_t version = 0;   ///< of the format
  std::string id;         ///< 32 hexadecimal digits
  std::string generator;  ///< the program that baked it
  float exposure = 0;     ///< EV chosen by the baker
  Vec3d origin{};         ///< what the coordinates of grids and lamps are counted from: Scene::origin

  bool operator==(const PackIdentity&) const = default;
};

/// The identity as the extension's JSON.
Json to_json(const PackIdentity& identity);

/// Reads the extension from a pack's JSON. Invalid input yields an error naming the element.
Result<PackIdentity> read_identity(const Json& json);

}  // namespace lightwell
