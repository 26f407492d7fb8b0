// SPDX-License-Identifier: Apache-2.0
#include "lightwell/light/stream_model.h"

#include "lightwell/base/assert.h"
#include "lightwell/base/random.h"

namespace lightwell {
namespace {

int longest_axis(const GridShape& shape) {
  return static_cast<int>(std::max_element(shape.nodes.e.begin(), shape.nodes.e.end()) - shape.nodes.e.begin());
}

bool is_corner(const GridShape& shape, const Vec3i& n) {
  for (int a = 0; a < 3; a++) {
    if (n[a] != 0 && n[a] != shape.nodes[a] - 1) return false;
  }
  return true;
}

// The nodes of a slice except the corners of the grid, shuffled (Fisher and Yates).
std::vector<uint32_t> shuffled_slice(const GridShape& shape, int axis, int slice, uint64_t seed) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  std::vector<uint32_t> places;
  Vec3i n;
  n[axis] = slice;
  for (n[v] = 0; n[v] < shape.nodes[v]; n[v]++) {
    for (n[u] = 0; n[u] < shape.nodes[u]; n[u]++) {
      if (!is_corner(shape, n)) places.push_back(static_cast<uint32_t>(shape.index(n)));
    }
  }
  Random random(seed, static_cast<uint64_t>(slice));
  for (size_t left = places.size(); left > 1; left--) {
    std::swap(places[left - 1], places[random.below(static_cast<uint32_t>(left))]);
  }
  return places;
}

}  // namespace

LightOrder light_order(const GridShape& shape, uint64_t seed, int nodes_per_slice) {
  LW_ASSERT(nodes_per_slice > 0);
  const int axis = longest_axis(shape);
  std::vector<std::vector<uint32_t>> slices;
  for (int s = 0; s < shape.nodes[axis]; s++) slices.push_back(shuffled_slice(shape, axis, s, seed));

  LightOrder order;
  order.nodes.reserve(shape.count() - 8);
  for (size_t first = 0; order.nodes.size() < shape.count() - 8; first += static_cast<size_t>(nodes_per_slice)) {
    for (const std::vector<uint32_t>& slice : slices) {
      const size_t begin = std::min(first, slice.size());
      const size_t end = std::min(first + static_cast<size_t>(nodes_per_slice), slice.size());
      order.nodes.insert(order.nodes.end(), slice.begin() + static_cast<ptrdiff_t>(begin),
                         slice.begin() + static_cast<ptrdiff_t>(end));
    }
    order.ends.push_back(static_cast<uint32_t>(order.nodes.size()));
  }
  return order;
}

std::array<size_t, 8> corner_nodes(const GridShape& shape) {
  std::array<size_t, 8> corners;
  for (int i = 0; i < 8; i++) {
    const Vec3i upper{{i & 1, i >> 1 & 1, i >> 2}};
    corners[static_cast<size_t>(i)] = shape.index(upper * (shape.nodes - Vec3i::filled(1)));
  }
  return corners;
}

SharedExponent SharedExponent::of(uint32_t bits) {
  return {{static_cast<int>(bits & 511), static_cast<int>(bits >> 9 & 511), static_cast<int>(bits >> 18 & 511)},
          static_cast<int>(bits >> 27)};
}

uint32_t SharedExponent::bits() const {
  return static_cast<uint32_t>(mantissa[0]) | static_cast<uint32_t>(mantissa[1]) << 9 |
         static_cast<uint32_t>(mantissa[2]) << 18 | static_cast<uint32_t>(exponent) << 27;
}

int shared_exponent(const std::array<int64_t, 3>& values) {
  const auto largest = static_cast<uint64_t>(std::max({values[0], values[1], values[2]}));
  return std::clamp(static_cast<int>(std::bit_width(largest)) - 9, 0, 31);
}

KnownNeighbours RecordField::neighbours(size_t node) const {
  const Vec3i center = shape_.node(node);
  KnownNeighbours found;
  for (int radius = 1; found.count == 0; radius++) {
    const Vec3i lo = max(center - Vec3i::filled(radius), Vec3i{});
    const Vec3i hi = min(center + Vec3i::filled(radius), shape_.nodes - Vec3i::filled(1));
    Vec3i n;
    for (n[2] = lo[2]; n[2] <= hi[2]; n[2]++) {
      for (n[1] = lo[1]; n[1] <= hi[1]; n[1]++) {
        // Of a row inside the cube, only the two ends belong to the shell.
        const bool inside = std::max(std::abs(n[1] - center[1]), std::abs(n[2] - center[2])) < radius;
        const int step = inside ? 2 * radius : 1;
        for (n[0] = inside ? center[0] - radius : lo[0]; n[0] <= hi[0]; n[0] += step) {
          if (n[0] < 0 || found.count == found.items.size()) continue;
          const size_t other = shape_.index(n);
          if (!known_[other]) continue;
          const int distance = dot(n - center, n - center);  // squared
          found.items[found.count++] = {static_cast<uint32_t>(other), std::max(1, 256 / (distance * distance))};
        }
      }
    }
  }
  return found;
}

RecordExpectation RecordField::expect(const KnownNeighbours& neighbours, bool valid) const {
  const std::span around(neighbours.items.data(), neighbours.count);
  const bool any =
      std::any_of(around.begin(), around.end(), [&](const auto& n) { return records_[n.node].valid() == valid; });

  RecordExpectation sum;
  int total = 0;
  for (const auto& [node, weight] : around) {
    const MomentsRecord& record = records_[node];
    if (any && record.valid() != valid) continue;
    total += weight;
    for (size_t d = 0; d < 6; d++) {
      const SharedExponent value = SharedExponent::of(record.irradiance[d]);
      for (size_t c = 0; c < 3; c++) sum.irradiance[d][c] += (int64_t(value.mantissa[c]) << value.exponent) * weight;
    }
    for (size_t i = 0; i < 9; i++) sum.mixed[i] += (i > 0 || record.valid() ? record.mixed[i] : 0) * weight;
  }
  for (auto& direction : sum.irradiance) {
    for (int64_t& channel : direction) channel = (channel + total / 2) / total;
  }
  for (int& entry : sum.mixed) entry = (entry + (entry < 0 ? -total : total) / 2) / total;
  return sum;
}

}  // namespace lightwell
