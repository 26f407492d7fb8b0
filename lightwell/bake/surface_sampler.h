// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
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
/// It takes 8 bytes a face, of instances that are alike once.
class SurfaceSampler {
 public:
  /// The scene must outlive the sampler.
  SurfaceSampler(const TraceScene& scene, const Box3f& box);

  /// True when there is nothing in the box.
  bool empty() const { return instances_.total() <= 0; }
  SurfacePoint sample(Random& random) const;

 private:
  using Triangle = std::array<Vec3f, 3>;

  /// The areas of an instance's faces, as far as they lie in the box.
  Distribution areas_of(uint32_t instance) const;
  /// Whether the faces have the same shares of the area in every such instance of the primitive: it lies in the box,
  /// and is not distorted.
  bool is_like_its_primitive(uint32_t instance, const Box3f& of_primitive) const;
  /// Triangles that make up what lies in the box of a face.
  std::vector<Triangle> within(const Triangle& face) const;

  const TraceScene& scene_;
  const Box3f box_;
  Distribution instances_;                                  // by area
  std::vector<std::shared_ptr<const Distribution>> faces_;  // of each instance, by area; shared by those that are alike
};

}  // namespace lightwell
