// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/scene/scene.h"

namespace lightwell {

/// A map of where an image is not black, with at most 512 cells on an axis. Tells in constant time whether a part of
/// the image may shine.
class LitTexels {
 public:
  explicit LitTexels(const Image& image);

  /// False only if every bilinear lookup inside the triangle of the texture coordinates is black.
  bool any(const TextureLookup& texture, const std::array<Vec2f, 3>& texcoords) const;

 private:
  /// The texels `first` to `last` of an axis, inclusive.
  struct Span {
    int first = 0, last = 0;
  };
  static Span span(float lo, float hi, int size, TextureLookup::Wrap wrap);

  int width_, height_;
  int cell_;                     // texels along a cell's side
  size_t columns_;               // of the table, one more than there are cells
  std::vector<uint32_t> below_;  // summed-area table: the number of lit cells left of and above each corner
};

}  // namespace lightwell
