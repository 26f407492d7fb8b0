// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lightwell/pack/directory.h"

namespace lightwell {

struct PackBlock {
  std::vector<uint8_t> payload;  ///< not empty, without the check
  uint32_t adds = 0;             ///< vertices, nodes or bytes
  float error = 0;               ///< remaining after it
};

/// A stream to be written.
struct PackStream {
  StreamKind kind = StreamKind::light;
  uint8_t codec = 0;
  float error = 0;  ///< before the first block: that of what the opening shows
  std::vector<uint8_t> parameters;
  std::vector<PackBlock> blocks;
};

/// The parts of a pack that are known before its JSON is written: its id, and the places of its streams.
struct PackPlan {
  PackId id{};
  std::vector<StreamEntry> streams;  ///< in the order given; `first` counts from the start of the LWST chunk's data, so
                                     ///< it does not depend on the length of the JSON
};

/// Makes a pack in memory, in two steps, since the JSON repeats the id:
///
///   LW_TRY(writer, PackWriter::create(bin, std::move(streams)));
///   LW_TRY(file, writer.finish(make_json(writer.plan())));
class PackWriter {
 public:
  /// `bin` is the data of the BIN chunk. Fails when a limit of docs/format.md is exceeded, and for empty blocks and
  /// invalid errors.
  static Result<PackWriter> create(std::vector<uint8_t> bin, std::vector<PackStream> streams);

  const PackPlan& plan() const { return plan_; }
  /// The file, with `json` (glTF, UTF-8) as its JSON chunk. Fails when it would exceed the 4 GiB of a GLB.
  Result<std::vector<uint8_t>> finish(std::string json) const;

 private:
  PackWriter() = default;

  std::vector<uint8_t> bin_;
  std::vector<uint8_t> data_;  ///< all streams: blocks and pages with their checks
  PackPlan plan_;
};

}  // namespace lightwell
