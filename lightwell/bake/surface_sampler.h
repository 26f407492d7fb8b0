// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "lightwell/trace/sampling.h"
#include "lightwell/trace/trace_scene.h"

namespace lightwell {

/// A point a little off the front of a surface.
struct SurfacePoint {
  Vec3f position{};
  Vec3f normal{};         ///< unit, of the front
  Vec3f behind{};         ///< as far off the back
  uint32_t instance = 0;  ///< index into Scene::instances
};

/// Samples points of the fronts of all faces that are traced, as far as they lie in a box, evenly spread over the area.
class SurfaceSampler {
 public:
  /// The scene must outlive the sampler.
  SurfaceSampler(const TraceScene& scene, const Box3f& box);

  /// True when there is nothing in the box.
  bool empty() const { return chosen_.total() <= 0; }
  SurfacePoint sample(Random& random) const;

 private:
  using Triangle = std::array<Vec3f, 3>;

  /// Triangles that make up what lies in the box of a face.
  std::vector<Triangle> within(const Triangle& face) const;

  const TraceScene& scene_;
  const Box3f box_;
  std::vector<size_t> first_;  // face of each instance
  Distribution chosen_;
};

}  // namespace lightwell
