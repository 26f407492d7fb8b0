// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "lightwell/base/random.h"
#include "lightwell/base/result.h"
#include "lightwell/scene/scene.h"
#include "lightwell/trace/material.h"

namespace lightwell {

class Lights;

/// A half-line from `origin` along a unit direction, up to `far` metres.
struct Ray {
  Vec3f origin{};
  Vec3f direction{};
  float far = std::numeric_limits<float>::infinity();
};

/// Where a ray meets a triangle.
struct Hit {
  Vec3f position{};
  Vec3f normal{};  ///< geometric, unit, of the front
  float distance = 0;
  uint32_t instance = 0;  ///< index into Scene::instances
  uint32_t face = 0;      ///< of the instance's mesh
  float u = 0, v = 0;     ///< weights of the face's second and third corner
  bool front = true;      ///< the ray came from the front

  /// The normal on the side that the ray came from.
  Vec3f facing_normal() const { return front ? normal : -normal; }
};

/// A scene made ready for tracing rays with Embree: everything but deforming primitives. Threads may share it.
class TraceScene {
 public:
  /// The scene must outlive the result and stay as it is. Fails when it has no triangle, or when memory runs out.
  static Result<TraceScene> build(const Scene& scene);
  ~TraceScene();
  TraceScene(TraceScene&&) noexcept;
  TraceScene& operator=(TraceScene&&) noexcept;

  const Scene& scene() const;
  const Lights& lights() const;
  /// Of what is traced.
  const Box3f& bounds() const;

  /// The nearest surface. Where a surface lets part of the light pass (alpha, transmission), chance decides whether the
  /// ray meets it: one number is drawn from `random` in scenes with such surfaces.
  bool intersect(const Ray& ray, Random& random, Hit& hit) const;
  /// True when something stops the ray before its end.
  bool occluded(const Ray& ray, Random& random) const;

  /// The material at a hit.
  Surface surface(const Hit& hit) const;
  /// The interpolated vertex normal, unit, on the side of the geometric one; that where the mesh has no normals. For
  /// display: transport uses the geometric normal.
  Vec3f shading_normal(const Hit& hit) const;
  bool double_sided(const Hit& hit) const;
  /// The corners of a face in scene space, counter-clockwise seen from the front.
  std::array<Vec3f, 3> corners(uint32_t instance, uint32_t face) const;

  /// A point this far off a surface sees past it: 1e-5 of the largest coordinate or extent of the bounds.
  float offset() const;
  /// The origin of a ray that leaves a surface at `position` on the side of `normal`.
  Vec3f leave(const Vec3f& position, const Vec3f& normal) const { return position + normal * offset(); }

 private:
  struct State;
  explicit TraceScene(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace lightwell
