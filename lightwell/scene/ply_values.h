// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/scene/ply_header.h"

namespace lightwell {

/// The numbers of a PLY file, one after another, in any of its three formats. After a fault (the end, a word that is
/// not a number) all further numbers are zero, and ok() is false for good.
class PlyValues {
 public:
  PlyValues(Bytes data, PlyFormat format) : reader_(data), format_(format) {}

  double number(PlyType type);
  /// The length of a list whose values have the type of `list`. Fails when it is not a whole number, or larger than the
  /// rest of the file can hold.
  size_t list_length(const PlyProperty& list);
  /// Skips a value or a whole list.
  void skip(const PlyProperty& property);
  bool ok() const { return ok_ && reader_.ok(); }

 private:
  double binary_number(PlyType type);
  double next_word();

  ByteReader reader_;
  PlyFormat format_;
  bool ok_ = true;
};

}  // namespace lightwell
