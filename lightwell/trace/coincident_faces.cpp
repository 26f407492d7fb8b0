// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/coincident_faces.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "lightwell/base/random.h"

namespace lightwell {
namespace {

/// The count of layers of which one is opaque: nothing is seen behind it.
constexpr uint8_t is_opaque = 255;
static_assert(is_opaque > CoincidentFaces::most_layers);

/// Whether the corners, sorted, are in an odd order: the face's other way round has the same ones in an even order.
bool sort_corners(std::array<Vec3f, 3>& corners) {
  bool odd = false;
  for (const auto& [a, b] : {std::pair<size_t, size_t>{0, 1}, {1, 2}, {0, 1}}) {
    if (!(corners[b].e < corners[a].e)) continue;
    std::swap(corners[a], corners[b]);
    odd = !odd;
  }
  return odd;
}

uint64_t fingerprint_of(const std::array<Vec3f, 3>& corners, bool shines) {
  uint64_t key = shines ? 1 : 0;
  for (const Vec3f& corner : corners)
    for (const float c : corner.e)
      key = hash64((key << 1 | key >> 63) + std::bit_cast<uint32_t>(c + 0.f) + 0x9e3779b97f4a7c15u);  // -0 is 0
  return key;
}

}  // namespace

CoincidentFaces::Found CoincidentFaces::add(FaceNumber number, const std::array<Vec3f, 3>& corners,
                                            const FaceLayer& layer) {
  std::array<Vec3f, 3> sorted = corners;
  const bool way = sort_corners(sorted) != layer.mirrored;
  Layers& place = places_[fingerprint_of(sorted, layer.shines)];
  uint8_t& same = place.count[way];
  if (same >= most_layers) return {.hidden = true, .turned = {}};
  if (!layer.opaque) {
    same++;
    return {};
  }
  same = is_opaque;
  if (place.count[!way] == is_opaque) return {.hidden = false, .turned = place.opaque};
  place.opaque = number;
  return {};
}

}  // namespace lightwell
