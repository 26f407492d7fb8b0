// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "lightwell/base/vector.h"

namespace lightwell {

/// LDR-FLIP (Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astroem, Fairchild: FLIP: A Difference Evaluator for
/// Alternating Images, 2020): how strongly each pixel differs, 0 to 1, when two pictures are shown in turn. Pixels are
/// linear sRGB within [0, 1], row by row; pixels_per_degree is 67 for a 0.7 m wide screen of 3840 pixels at 0.7 m.
std::vector<float> flip(const std::vector<Vec3f>& reference, const std::vector<Vec3f>& test, int width, int height,
                        float pixels_per_degree = 67);

}  // namespace lightwell
