// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/asset/file_asset.h"

namespace lightwell {

/// The codec number of this header's format: a gzip file (RFC 1952) of JSON.
inline constexpr uint8_t parts_codec_gzip = 0;

/// A file may inflate to so much whatever its size, and to so many times its size beyond that: JSON takes sixteen times
/// the memory of its text.
constexpr uint64_t parts_free_inflation = 1 << 20, parts_most_inflation = 16;

/// The parameters of a stream of parts (docs/format.md).
struct PartsParameters {
  uint32_t bytes = 0;     ///< of the whole file
  uint32_t inflated = 0;  ///< bytes of the JSON

  /// Whether a reader takes it: not where it is empty, or would inflate to more than its bytes allow.
  bool possible() const { return bytes > 0 && inflated <= parts_free_inflation + parts_most_inflation * bytes; }
  std::vector<uint8_t> write() const;
  /// Fails for a wrong length and for what is not possible.
  static Result<PartsParameters> read(Bytes bytes);
};

/// The file of parts.
class PartsAsset final : public FileAsset {
 public:
  static constexpr StreamKind kind = StreamKind::parts;

  PartsAsset(uint32_t asset, const PartsParameters& parameters)
      : FileAsset(parameters.bytes), asset_(asset), parameters_(parameters) {}

  const PartsParameters& parameters() const { return parameters_; }

 private:
  Update update() const override { return PartsUpdate{asset_, parameters_.inflated, file()}; }

  uint32_t asset_;
  PartsParameters parameters_;
};

}  // namespace lightwell
