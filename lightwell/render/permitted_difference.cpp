// SPDX-License-Identifier: Apache-2.0
#include "lightwell/render/permitted_difference.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lightwell {
namespace {

struct Row {
  float contrast, step;  // in steps of a screen of 8 bits
};

// By Legge and Foley's formula, which lies above the lines between the rows.
constexpr std::array<Row, 7> rows{{{0, 1}, {2, 1}, {4, 1.537f}, {8, 2.362f}, {16, 3.630f}, {32, 5.579f}, {36, 6}}};

}  // namespace

float permitted_difference(float contrast) {
  const float steps = 255 * contrast;
  const auto above =
      std::find_if(rows.begin() + 1, rows.end() - 1, [&](const Row& row) { return row.contrast > steps; });
  const Row &from = *(above - 1), &to = *above;
  const float share = std::clamp((steps - from.contrast) / (to.contrast - from.contrast), 0.0f, 1.0f);
  return std::lerp(from.step, to.step, share) / 255;
}

}  // namespace lightwell
