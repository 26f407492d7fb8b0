// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "lightwell/bake/estimator.h"
#include "lightwell/bake/node_surroundings.h"

namespace lightwell {

/// The light of places, gathered by rays whose ends a surface cache lights: all that has been reflected, and the direct
/// light of the luminaires that a grid contains. Threads may share it.
class GatheredLight {
 public:
  /// What the scene and the options refer to must outlive this.
  GatheredLight(const BakeScene& scene, const EstimatorOptions& options);

  const World& world() const { return world_; }
  const Box3f& box() const { return box_; }

  /// The light of a node: what is around its viewpoint(). But where it lies close behind a surface that has one side, E
  /// of the direction in which that faces is what arrives there: lookups in front of it reach back to the node. One
  /// that lies on a sheet is all insides. It is fitted() to the surfaces whose lookups reach it. What the options'
  /// journal knows is taken from there. The same whenever and by whichever thread it is asked for.
  NodeSurroundings at_node(const Vec3f& node, const Vec3f& cell, const Facings& facings = {}, int most_sets = 16) const;

  /// A set of rays from a node. As many again are taken up to `most_sets` times, less with less effort, where they
  /// leave much noise, which shows as blotches on flat walls: in a room they leave 1.4 %.
  static constexpr int rays_a_node = 256;
  NodeSurroundings around(const Vec3f& position, Random& random, int rays = rays_a_node,
                          const Facings& facings = {}) const;

  /// What a surface receives. Rays that end within so many cells of the surface cache are followed on: see gather().
  Received received(const Vec3f& position, const Vec3f& normal, int rays, Random& random, float near = 1) const;

 private:
  NodeSurroundings gather_node(const Vec3f& node, const Vec3f& cell, const Facings& facings, int most_sets,
                               Random& random) const;
  /// Gathers along ray(0) ... ray(count - 1) and calls take(direction, gathering) for each in turn. Each is taken a few
  /// rays later, when the memory has the light of what it sees.
  template <typename RayOf, typename Take>
  void gather_rays(int count, float near, Random& random, const RayOf& ray, const Take& take) const;
  Vec3f reflected(const Gathering& gathering) const { return reflected_ ? cache_.reflected(gathering) : Vec3f{}; }
  /// The radiance that the contained luminaires send straight along a ray, weighted beside samples of the luminaires;
  /// `density` is that of the rays, 1/sr.
  Vec3f emitted(const Vec3f& position, const Vec3f& direction, const Gathering& gathering, float density) const;
  /// A point of the last surface on the way, within `reach`, that faces along it, when only backs are met before;
  /// nothing when there is none.
  std::optional<Vec3f> facing_surface(const Vec3f& position, const Vec3f& direction, float reach, Random& random) const;
  NodeSurroundings without_much_noise(const Vec3f& position, const Facings& facings, int most_sets,
                                      Random& random) const;
  template <typename Add>
  uint32_t sample_luminaires(const Vec3f& position, const Vec3f& normal, Random& random, const Add& add) const;

  const World& world_;
  const FreeSpace& space_;
  const SurfaceCache& cache_;
  const LuminaireSet contained_;
  const bool reflected_;
  const float effort_;
  const Box3f box_;
  const uint64_t seed_;
  NodeJournal* const journal_;
  uint64_t inputs_ = 0;  // tells apart what the light depends on
  float dark_ = 0;       // of what size_of() moments is, W/m2: less is not worth more rays
};

/// Where the light of a node is looked for. A node on a face of the box of what is baked, where walls stand, is moved
/// inwards by a tenth of a cell: closer to a wall it would see little else.
Vec3f viewpoint(const Box3f& box, const Vec3f& node, const Vec3f& cell);

}  // namespace lightwell
