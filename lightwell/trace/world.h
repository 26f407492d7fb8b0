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
  /// The scene must outlive the world and stay as it is. `threads` build Embree's tree, 0: all processors. Fails when
  /// the scene has no triangle, when positions or light leave the range of numbers that can be calculated with, or when
  /// memory runs out.
  static Result<std::unique_ptr<const World>> build(const Scene& scene, int threads = 0);

  const Scene& scene() const { return surfaces_->scene(); }
  const TraceScene& surfaces() const { return *surfaces_; }
  const Lights& lights() const { return lights_; }

 private:
  explicit World(std::unique_ptr<const TraceScene> surfaces) : surfaces_(std::move(surfaces)), lights_(*surfaces_) {}

  std::unique_ptr<const TraceScene> surfaces_;
  Lights lights_;  // refers to the surfaces
};

}  // namespace lightwell
