// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/trace/light_sample.h"

namespace lightwell {

/// A triangle of an emissive surface as a source of light. Its front shines, both sides when double-sided.
class EmissiveFace {
 public:
  EmissiveFace(const TraceScene& scene, uint32_t instance, uint32_t face);

  float area() const { return area_; }
  Vec3f center() const { return at({{1.0f / 3, 1.0f / 3}}); }
  /// The area and the hemispheres that it shines into: power = radiance * spread(), m2 sr.
  float spread() const;
  /// The mean radiance over the area, W/m2/sr; by 64 samples where the material changes on it: good enough to choose
  /// by.
  Vec3f mean_emission(const TraceScene& scene) const;
  /// The least weight by which a face that may shine is chosen: none is given up because all samples missed where it
  /// does. W; 0 where the material is the same everywhere.
  float least_weight(const TraceScene& scene) const;

  Emission emit(const TraceScene& scene, Random& random) const;
  /// Light of a uniform point of the face at `point`.
  Arrival arrive(const TraceScene& scene, const Vec3f& point, Random& random) const;
  /// The density with which arrive() at `point` chooses the direction to `hit`, 1/sr.
  float density(const Vec3f& point, const Hit& hit) const;

 private:
  Vec3f at(Vec2f uv) const { return corner_ + edge_u_ * uv[0] + edge_v_ * uv[1]; }
  Vec3f emission(const TraceScene& scene, Vec2f uv) const;

  uint32_t instance_ = 0;
  uint32_t face_ = 0;
  Vec3f corner_{}, edge_u_{}, edge_v_{}, normal_{};
  float area_ = 0;
  bool double_sided_ = false;
};

}  // namespace lightwell
