// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tsl/robin_map.h>

#include <array>
#include <cstdint>

#include "lightwell/base/vector.h"

namespace lightwell {

/// How a face takes part in what lies in its place.
struct FaceLayer {
  bool opaque = true;     ///< it stops every ray
  bool shines = false;    ///< the lamps that lie on a wall are to be hit as before
  bool mirrored = false;  ///< its front is on the other side of its winding
};

/// Finds faces that lie exactly on others, corner on corner and front on front. A ray that meets one of them meets all
/// at the same distance and has to be tested against each, so that thousands in one place, as careless exports and
/// duplicated objects have them, make every ray thousands of times as slow and show nothing.
class CoincidentFaces {
 public:
  /// As many faces that let light pass count in one place, see TraceScene's panes.
  static constexpr uint8_t most_layers = 16;

  /// Adds a face in scene space. True when it is behind an opaque one of those added before, or behind `most_layers`.
  bool hides(const std::array<Vec3f, 3>& corners, const FaceLayer& layer);

 private:
  struct Mixed {  // keys are fingerprints already
    size_t operator()(uint64_t key) const { return key; }
  };
  tsl::robin_map<uint64_t, uint8_t, Mixed> layers_;  // by fingerprint: of 10 million faces two share one by 3e-6
};

}  // namespace lightwell
