// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "lightwell/pack/directory.h"

namespace lightwell {

/// Incremental XXH3-128, from which a pack gets its id.
class ContentHash {
 public:
  ContentHash();
  ~ContentHash();

  void update(Bytes bytes);
  /// The hash of all bytes so far, in xxHash's canonical (big-endian) byte order.
  PackId finish() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lightwell
