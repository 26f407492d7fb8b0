// SPDX-License-Identifier: Apache-2.0
#include "lightwell/mesh/progressive.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace lightwell {
namespace {

// The points in order of refinement: those that stay, then round by round, from the last to the first, the removed
// ones. Within a pass they follow the sweep over the points present: each point is followed by its children for the
// next pass, so that the sweep, and with it every block of the stream, stays compact in space.
std::vector<uint32_t> refinement_order(const CollapseOrder& order, ProgressiveMesh& out) {
  std::vector<uint32_t> sweep, next_sweep, numbered;
  for (uint32_t v = 0; v < order.target.size(); v++)
    if (order.target[v] == v) sweep.push_back(v);
  numbered = sweep;
  out.base_points = static_cast<uint32_t>(sweep.size());

  std::vector<uint32_t> first_child(order.target.size(), no_vertex), sibling(order.target.size(), no_vertex);
  for (auto round = order.rounds.rbegin(); round != order.rounds.rend(); ++round) {
    for (const uint32_t v : round->removed) sibling[v] = std::exchange(first_child[order.target[v]], v);
    next_sweep.clear();
    for (const uint32_t v : sweep) {
      next_sweep.push_back(v);
      for (uint32_t child = std::exchange(first_child[v], no_vertex); child != no_vertex; child = sibling[child]) {
        next_sweep.push_back(child);
        numbered.push_back(child);
      }
    }
    std::swap(sweep, next_sweep);
    out.passes.push_back({static_cast<uint32_t>(numbered.size()), round->error});
  }
  return numbered;
}

template <typename T>
std::vector<T> permuted(const std::vector<T>& values, const std::vector<uint32_t>& order) {
  std::vector<T> out;
  out.reserve(values.size());
  if (!values.empty())
    for (const uint32_t v : order) out.push_back(values[v]);
  return out;
}

QuantizedMesh permuted(const QuantizedMesh& mesh, const std::vector<uint32_t>& order) {
  QuantizedMesh out;
  out.position_lattice = mesh.position_lattice;
  out.texcoord_lattices = mesh.texcoord_lattices;
  out.region_shifts = mesh.region_shifts;
  out.positions = permuted(mesh.positions, order);
  out.normals = permuted(mesh.normals, order);
  for (size_t set = 0; set < 2; set++) out.texcoords[set] = permuted(mesh.texcoords[set], order);
  out.colors = permuted(mesh.colors, order);
  out.rows = permuted(mesh.rows, order);
  return out;
}

// Adds the faces, renumbered, in order of appearance: those of the coarsest level by region, those that come with each
// vertex, loose ones.
void order_faces(const QuantizedMesh& mesh, const CollapseOrder& order, const std::vector<uint32_t>& number,
                 ProgressiveMesh& out) {
  const uint64_t loose_last = number.size();
  const auto region_of = [&](uint32_t face) { return mesh.regions.empty() ? uint16_t(0) : mesh.regions[face]; };
  std::vector<std::tuple<uint64_t, uint16_t, uint32_t>> appearance(mesh.faces.size());
  for (uint32_t f = 0; f < mesh.faces.size(); f++) {
    const uint32_t vanished = order.vanished[f];
    const bool base = vanished == CollapseOrder::never, loose = vanished == CollapseOrder::loose;
    appearance[f] = {base ? 0 : loose ? loose_last : number[vanished], base ? region_of(f) : uint16_t(0), f};
    out.base_faces += base;
    out.loose_faces += loose;
  }
  std::sort(appearance.begin(), appearance.end());
  std::vector<std::pair<Face, uint16_t>> loose_faces;
  for (const auto& [when, base_region, f] : appearance) {
    const Face& old = mesh.faces[f];
    Face face{number[old[0]], number[old[1]], number[old[2]]};
    if (when == loose_last) {
      // Loose faces lie near others: they are told by their first corner, the least.
      std::rotate(face.begin(), std::ranges::min_element(face), face.end());
      loose_faces.emplace_back(face, region_of(f));
      continue;
    }
    out.appears_with.push_back(static_cast<uint32_t>(when));
    out.mesh.faces.push_back(face);
    if (!mesh.regions.empty()) out.mesh.regions.push_back(region_of(f));
  }
  std::ranges::sort(loose_faces);
  for (const auto& [face, region] : loose_faces) {
    out.mesh.faces.push_back(face);
    if (!mesh.regions.empty()) out.mesh.regions.push_back(region);
  }
}

}  // namespace

std::vector<SimplifiedMesh::Level> SimplifiedMesh::levels() const {
  std::vector<uint32_t> round_of(points.count());
  for (uint32_t i = 0; i < order.rounds.size(); i++)
    for (const uint32_t point : order.rounds[i].removed) round_of[point] = i;

  std::vector<Level> levels(order.rounds.size() + 1);
  const auto loose = std::ranges::count(order.vanished, CollapseOrder::loose);
  levels[0] = {static_cast<uint32_t>(mesh.positions.size()), static_cast<uint32_t>(mesh.faces.size() - loose), 0};
  for (const uint32_t corner : order.vanished)
    if (corner < CollapseOrder::loose) levels[round_of[points.of[corner]] + 1].faces++;
  for (size_t i = 0; i < order.rounds.size(); i++) {
    uint32_t removed = 0;
    for (const uint32_t point : order.rounds[i].removed) removed += points.first[point + 1] - points.first[point];
    levels[i + 1] = {levels[i].vertices - removed, levels[i].faces - levels[i + 1].faces, order.rounds[i].error};
  }
  return levels;
}

Result<SimplifiedMesh> simplify(const Mesh& mesh, const SimplifyOptions& options, Progress& progress) {
  LW_TRY(quantized, quantize(mesh, options.quantize));
  Points points(quantized.positions);
  LW_TRY(order, collapse_order(quantized, points, options.base_vertices, progress));
  return SimplifiedMesh{std::move(quantized), std::move(points), std::move(order)};
}

Result<ProgressiveMesh> build_progressive(const Mesh& mesh, const SimplifyOptions& options, Progress& progress) {
  LW_TRY(simplified, simplify(mesh, options, progress));
  const size_t rounds = simplified.order.rounds.size();
  return refine_after(std::move(simplified), rounds);
}

ProgressiveMesh refine_after(SimplifiedMesh simplified, size_t rounds) {
  simplified.order.keep_rounds(rounds, simplified.points);
  const auto& [quantized, points, order] = simplified;

  ProgressiveMesh out;
  std::vector<uint32_t> old_of;  // of each vertex in the new order
  for (const uint32_t point : refinement_order(order, out)) {
    out.first_of_point.push_back(static_cast<uint32_t>(old_of.size()));
    for (uint32_t v = points.first[point]; v < points.first[point + 1]; v++) old_of.push_back(v);
  }
  out.first_of_point.push_back(static_cast<uint32_t>(old_of.size()));

  std::vector<uint32_t> number(old_of.size());
  for (uint32_t i = 0; i < old_of.size(); i++) number[old_of[i]] = i;
  out.mesh = permuted(quantized, old_of);
  for (const uint32_t v : old_of) out.parent.push_back(number[order.parent[v]]);
  order_faces(quantized, order, number, out);
  return out;
}

}  // namespace lightwell
