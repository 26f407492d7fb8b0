// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/node_space.h"

#include "lightwell/bake/thin_walls.h"
#include "lightwell/bake/tracks.h"
#include "lightwell/base/parallel.h"
#include "lightwell/trace/sampling.h"

namespace lightwell {
namespace {

/// A node with a smaller free share counts as inside a solid: its light is mostly noise.
constexpr float least_free_share = 0.05f;

bool is_free(const TraceScene& scene, const FreeSpace& space, const Vec3f& point, Random& random) {
  Hit hit;
  if (!scene.intersect({point, sample_sphere(random)}, random, hit)) return !space.closed();
  return !space.from_inside(hit);
}

/// The free share of side^3 points, one in each part of the box.
float free_share(const TraceScene& scene, const FreeSpace& space, const Box3f& box, int side, Random& random) {
  int free = 0;
  for (int i = 0; i < side * side * side; i++) {
    const Vec3f part = Vec3i{{i % side, i / side % side, i / side / side}}.cast<float>();
    const Vec3f jitter{{random.uniform(), random.uniform(), random.uniform()}};
    const Vec3f point = box.lo + box.size() * ((part + jitter) / static_cast<float>(side));
    free += is_free(scene, space, point, random);
  }
  return static_cast<float>(free) / static_cast<float>(side * side * side);
}

}  // namespace

NodeSpace measure_node_space(const TraceScene& scene, const FreeSpace& space, const GridShape& shape, uint64_t seed,
                             int threads) {
  NodeSpace nodes{std::vector<float>(shape.count()), std::vector<uint8_t>(shape.count())};
  parallel_for(shape.count(), 256, threads, [&](size_t begin, size_t end, int) {
    for (size_t node = begin; node < end; node++) {
      Random random(seed, node);
      const Box3f box = node_box(shape, node);
      float share = free_share(scene, space, box, 4, random);
      // The light is divided by the share: the smaller it is, the more points it takes to know it within a few percent.
      if (share > 0 && share < 1) share = free_share(scene, space, box, share < 0.25f ? 16 : 10, random);
      nodes.free_share[node] = share;
      nodes.valid[node] = share >= least_free_share && !is_in_thin_wall(scene, space, shape, node);
    }
  });
  return nodes;
}

}  // namespace lightwell
