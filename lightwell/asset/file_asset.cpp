// SPDX-License-Identifier: Apache-2.0
#include "lightwell/asset/file_asset.h"

namespace lightwell {

Result<void> FileAsset::append(Bytes payload) {
  LW_CHECK(blocks_.append(payload));
  return complete() ? check() : Result<void>();
}

std::optional<Update> FileAsset::take(size_t) {
  if (taken_ || !complete()) return std::nullopt;
  taken_ = true;
  return update();
}

Result<void> spend_on_file(const AssetSource& source, uint32_t bytes) {
  if (bytes > source.entry.length) return fail("parameters", "promise more bytes than the stream has");
  return source.context.spend(bytes);
}

}  // namespace lightwell
