// SPDX-License-Identifier: Apache-2.0
#include "lightwell/asset/light_asset.h"

namespace lightwell {

bool LightAsset::settled() const {
  return received() == settled_ || (received() < settled_ + settled_ / 8 && received() < total());
}

bool LightAsset::settle() {
  if (settled()) return false;
  atlas_.update(filled(fill_));
  settled_ = received();
  return true;
}

std::optional<Update> LightAsset::take(size_t) {
  if (taken_ == settled_) return std::nullopt;
  taken_ = settled_;
  const auto size = [](int n) { return static_cast<uint32_t>(n); };
  const Bytes bytes(reinterpret_cast<const uint8_t*>(atlas_.halves().data()), atlas_.halves().size_bytes());
  return LightUpdate{
      asset_, size(atlas_.width()), size(atlas_.height()), size(atlas_.depth()), static_cast<uint32_t>(settled_),
      bytes};
}

}  // namespace lightwell
