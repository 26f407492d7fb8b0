// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/bake/solids.h"
#include "lightwell/base/progress.h"
#include "lightwell/trace/world.h"

namespace lightwell {

struct SurveyOptions {
  uint64_t most_photons = 1 << 20;  ///< fewer where fewer tell
  uint64_t seed = 1;
  int threads = 0;  ///< 0: all processors
};

/// What of a scene is free space, where light may be, and what is the inside of solids.
class FreeSpace {
 public:
  /// Finds out by photons, which fly where light does: on which sides they meet surfaces, and whether any get away. The
  /// same for any number of threads. Fails when `progress` asks to stop. The world must outlive the result.
  static Result<FreeSpace> survey(const World& world, const SurveyOptions& options, Progress& progress);

  /// True when a ray that ends at this hit began inside a solid.
  bool from_inside(const Hit& hit) const { return solids_.from_inside(hit); }
  /// True when the scene is closed: no light escapes from it but through the cracks that any mesh has.
  bool closed() const { return closed_; }

 private:
  explicit FreeSpace(Solids solids) : solids_(std::move(solids)) {}

  Solids solids_;
  bool closed_ = false;
};

}  // namespace lightwell
