// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/enclosure.h"

#include <algorithm>
#include <map>

#include "lightwell/trace/sampling.h"

namespace lightwell {
namespace {

constexpr int ways = 256;
/// That may get out, by the cracks that any mesh has.
constexpr int most_out = ways / 50;
/// Of the focus's extent: a bulb reaches no farther.
constexpr float largest_bulb = 1.0f / 16;

}  // namespace

std::optional<Enclosure> enclosure_of(const TraceScene& scene, const Vec3f& place) {
  Random random(1, 0);
  const float shift = random.uniform(), turn = random.uniform();
  Enclosure found;
  std::map<uint32_t, int> counts;
  int out = 0;
  for (int i = 0; i < ways; i++) {
    const Vec3f direction = sphere_direction(static_cast<size_t>(i), ways, shift, turn);
    Hit hit;
    if (!scene.intersect({place, direction}, random, hit) || hit.front) {
      if (++out > most_out) return std::nullopt;
      continue;
    }
    counts[hit.instance]++;
    found.reach = std::max(found.reach, hit.distance);
  }
  found.instance = std::max_element(counts.begin(), counts.end(), [](const auto& a, const auto& b) {
                     return a.second < b.second;
                   })->first;
  return found;
}

float bulb_radius(const TraceScene& scene, const Lamp& lamp) {
  if (lamp.kind == Lamp::Kind::sun) return 0;
  const auto around = enclosure_of(scene, lamp.position);
  if (!around || around->reach > largest_bulb * max_component(scene.focus().size())) return 0;
  return around->reach * 1.05f;  // rays that are between those that were tried may go a little farther
}

}  // namespace lightwell
