// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "lightwell/bake/estimator.h"
#include "lightwell/bake/gather_estimator.h"
#include "lightwell/bake/photon_estimator.h"

namespace lightwell {

std::span<const EstimatorKind> estimators() {
  static constexpr std::array table{
      EstimatorKind{"gather", "rays from the nodes to surfaces whose light is known", true, make_gather_estimator},
      EstimatorKind{"tracks", "the lengths of photons' flights through the nodes' boxes", false, make_track_estimator},
      EstimatorKind{"faces", "photons through the nodes' faces, as in the report of 2009", false, make_face_estimator},
  };
  return table;
}

}  // namespace lightwell
