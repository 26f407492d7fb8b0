// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/lookup_sides.h"

#include <algorithm>
#include <cmath>

#include "lightwell/bake/surface_sampler.h"
#include "lightwell/base/parallel.h"

namespace lightwell {
namespace {

/// A node that a lookup reaches.
struct Reach {
  uint64_t place = 0;
  float weight = 0;  ///< negative through a wall
};
using Lookup = std::array<Reach, 8>;

/// Of a cell: a node so close behind a surface stands on it.
constexpr float on_surface = 0.15f;
constexpr float weight_of_backs = 0.25f;
/// Of a cell: how far lookups are shifted in front of their surfaces.
constexpr float most_offset = 0.25f;

/// Keeps a facing if it is one of those that weigh most.
void keep(Facings& facings, const Facing& more) {
  Facing& least = *std::min_element(facings.begin(), facings.end(),
                                    [](const Facing& a, const Facing& b) { return a.weight < b.weight; });
  if (more.weight > least.weight) least = more;
}

/// Whether a point is of a scene's lowest surface, which nobody sees from below.
bool is_ground(const SurfacePoint& front, const Box3f& box) {
  constexpr float flat = 0.7f, low = 0.01f;
  return front.normal[1] > flat && front.position[1] - box.lo[1] < low * box.size()[1];
}

}  // namespace

uint64_t lattice_place(int level, Vec3i corner) {
  while (level > 0 && ((corner[0] | corner[1] | corner[2]) & 1) == 0) {
    level--;
    for (int& c : corner.e) c /= 2;
  }
  uint64_t place = static_cast<uint64_t>(level);
  for (const int c : corner.e) place = place << 20 | static_cast<uint64_t>(c);
  return place;
}

LookupSides::LookupSides(const TraceScene& scene, const Box3f& box, size_t count, uint64_t seed) : scene_(scene) {
  const SurfaceSampler surfaces(scene, box);
  for (size_t i = 0; i < count && !surfaces.empty(); i++) {
    Random random(seed, i);
    const SurfacePoint front = surfaces.sample(random);
    points_.push_back({front.position, front.normal});
    if (!scene.material(front.instance).double_sided || is_ground(front, box)) continue;
    points_.push_back({front.behind, -front.normal, weight_of_backs});
  }
}

void LookupSides::follow(const GridShape& shape, const BrickTree& tree, int threads) {
  std::vector<Lookup> lookups(points_.size());
  const auto look_up = [&](const Point& point, Random& random) {
    // Whatever stands on a surface looks up the light in front of it, too, and closer to it.
    const Vec3f shifted = (point.position - shape.lo) / shape.cell + point.normal * (most_offset * random.uniform());
    const Vec3f place = max(Vec3f{}, min(shifted, shape.cells().cast<float>()));
    const auto brick = tree.finest(place);
    const int level = brick ? tree.bricks()[*brick].level : 0;
    const float scale = std::ldexp(1.0f, level);
    const Vec3f fine = place * scale, cell = shape.cell / scale;
    const Vec3i last = shape.cells() * (1 << level);
    Lookup lookup;
    for (int corner = 0; corner < 8; corner++) {
      Vec3i node;
      float weight = point.weight;
      for (int axis = 0; axis < 3; axis++) {
        const int first = std::min(static_cast<int>(fine[axis]), last[axis] - 1);
        const float fraction = fine[axis] - static_cast<float>(first);
        const int upper = corner >> axis & 1;
        node[axis] = first + upper;
        weight *= upper ? fraction : 1 - fraction;
      }
      const Vec3f way = shape.lo + cell * node.cast<float>() - point.position;
      const float distance = length(way);
      const float reach = distance + on_surface * max_component(-cell);
      const bool clear = weight == 0 || !(reach > 0) ||
                         mean_of_channels(scene_.transmittance({point.position, way / distance, reach}, random)) > 0.5f;
      lookup[static_cast<size_t>(corner)] = {lattice_place(level, node), clear ? weight : -weight};
    }
    return lookup;
  };
  parallel_for(points_.size(), 256, threads, [&](size_t begin, size_t end, int) {
    for (size_t i = begin; i < end; i++) {
      Random random(0, i);
      lookups[i] = look_up(points_[i], random);
    }
  });
  reached_.clear();
  for (size_t i = 0; i < lookups.size(); i++) {
    for (const Reach& reach : lookups[i]) {
      Reached& reached = reached_[reach.place];
      reached.balance += reach.weight;
      keep(reached.facings, {points_[i].normal, std::abs(reach.weight)});
    }
  }
}

float LookupSides::balance(uint64_t place) const {
  const auto found = reached_.find(place);
  return found != reached_.end() ? found->second.balance : 0;
}

Facings LookupSides::facings(uint64_t place) const {
  const auto found = reached_.find(place);
  return found != reached_.end() ? found->second.facings : Facings{};
}

}  // namespace lightwell
