// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/asset/codecs.h"
#include "lightwell/base/file_blocks.h"

namespace lightwell {

/// A file that a stream carries in blocks: handed on as a whole once it is complete.
class FileAsset : public AssetDecoder {
 public:
  Result<void> append(Bytes payload) final;
  uint64_t added() const final { return file().size(); }
  bool complete() const final { return blocks_.complete(); }
  std::optional<Update> take(size_t budget) final;

  /// The bytes decoded so far; when complete, the file.
  const std::vector<uint8_t>& file() const { return blocks_.file(); }

 protected:
  explicit FileAsset(uint32_t bytes) : blocks_(bytes) {}

  /// Fails when the complete file is not what its stream states.
  virtual Result<void> check() const { return {}; }
  virtual Update update() const = 0;

 private:
  FileBlocks blocks_;
  bool taken_ = false;
};

/// Fails for a file of more bytes than its stream has, or than the budget has.
Result<void> spend_on_file(const AssetSource& source, uint32_t bytes);

}  // namespace lightwell
