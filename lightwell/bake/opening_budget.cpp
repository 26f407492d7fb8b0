// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/opening_budget.h"

#include <algorithm>
#include <numeric>

namespace lightwell {
namespace {

constexpr uint32_t fewest_vertices = 24;       // a coarser level shows nothing of a shape
constexpr uint32_t stream_worth_bytes = 1024;  // what a stream costs in the directory, the JSON and a request

}  // namespace

uint32_t opening_bytes_per_vertex(const Mesh& mesh) {
  uint32_t bytes = 12 + 12;
  if (!mesh.normals.empty()) bytes += 12;
  for (const auto& set : mesh.texcoords)
    if (!set.empty()) bytes += 8;
  if (!mesh.colors.empty()) bytes += 4;
  return bytes;
}

std::vector<uint32_t> share_opening(const std::vector<const Mesh*>& meshes, uint64_t budget) {
  std::vector<uint64_t> whole(meshes.size());
  for (size_t i = 0; i < meshes.size(); i++)
    whole[i] = uint64_t(opening_bytes_per_vertex(*meshes[i])) * meshes[i]->positions.size();
  std::vector<size_t> ascending(meshes.size());
  std::iota(ascending.begin(), ascending.end(), size_t(0));
  std::stable_sort(ascending.begin(), ascending.end(), [&](size_t a, size_t b) { return whole[a] < whole[b]; });

  std::vector<uint32_t> vertices(meshes.size(), 0);
  uint64_t left = budget;
  for (size_t rank = 0; rank < ascending.size(); rank++) {
    const size_t i = ascending[rank];
    const uint64_t share = left / (ascending.size() - rank);
    const uint32_t each = opening_bytes_per_vertex(*meshes[i]);
    if (whole[i] <= std::max<uint64_t>(share, fewest_vertices * each) + stream_worth_bytes) {
      left -= std::min(left, whole[i]);
    } else {
      vertices[i] = std::max(fewest_vertices, static_cast<uint32_t>(share / each));
      left -= std::min<uint64_t>(left, uint64_t(vertices[i]) * each);
    }
  }
  return vertices;
}

}  // namespace lightwell
