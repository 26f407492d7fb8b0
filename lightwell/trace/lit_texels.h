// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/scene/scene.h"

namespace lightwell {

/// Where an image is not black, at a resolution of at most 512 cells an axis: tells in constant time whether a part of
/// it may shine.
class LitTexels {
 public:
  explicit LitTexels(const Image& image);

  /// False only when every bilinear lookup between the three texture coordinates is black.
  bool any(const TextureLookup& texture, const std::array<Vec2f, 3>& texcoords) const;

 private:
  /// Texels from `first` to `last` of an axis.
  struct Span {
    int first = 0, last = 0;
  };
  static Span span(float lo, float hi, int size, TextureLookup::Wrap wrap);

  int width_, height_;
  int cell_;                     // texels of a cell's side
  size_t columns_;               // of the table, one more than cells
  std::vector<uint32_t> below_;  // how many cells left of and above a corner have a texel that is not black
};

}  // namespace lightwell
