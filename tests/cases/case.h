// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "lightwell/base/bytes.h"

namespace lightwell {

/// The room that a case is for.
enum class Room : uint8_t { base, light, mesh, texture, pack, asset };

/// What one room is fed with, in the order in which a client would come by it: a stream's parameters (and for a mesh
/// the BIN chunk of the opening), then its payloads; a whole file for pack; any bytes for base. For asset see
/// tests/asset/asset_case.h.
struct Case {
  Room room = Room::base;
  std::vector<std::vector<uint8_t>> parts;
};

inline void write_case(ByteWriter& writer, const Case& one) {
  writer.u8(static_cast<uint8_t>(one.room));
  writer.u32(static_cast<uint32_t>(one.parts.size()));
  for (const std::vector<uint8_t>& part : one.parts) {
    writer.u32(static_cast<uint32_t>(part.size()));
    writer.append(part);
  }
}

/// Reads what write_case wrote. Of any other bytes it makes some case, no larger than they are.
inline Case read_case(ByteReader& reader) {
  Case one;
  one.room = static_cast<Room>(reader.u8());
  for (uint32_t left = reader.u32(); left > 0 && reader.ok(); left--) {
    const Bytes part = reader.take(reader.u32());
    one.parts.emplace_back(part.begin(), part.end());
  }
  return one;
}

}  // namespace lightwell
