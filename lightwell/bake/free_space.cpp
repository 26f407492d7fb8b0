// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/free_space.h"

#include "lightwell/bake/tracks.h"
#include "lightwell/base/parallel.h"
#include "lightwell/trace/sampling.h"

namespace lightwell {
namespace {

/// What decides whether a point is in free space.
struct Space {
  const TraceScene& scene;
  const Solids& solids;
  bool closed;

  bool is_seen_from(const Vec3f& point, Random& random) const {
    Hit hit;
    if (!scene.intersect({point, sample_sphere(random)}, random, hit)) return !closed;
    return !solids.from_inside(hit);
  }
};

/// The share of side^3 points, one in each part of the box.
float free_share(const Space& space, const Box3f& box, int side, Random& random) {
  int seen = 0;
  for (int i = 0; i < side * side * side; i++) {
    const Vec3f part = Vec3i{{i % side, i / side % side, i / side / side}}.cast<float>();
    const Vec3f jitter{{random.uniform(), random.uniform(), random.uniform()}};
    const Vec3f point = box.lo + box.size() * ((part + jitter) / static_cast<float>(side));
    seen += space.is_seen_from(point, random);
  }
  return static_cast<float>(seen) / static_cast<float>(side * side * side);
}

}  // namespace

std::vector<float> free_shares(const TraceScene& scene, const Solids& solids, const GridShape& shape, bool closed,
                               uint64_t seed, int threads) {
  const Space space{scene, solids, closed};
  std::vector<float> shares(shape.count());
  parallel_for(shares.size(), 256, threads, [&](size_t begin, size_t end, int) {
    for (size_t node = begin; node < end; node++) {
      Random random(seed, node);
      const Box3f box = node_box(shape, node);
      float share = free_share(space, box, 4, random);
      // The light is divided by the share: the smaller it is, the more points it takes to be right by a few percent.
      if (share > 0 && share < 1) share = free_share(space, box, share < 0.25f ? 16 : 10, random);
      shares[node] = share;
    }
  });
  return shares;
}

}  // namespace lightwell
