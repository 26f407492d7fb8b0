// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/asset/codecs.h"
#include "tests/cases/case.h"

namespace lightwell {

/// A case of the room asset: the stream's kind, its codec and the number of its streams of bricks, a byte each, its
/// parameters, the BIN chunk of the opening, then the payloads, those of bricks last.
inline Case asset_case(StreamKind kind, std::vector<uint8_t> parameters, std::vector<uint8_t> bin,
                       std::vector<std::vector<uint8_t>> payloads, uint8_t codec = 0, uint8_t bricks = 0) {
  Case one{Room::asset, {{static_cast<uint8_t>(kind), codec, bricks}, std::move(parameters), std::move(bin)}};
  for (std::vector<uint8_t>& payload : payloads) one.parts.push_back(std::move(payload));
  return one;
}

/// The directory of a pack that holds the stream of such a case and its bricks alone. Bytes that are missing count as
/// zero, and what is no kind as one.
inline Directory directory_of(const Case& one) {
  const auto byte = [&](size_t i) { return !one.parts.empty() && i < one.parts[0].size() ? one.parts[0][i] : 0; };
  StreamEntry entry;
  entry.kind = static_cast<StreamKind>(byte(0) % stream_kinds);
  entry.codec = static_cast<uint8_t>(byte(1));
  if (one.parts.size() > 1) entry.parameters = one.parts[1];
  for (size_t i = 3; i < one.parts.size(); i++) entry.length += static_cast<uint32_t>(one.parts[i].size());
  Directory directory;
  directory.streams.push_back(std::move(entry));
  for (uint32_t region = 0; region < static_cast<uint32_t>(byte(2) % 64); region++) {
    ByteWriter parameters;
    parameters.u32(0);  // BricksLayout, whose encoder is not in the client
    parameters.u32(region);
    directory.streams.push_back({.kind = StreamKind::bricks, .parameters = parameters.release(), .rows = {}});
  }
  return directory;
}

}  // namespace lightwell
