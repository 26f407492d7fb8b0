// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/place.h"

#include <algorithm>
#include <cmath>

namespace lightwell {
namespace {

/// How many times its own size something may lie from the origin: 18 of a float's 24 bits are left for it.
constexpr double farthest = 64;
/// The share of the parts that tell how large the whole is.
constexpr double share_of_whole = 0.9;
constexpr size_t most_points = 4096;

/// The least value of key(part) that a share of the parts, by weight, do not exceed.
template <typename Key>
double quantile(std::vector<Place>& places, double share, const Key& key) {
  std::sort(places.begin(), places.end(), [&](const Place& a, const Place& b) { return key(a) < key(b); });
  double total = 0, reached = 0;
  for (const Place& place : places) total += place.weight;
  for (const Place& place : places) {
    reached += place.weight;
    if (reached >= share * total) return key(place);
  }
  return places.empty() ? 0 : key(places.back());
}

}  // namespace

Vec3d origin_amid(std::vector<Place> places) {
  Vec3d middle{};
  for (int axis = 0; axis < 3; axis++)
    middle[axis] = quantile(places, 0.5, [&](const Place& place) { return place.center[axis]; });
  const double size = quantile(places, share_of_whole,
                               [&](const Place& place) { return length(place.center - middle) + place.radius; });
  if (!(length(middle) > farthest * size)) return {};
  if (size == 0) return middle;
  const double step = std::exp2(std::floor(std::log2(size)));
  for (double& x : middle.e) x = std::round(x / step) * step;
  return middle;
}

Vec3d origin_amid(const std::vector<Vec3d>& points) {
  std::vector<Place> places;
  const size_t step = points.size() / most_points + 1;
  for (size_t i = 0; i < points.size(); i += step) places.push_back({points[i]});
  return origin_amid(std::move(places));
}

}  // namespace lightwell
