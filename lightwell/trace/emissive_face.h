// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/trace/light_sample.h"

namespace lightwell {

/// A triangle of an emissive surface as a source of light. Its front shines, or both sides when it is double-sided.
class EmissiveFace {
 public:
  EmissiveFace(const TraceScene& scene, uint32_t instance, uint32_t face);

  float area() const { return area_; }
  Vec3f center() const { return at({{1.0f / 3, 1.0f / 3}}); }
  /// Power per radiance, m2 sr: pi times the area, twice that when double-sided.
  float spread() const;
  /// The mean radiance over the area, W/m2/sr. Where the material varies it is estimated from 64 samples, accurate
  /// enough to choose sources by.
  Vec3f mean_emission(const TraceScene& scene) const;
  /// The least weight, W, by which a face that may shine is chosen, so that none is lost because all samples missed its
  /// lit part; 0 where the material is uniform.
  float least_weight(const TraceScene& scene) const;

  Emission emit(const TraceScene& scene, Random& random) const;
  /// The light that arrives at `point` from a uniformly chosen point of the face.
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
