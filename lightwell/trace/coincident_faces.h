// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tsl/robin_map.h>

#include <array>
#include <cstdint>
#include <optional>

#include "lightwell/base/vector.h"

namespace lightwell {

/// How a face takes part in what lies in its place.
struct FaceLayer {
  bool opaque = true;     ///< it stops every ray
  bool shines = false;    ///< the lamps that lie on a wall are to be hit as before
  bool mirrored = false;  ///< its front is on the other side of its winding
};

/// A face of a scene's instance.
struct FaceNumber {
  uint32_t instance, face;
};

/// Finds faces that lie exactly on others, corner on corner. Of those that face the same way a ray that meets one meets
/// all, at the same distance, and has to be tested against each, so that thousands in one place, as careless exports
/// and duplicated objects have them, make every ray thousands of times as slow and show nothing. Of two that face
/// opposite ways, as both sides of a sheet are often made, a ray meets either by chance, and its back as often as its
/// front.
class CoincidentFaces {
 public:
  /// As many faces that let light pass count in one place, see TraceScene's panes.
  static constexpr uint8_t most_layers = 16;

  struct Found {
    bool hidden = false;               ///< it is behind an opaque one of those added before, or behind `most_layers`
    std::optional<FaceNumber> turned;  ///< both are opaque and nothing hides them, but they face opposite ways
  };
  /// Adds a face, its corners given in scene space.
  Found add(FaceNumber number, const std::array<Vec3f, 3>& corners, const FaceLayer& layer);

 private:
  struct Mixed {  // keys are fingerprints already
    size_t operator()(uint64_t key) const { return key; }
  };
  struct Layers {
    FaceNumber opaque;             // the first one, either way round
    std::array<uint8_t, 2> count;  // each way round; most_layers once one is opaque
  };
  tsl::robin_map<uint64_t, Layers, Mixed> places_;  // by fingerprint: of 10 million faces two share one by 3e-6
};

}  // namespace lightwell
