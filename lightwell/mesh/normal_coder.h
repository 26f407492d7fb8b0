// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdlib>

#include "lightwell/base/model_coder.h"
#include "lightwell/mesh/refinement.h"

namespace lightwell {

/// Codes the normals of a mesh whose faces are all there, vertex by vertex, as what they differ by from the normals of
/// these faces. Coded with the splits, when the faces are those of a coarser level, they take twice as much.
class NormalCoder {
 public:
  /// The normal of a vertex. False if no encoder writes such a stream.
  template <typename Coder>
  bool normal(Coder& coder, const Refinement& mesh, uint32_t vertex, NormalCode& value) {
    if (areas_.size() < mesh.vertices()) areas_ = mesh.area_normals();
    const NormalCode predicted = normal_code(areas_[vertex].cast<int64_t>());
    AdaptiveInteger& model = models_[std::min<size_t>(std::bit_width(recent_error_), models_.size() - 1)];
    const int64_t du = coder.integer(model, value.u - predicted.u), dv = coder.integer(model, value.v - predicted.v);
    if (std::abs(predicted.u + du) > 511 || std::abs(predicted.v + dv) > 511) return false;
    value = {static_cast<int16_t>(predicted.u + du), static_cast<int16_t>(predicted.v + dv)};
    if (vertex + 1 == mesh.vertices()) areas_ = {};
    recent_error_ = (recent_error_ * 7 + static_cast<uint32_t>(std::abs(du) + std::abs(dv)) * 4) / 8;
    return true;
  }

 private:
  std::vector<Vec<uint64_t, 3>> areas_;     // while normals are coded
  std::array<AdaptiveInteger, 12> models_;  // by how good recent predictions were
  uint32_t recent_error_ = 16;
};

}  // namespace lightwell
