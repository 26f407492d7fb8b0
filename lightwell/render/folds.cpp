// SPDX-License-Identifier: Apache-2.0
#include "lightwell/render/folds.h"

#include <algorithm>

namespace lightwell {

Vec3f irradiance_in_folds(const Vec3f& albedo, const Vec3f& sky, const Vec3f& reflected, const Vec3f& share_in_cells,
                          const Vec3f& share) {
  Vec3f irradiance;
  for (size_t c = 0; c < 3; c++) {
    const float hidden = std::min(share_in_cells[c], 1.0f) - share[c];
    irradiance[c] = std::max(sky[c], (sky[c] + reflected[c]) / (1 - std::min(albedo[c] * hidden, 0.95f)));
  }
  return irradiance;
}

}  // namespace lightwell
