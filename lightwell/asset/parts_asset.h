// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/asset/file_asset.h"

namespace lightwell {

/// The codec number of this header's format: a gzip file (RFC 1952) of JSON.
inline constexpr uint8_t parts_codec_gzip = 0;

/// A file may inflate to so much whatever its size, and else to so many times its size.
constexpr uint64_t parts_free_inflation = 1 << 20, parts_most_inflation = 200;

/// The parameters of a stream of parts (docs/format.md).
struct PartsParameters {
  uint32_t bytes = 0;     ///< of the whole file
  uint32_t inflated = 0;  ///< bytes of the JSON

  std::vector<uint8_t> write() const;
  /// Fails for a wrong length, an empty file and one that would inflate to more than its bytes allow.
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
