// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "lightwell/light/stream.h"

namespace lightwell {

/// The parameters of a light stream's layout, of either codec.
template <typename Layout>
std::vector<uint8_t> parameters(const Layout& layout) {
  ByteWriter writer;
  layout.write(writer);
  return writer.release();
}

/// The bytes of all payloads of a light stream.
template <typename Stream>
uint64_t stream_bytes(const Stream& stream) {
  uint64_t bytes = 0;
  for (const LightBundle& bundle : stream.bundles) bytes += bundle.payload.size();
  return bytes;
}

}  // namespace lightwell
