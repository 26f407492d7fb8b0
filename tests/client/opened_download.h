// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include "lightwell/client/download.h"
#include "lightwell/pack/opening.h"
#include "tests/pack/pack_samples.h"

namespace lightwell {

/// A pack of streams whose blocks hold any bytes, and a download of which only the opening and the directory are here.
struct OpenedDownload {
  std::vector<uint8_t> file;
  Download download;

  explicit OpenedDownload(std::vector<PackStream> streams) : file(make_pack({}, std::move(streams))) {
    bring(0, static_cast<size_t>(measure_opening(file)->needed));
  }
  /// Brings the bytes begin ... end-1 of the file.
  void bring(uint64_t begin, uint64_t end) {
    Cursor cursor{begin, {}};
    const Bytes bytes = Bytes(file).subspan(static_cast<size_t>(begin), static_cast<size_t>(end - begin));
    const auto received = download.receive(cursor, bytes);
    EXPECT_TRUE(received) << received.error().message();
  }
};

/// A stream of equal blocks of 100 bytes with their checks, of which each takes the same share of the error away.
inline PackStream even_stream(StreamKind kind, uint32_t blocks, float error = 1) {
  PackStream stream{kind, 0, error, {}, {}};
  for (uint32_t i = 0; i < blocks; i++)
    stream.blocks.push_back({std::vector<uint8_t>(96, static_cast<uint8_t>(i)), 1,
                             error * static_cast<float>(blocks - 1 - i) / static_cast<float>(blocks)});
  return stream;
}

}  // namespace lightwell
