// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/coincident_faces.h"

#include <algorithm>
#include <bit>

#include "lightwell/base/random.h"

namespace lightwell {
namespace {

uint64_t fingerprint_of(const std::array<Vec3f, 3>& corners, const FaceLayer& layer) {
  // The same face may begin at any of its corners.
  const size_t first = static_cast<size_t>(std::ranges::min_element(corners, {}, &Vec3f::e) - corners.begin());
  const size_t step = layer.mirrored ? 2 : 1;
  uint64_t key = layer.shines ? 1 : 0;
  for (size_t i = 0; i < 3; i++)
    for (const float c : corners[(first + i * step) % 3].e)
      key = hash64((key << 1 | key >> 63) + std::bit_cast<uint32_t>(c + 0.f) + 0x9e3779b97f4a7c15u);  // -0 is 0
  return key;
}

}  // namespace

bool CoincidentFaces::hides(const std::array<Vec3f, 3>& corners, const FaceLayer& layer) {
  uint8_t& layers = layers_[fingerprint_of(corners, layer)];
  if (layers >= most_layers) return true;
  layers = layer.opaque ? most_layers : static_cast<uint8_t>(layers + 1);
  return false;
}

}  // namespace lightwell
