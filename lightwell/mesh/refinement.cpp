// SPDX-License-Identifier: Apache-2.0
#include "lightwell/mesh/refinement.h"

#include <algorithm>

namespace lightwell {
namespace {

constexpr uint32_t no_corner = 0xffffffffu;
// Runs of changed indices closer to each other than this are one upload.
constexpr uint32_t mergeable_gap = 256;

Normal16 normal_value(NormalCode code) {
  const Vec3f n = normal_of(code);
  const auto channel = [&](int i) { return static_cast<int16_t>(std::floor(n[i] * 32767.0f + 0.5f)); };
  return {channel(0), channel(1), channel(2), 0};
}

// Orders the spokes so that each follows one whose face shares an edge with its own; an open fan begins at an end.
void chain(std::vector<Spoke>& fan) {
  const auto begins = [&](const Spoke& s) {
    return std::none_of(fan.begin(), fan.end(), [&](const Spoke& other) { return other.b == s.a; });
  };
  const auto end = std::find_if(fan.begin(), fan.end(), begins);
  if (end != fan.end()) std::swap(*fan.begin(), *end);
  for (size_t i = 1; i < fan.size(); i++) {
    const auto rest = fan.begin() + static_cast<ptrdiff_t>(i);
    const auto next = std::find_if(rest, fan.end(), [&](const Spoke& s) { return s.a == fan[i - 1].b; });
    if (next != fan.end()) std::swap(*rest, *next);
  }
}

bool fits(size_t count, bool present, uint32_t wanted) { return count == (present ? wanted : 0); }

// Room for twice as many elements as there are, but not for more than there will be.
size_t more_room(size_t present, size_t final) { return std::min(std::max<size_t>(2 * present, 1024), final); }

}  // namespace

Refinement::Refinement(MeshLayout&& layout)
    : layout_(std::move(layout)), steps_per_unit_(power_of_two(-layout_.positions.exponent)), regions_(1) {
  for (size_t i = 1; i < layout_.regions.size(); i++)
    regions_.push_back({regions_.back().first + 3 * layout_.regions[i - 1].faces});
}

uint16_t Refinement::region_of(uint32_t corner) const {
  size_t region = 0;
  for (size_t end = regions_.size(); end - region > 1;) {
    const size_t middle = (region + end) / 2;
    (regions_[middle].first <= corner ? region : end) = middle;
  }
  return static_cast<uint16_t>(region);
}

Result<Refinement> Refinement::open(MeshLayout layout, const MeshArrays& base) {
  const uint32_t count = layout.base_vertices;
  if (base.positions.size() != count || !fits(base.normals.size(), layout.has_normals, count) ||
      !fits(base.texcoords[0].size(), layout.has_texcoords[0], count) ||
      !fits(base.texcoords[1].size(), layout.has_texcoords[1], count) ||
      !fits(base.colors.size(), layout.has_colors, count))
    return fail("mesh stream", "the coarsest level's vertices are not those of the layout");
  if (base.indices.size() != size_t(3) * layout.base_faces)
    return fail("mesh stream", "the coarsest level's faces are not those of the layout");
  if (std::any_of(base.indices.begin(), base.indices.end(), [&](uint32_t v) { return v >= count; }))
    return fail("mesh stream", "an index of the coarsest level is out of range");
  Refinement mesh(std::move(layout));
  mesh.add_base(base);
  return mesh;
}

void Refinement::add_base(const MeshArrays& base) {
  NewVertex vertex;
  Vec3i last;
  for (uint32_t v = 0; v < layout_.base_vertices; v++) {
    for (int i = 0; i < 3; i++) vertex.position[i] = layout_.positions.code(base.positions[v][i]);
    for (size_t set = 0; set < 2; set++)
      if (layout_.has_texcoords[set])
        for (int i = 0; i < 2; i++) vertex.texcoords[set][i] = layout_.texcoords[set].code(base.texcoords[set][v][i]);
    if (layout_.has_colors) vertex.color = color_code(base.colors[v]);
    add(vertex, v == 0 || vertex.position != last);
    last = vertex.position;
  }
  uint16_t region = 0;
  uint32_t left = layout_.regions.empty() ? layout_.base_faces : layout_.regions[0].base_faces;
  for (size_t i = 0; i < base.indices.size(); i += 3) {
    for (; left == 0; left = layout_.regions[region].base_faces) region++;
    add_linked({base.indices[i], base.indices[i + 1], base.indices[i + 2]}, region);
    left--;
  }
  if (!layout_.has_normals) return;
  for (const Vec3f& normal : base.normals) set_next_normal(normal_code(normal));
  reported_normals_ = final_normals_;
}

void Refinement::gather_fan(uint32_t vertex, std::vector<Spoke>& fan) const {
  fan.clear();
  for (uint32_t corner = first_corner_[vertex]; corner != no_corner; corner = next_corner_[corner]) {
    const uint32_t place = corner % 3, face = corner - place;
    fan.push_back({index_buffer[face + (place + 1) % 3], index_buffer[face + (place + 2) % 3], corner});
  }
  chain(fan);
}

Vec<int, 2> Refinement::texcoord(int set, uint32_t vertex) const {
  const auto s = static_cast<size_t>(set);
  const Vec2f& t = texcoord_buffers[s][vertex];
  return {{layout_.texcoords[s].exact_code(t[0]), layout_.texcoords[s].exact_code(t[1])}};
}

ColorCode Refinement::color(uint32_t vertex) const { return color_code(color_buffer[vertex]); }

void Refinement::add(const NewVertex& vertex, bool begins_point) {
  const uint32_t v = vertices();
  if (v == position_buffer.capacity()) reserve_vertices(more_room(v, layout_.vertices));
  if (begins_point) first_of_point_.push_back(v);
  add_attributes(vertex);
  first_corner_.push_back(no_corner);
  fan_size_.push_back(0);

  // The parent's list is rebuilt from the corners that stay.
  if (!vertex.fan.empty()) {
    first_corner_[vertex.parent] = no_corner;
    fan_size_[vertex.parent] = 0;
  }
  for (size_t i = 0; i < vertex.fan.size(); i++) {
    const uint32_t corner = vertex.fan[i].corner;
    if (vertex.moves[i]) {
      index_buffer[corner] = v;
      const Region& region = regions_[region_of(corner)];
      if (corner < region.first + 3 * region.reported_faces) rewired_.push_back(corner);
    }
    link(corner);
  }
  for (const NewFace& face : vertex.faces) add_linked({v, face.a, face.b}, face.region);
}

// One way through the faces: following each vertex's list takes much longer (docs/decisions/038-mesh-stream.md).
std::vector<Vec<uint64_t, 3>> Refinement::area_normals() const {
  std::vector<Vec<uint64_t, 3>> sums(vertices());
  for (size_t region = 0; region < layout_.region_count(); region++) {
    const std::span<const uint32_t> corners = indices(region);
    for (size_t i = 0; i < corners.size(); i += 3) {
      const Vec3i p = position(corners[i]);
      const Vec<int64_t, 3> a = (position(corners[i + 1]) - p).cast<int64_t>(),
                            b = (position(corners[i + 2]) - p).cast<int64_t>();
      const auto area = cross(a, b).cast<uint64_t>();
      for (size_t k = 0; k < 3; k++) sums[corners[i + k]] += area;
    }
  }
  return sums;
}

void Refinement::set_next_normal(NormalCode normal) { normal_buffer[final_normals_++] = normal_value(normal); }

void Refinement::reserve_vertices(size_t count) {
  position_buffer.reserve(count);
  if (layout_.has_normals) normal_buffer.reserve(count);
  for (size_t set = 0; set < 2; set++)
    if (layout_.has_texcoords[set]) texcoord_buffers[set].reserve(count);
  if (layout_.has_colors) color_buffer.reserve(count);
  first_corner_.reserve(count);
  fan_size_.reserve(count);
}

void Refinement::reserve_faces(size_t count) {
  index_buffer.reserve(3 * count);
  const size_t linked = layout_.regions.empty() ? layout_.faces - layout_.loose_faces : layout_.faces;
  next_corner_.reserve(3 * std::min<size_t>(count, linked));
}

void Refinement::add_attributes(const NewVertex& vertex) {
  Vec3f& position = position_buffer.emplace_back();
  for (int i = 0; i < 3; i++) position[i] = layout_.positions.value(vertex.position[i]);
  if (layout_.has_normals) normal_buffer.push_back(normal_value(vertex.normal));
  for (size_t set = 0; set < 2; set++)
    if (layout_.has_texcoords[set]) {
      Vec2f& texcoord = texcoord_buffers[set].emplace_back();
      for (int i = 0; i < 2; i++) texcoord[i] = layout_.texcoords[set].value(vertex.texcoords[set][i]);
    }
  if (layout_.has_colors) color_buffer.push_back(color_value(vertex.color));
}

// Adds a face to the index buffer, and returns its place there.
uint32_t Refinement::add_indices(const Face& face, uint16_t region) {
  const uint32_t place = regions_[region].first + 3 * regions_[region].faces++;
  faces_++;
  if (place + 3 > index_buffer.capacity()) reserve_faces(more_room(place / 3 + 1, layout_.faces));
  if (place + 3 > index_buffer.size()) index_buffer.resize(place + 3);
  std::ranges::copy(face, index_buffer.begin() + place);
  return place;
}

void Refinement::add_linked(const Face& face, uint16_t region) {
  const uint32_t first = add_indices(face, region);
  next_corner_.resize(index_buffer.size(), no_corner);
  for (uint32_t k = 0; k < 3; k++) link(first + k);
}

void Refinement::link(uint32_t corner) {
  const uint32_t v = index_buffer[corner];
  next_corner_[corner] = std::exchange(first_corner_[v], corner);
  fan_size_[v]++;
}

void Refinement::add_loose(const Face& face, uint16_t region) { add_indices(face, region); }

MeshChanges Refinement::take_changes() {
  MeshChanges changes;
  changes.vertices = {reported_vertices_, vertices() - reported_vertices_};
  changes.normals = {reported_normals_, final_normals_ - reported_normals_};
  for (Region& region : regions_) {
    changes.indices.push_back({region.first + 3 * region.reported_faces, 3 * (region.faces - region.reported_faces)});
    region.reported_faces = region.faces;
  }
  // Heap sort is a quarter of std::sort's code, whose size counts in a web page.
  std::ranges::make_heap(rewired_);
  std::ranges::sort_heap(rewired_);
  for (const uint32_t corner : rewired_) {
    auto& ranges = changes.rewired;
    if (ranges.empty() || corner > ranges.back().first + ranges.back().count + mergeable_gap)
      ranges.push_back({corner, 1});
    else
      ranges.back().count = corner - ranges.back().first + 1;
  }
  rewired_.clear();
  reported_vertices_ = vertices();
  reported_normals_ = final_normals_;
  return changes;
}

}  // namespace lightwell
