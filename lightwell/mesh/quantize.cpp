// SPDX-License-Identifier: Apache-2.0
#include "lightwell/mesh/quantize.h"

#include <algorithm>
#include <tuple>

#include "lightwell/base/assert.h"
#include "lightwell/mesh/stream.h"

namespace lightwell {
namespace {

constexpr float largest_coordinate = 1e37f;
constexpr int least_bits = 6, default_bits = 14, most_bits = 21;
constexpr int texcoord_exponent = -14;  // a quarter texel of a texture of 4096 texels a side

// Longest side and largest magnitude of some values.
struct Extent {
  double side = 0, magnitude = 0;
};

template <int N>
Extent extent_of(const std::vector<Vec<float, N>>& values, const std::vector<bool>& used) {
  Vec<double, N> lo = Vec<double, N>::filled(std::numeric_limits<double>::infinity()), hi = -lo;
  for (size_t v = 0; v < values.size(); v++)
    if (used[v] && is_finite(values[v])) {
      lo = min(lo, values[v].template cast<double>());
      hi = max(hi, values[v].template cast<double>());
    }
  if (lo[0] > hi[0]) return {};
  return {max_component(hi - lo), std::max(max_component(hi), max_component(-lo))};
}

// The lattice with the exponent nearest to the wanted one on which the extent has at most 21 bits and every value is an
// exact float.
Lattice lattice_for(int wanted, const Extent& extent) {
  int exponent = wanted;
  if (extent.side > 0) exponent = std::max(exponent, std::ilogb(extent.side) - (most_bits - 1));
  if (extent.magnitude > 0)
    exponent = std::max(exponent, std::ilogb(extent.magnitude) + 1 - std::ilogb(Lattice::limit));
  return {static_cast<int8_t>(std::clamp(exponent, Lattice::min_exponent, Lattice::max_exponent))};
}

// Of the finest step of which a side has no more than the codes of 14 bits.
int default_exponent(double side) { return std::ilogb(side / ((1 << default_bits) - 1)) + 1; }

Lattice position_lattice(const Extent& extent, float position_error) {
  if (!(extent.side > 0)) return lattice_for(Lattice::min_exponent, extent);
  if (position_error > 0)
    return lattice_for(std::ilogb(std::min(2.0 * position_error, extent.side / (1 << least_bits))), extent);
  return lattice_for(default_exponent(extent.side), extent);
}

// The lattice of the finest region, and how much coarser those of the others are.
void add_region_lattices(QuantizedMesh& mesh, const Extent& extent, const QuantizeOptions& options) {
  std::vector<Lattice> lattices;
  for (const float error : options.region_errors) lattices.push_back(position_lattice(extent, error));
  mesh.position_lattice = *std::ranges::min_element(lattices, {}, &Lattice::exponent);
  for (const Lattice& lattice : lattices)
    mesh.region_shifts.push_back(
        static_cast<uint8_t>(std::min<int>(lattice.exponent - mesh.position_lattice.exponent, MeshLayout::most_shift)));
}

// Of each vertex how much coarser than the finest lattice its own is. At places where regions touch, all have that of
// the coarsest, so that they touch afterwards; but not so coarse that it would fold the finest's faces.
std::vector<uint8_t> vertex_shifts(const Mesh& mesh, const QuantizeOptions& options, const std::vector<bool>& used,
                                   const std::vector<uint8_t>& region_shifts) {
  std::vector<uint8_t> shifts(mesh.positions.size());
  if (options.regions.empty()) return shifts;
  std::vector<uint32_t> sorted;
  for (uint32_t v = 0; v < shifts.size(); v++)
    if (used[v]) sorted.push_back(v);
  std::ranges::sort(sorted, {}, [&](uint32_t v) { return mesh.positions[v]; });
  for (size_t first = 0, end = 0; first < sorted.size(); first = end) {
    uint8_t finest = MeshLayout::most_shift, coarsest = 0;
    for (; end < sorted.size() && mesh.positions[sorted[end]] == mesh.positions[sorted[first]]; end++) {
      const uint8_t shift = region_shifts[options.regions[sorted[end]]];
      finest = std::min(finest, shift);
      coarsest = std::max(coarsest, shift);
    }
    const auto shift = std::min<uint8_t>(coarsest, finest + MeshLayout::most_shift_between);
    for (size_t i = first; i < end; i++) shifts[sorted[i]] = shift;
  }
  return shifts;
}

// The multiple of 2^shift nearest to a value.
int32_t code_on(const Lattice& lattice, uint8_t shift, float value) {
  const Lattice coarser{static_cast<int8_t>(lattice.exponent + shift)};
  return coarser.code(value) * (1 << shift);
}

// The lowest 21 bits of x with two zeros between neighbours.
uint64_t spread(uint32_t x) {
  uint64_t s = x & 0x1fffff;
  s = (s | s << 32) & 0x1f00000000ffff;
  s = (s | s << 16) & 0x1f0000ff0000ff;
  s = (s | s << 8) & 0x100f00f00f00f00f;
  s = (s | s << 4) & 0x10c30c30c30c30c3;
  return (s | s << 2) & 0x1249249249249249;
}

// A vertex in integers; equal tuples are one vertex. Sorted by place along the Morton curve first.
struct Tuple {
  uint64_t morton = 0;
  Vec3i position;
  NormalCode normal;
  std::array<Vec<int, 2>, 2> texcoords;
  ColorCode color{};
  uint32_t row = 0;
  uint16_t region = 0;  // where regions stay apart
  uint32_t source = 0;

  auto key() const { return std::tie(morton, position, normal, texcoords, color, row, region); }
};

std::vector<Tuple> tuples_of(const Mesh& mesh, const QuantizeOptions& options, const std::vector<bool>& used,
                             const QuantizedMesh& lattices) {
  const std::vector<uint8_t> shifts = vertex_shifts(mesh, options, used, lattices.region_shifts);
  const bool textured = !mesh.texcoords[0].empty() || !mesh.texcoords[1].empty() || !mesh.colors.empty();
  std::vector<Tuple> tuples;
  Vec3i lowest = Vec3i::filled(Lattice::limit);
  for (size_t v = 0; v < mesh.positions.size(); v++) {
    if (!used[v]) continue;
    Tuple t;
    for (int i = 0; i < 3; i++) t.position[i] = code_on(lattices.position_lattice, shifts[v], mesh.positions[v][i]);
    if (!mesh.normals.empty()) t.normal = normal_code(mesh.normals[v]);
    for (size_t set = 0; set < 2; set++)
      if (!mesh.texcoords[set].empty())
        for (int i = 0; i < 2; i++)
          t.texcoords[set][i] = lattices.texcoord_lattices[set].code(mesh.texcoords[set][v][i]);
    if (!mesh.colors.empty()) t.color = color_code(mesh.colors[v]);
    if (!options.rows.empty()) t.row = options.rows[v];
    if (!options.regions.empty() && textured) t.region = options.regions[v];
    t.source = static_cast<uint32_t>(v);
    lowest = min(lowest, t.position);
    tuples.push_back(t);
  }
  for (Tuple& t : tuples) {
    const Vec3i p = t.position - lowest;
    for (int i = 0; i < 3; i++) t.morton |= spread(static_cast<uint32_t>(p[i])) << i;
  }
  return tuples;
}

void append(QuantizedMesh& out, const Tuple& t, const Mesh& mesh, bool has_rows) {
  out.positions.push_back(t.position);
  if (!mesh.normals.empty()) out.normals.push_back(t.normal);
  for (size_t set = 0; set < 2; set++)
    if (!mesh.texcoords[set].empty()) out.texcoords[set].push_back(t.texcoords[set]);
  if (!mesh.colors.empty()) out.colors.push_back(t.color);
  if (has_rows) out.rows.push_back(t.row);
}

}  // namespace

float usual_position_error(float side) {
  return side > 0 && std::isfinite(side) ? std::ldexp(0.5f, default_exponent(side)) : 0;
}

Result<QuantizedMesh> quantize(const Mesh& mesh, const QuantizeOptions& options) {
  std::vector<bool> used(mesh.positions.size());
  for (const Face& face : mesh.faces)
    for (const uint32_t v : face) {
      LW_ASSERT(v < used.size());
      used[v] = true;
    }
  for (size_t v = 0; v < used.size(); v++)
    for (int i = 0; i < 3; i++)
      if (used[v] && !(std::abs(mesh.positions[v][i]) <= largest_coordinate))
        return fail("vertex " + std::to_string(v), "its position is not finite or beyond 1e37");

  QuantizedMesh out;
  const Extent extent = extent_of(mesh.positions, used);
  if (options.regions.empty())
    out.position_lattice = position_lattice(extent, options.position_error);
  else
    add_region_lattices(out, extent, options);
  for (size_t set = 0; set < 2; set++)
    if (!mesh.texcoords[set].empty())
      out.texcoord_lattices[set] = lattice_for(texcoord_exponent, extent_of(mesh.texcoords[set], used));

  std::vector<Tuple> tuples = tuples_of(mesh, options, used, out);
  std::sort(tuples.begin(), tuples.end(), [](const Tuple& a, const Tuple& b) { return a.key() < b.key(); });
  std::vector<uint32_t> vertex_of(used.size());
  for (size_t i = 0; i < tuples.size(); i++) {
    if (i == 0 || tuples[i - 1].key() != tuples[i].key()) append(out, tuples[i], mesh, !options.rows.empty());
    vertex_of[tuples[i].source] = static_cast<uint32_t>(out.positions.size() - 1);
  }
  out.faces.reserve(mesh.faces.size());
  for (const Face& f : mesh.faces) {
    out.faces.push_back({vertex_of[f[0]], vertex_of[f[1]], vertex_of[f[2]]});
    if (!options.regions.empty()) out.regions.push_back(options.regions[f[0]]);
  }
  return out;
}

Mesh dequantize(const QuantizedMesh& mesh) {
  Mesh out;
  out.faces = mesh.faces;
  for (const Vec3i& p : mesh.positions) {
    const Lattice& lattice = mesh.position_lattice;
    out.positions.push_back({{lattice.value(p[0]), lattice.value(p[1]), lattice.value(p[2])}});
  }
  for (const NormalCode n : mesh.normals) out.normals.push_back(normal_of(n));
  for (size_t set = 0; set < 2; set++)
    for (const Vec<int, 2>& t : mesh.texcoords[set]) {
      const Lattice& lattice = mesh.texcoord_lattices[set];
      out.texcoords[set].push_back({{lattice.value(t[0]), lattice.value(t[1])}});
    }
  for (const ColorCode& code : mesh.colors) out.colors.push_back(color_of(color_value(code)));
  return out;
}

}  // namespace lightwell
