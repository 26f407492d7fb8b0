// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <vector>

#include "lightwell/trace/sampling.h"

namespace lightwell {

/// The sphere of directions in bins of equal solid angle, rows of y and columns around it; one bin more is for samples
/// without a direction.
struct DirectionBins {
  static constexpr size_t rows = 40, columns = 20, count = rows * columns + 1;

  static size_t of(const Vec3f& direction) {
    const float turn = std::atan2(direction[2], direction[0]) / (2 * pi);
    return place((direction[1] + 1) / 2, rows) * columns + place(turn < 0 ? turn + 1 : turn, columns);
  }
  static size_t without() { return count - 1; }

  /// The share of samples that belongs into each bin: the integral of a density by fine sums. What it lacks of 1 is
  /// without a direction.
  template <typename Density>
  static std::vector<double> shares(const Density& density) {
    constexpr size_t fine = 24;
    std::vector<double> shares(count);
    double all = 0;
    for (size_t row = 0; row < rows * fine; row++) {
      for (size_t column = 0; column < columns * fine; column++) {
        const float height = 2 * (static_cast<float>(row) + 0.5f) / (rows * fine) - 1;
        const float turn = 2 * pi * (static_cast<float>(column) + 0.5f) / (columns * fine);
        const float radius = std::sqrt(1 - height * height);
        const Vec3f direction{{radius * std::cos(turn), height, radius * std::sin(turn)}};
        const double share =
            static_cast<double>(density(direction)) * 4 * std::numbers::pi / (rows * columns * fine * fine);
        shares[row / fine * columns + column / fine] += share;
        all += share;
      }
    }
    shares.back() = std::max(0.0, 1 - all);
    return shares;
  }

 private:
  static size_t place(float x, size_t bins) {
    return std::min(static_cast<size_t>(std::max(x, 0.0f) * static_cast<float>(bins)), bins - 1);
  }
};

}  // namespace lightwell
