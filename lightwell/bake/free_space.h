// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/bake/solids.h"
#include "lightwell/base/progress.h"
#include "lightwell/trace/world.h"

namespace lightwell {

struct SurveyOptions {
  uint64_t most_photons = 1 << 20;  ///< fewer if that is enough
  uint64_t seed = 1;
  int threads = 0;  ///< 0: all processors
};

/// Tells the free space of a scene, where light may be, from the inside of solids.
class FreeSpace {
 public:
  /// Surveys a scene by photons, which fly where light does: on which sides they hit surfaces, and whether any escape.
  /// The result is the same for any number of threads. Fails when `progress` is cancelled. The world must outlive the
  /// result.
  static Result<FreeSpace> survey(const World& world, const SurveyOptions& options, Progress& progress);

  /// True when a ray that ends at this hit began inside a solid.
  bool from_inside(const Hit& hit) const { return solids_.from_inside(hit); }
  /// True when the scene is closed: light escapes only through the cracks that any mesh has.
  bool closed() const { return closed_; }

 private:
  explicit FreeSpace(Solids solids) : solids_(std::move(solids)) {}

  Solids solids_;
  bool closed_ = false;
};

}  // namespace lightwell
