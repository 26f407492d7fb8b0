// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "lightwell/trace/lights.h"
#include "lightwell/trace/trace_scene.h"

namespace lightwell {

/// A scene made ready for light transport: its surfaces, to trace rays against, and its lights, to sample. Threads may
/// share it.
class World {
 public:
  /// Builds Embree's tree with `threads` threads, 0: all processors. The scene must outlive the world unchanged. Fails
  /// as TraceScene::build does, and when the power of all light is beyond the range of a float.
  static Result<std::unique_ptr<const World>> build(const Scene& scene, int threads = 0);

  /// The same surfaces, lit by only some of the luminaires, which keep their numbers.
  std::unique_ptr<const World> lit_by(const LuminaireSet& luminaires) const;

  const Scene& scene() const { return surfaces_->scene(); }
  const TraceScene& surfaces() const { return *surfaces_; }
  const Lights& lights() const { return lights_; }

 private:
  World(std::shared_ptr<const TraceScene> surfaces, const Lights& lights)
      : surfaces_(std::move(surfaces)), lights_(lights) {}

  std::shared_ptr<const TraceScene> surfaces_;
  Lights lights_;  // refers to the surfaces
};

}  // namespace lightwell
