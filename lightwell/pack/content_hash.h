// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "lightwell/pack/directory.h"

namespace lightwell {

/// The XXH3-128 of bytes that come in pieces: what a pack's id is made of.
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
