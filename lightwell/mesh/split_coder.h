// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <bit>
#include <utility>

#include "lightwell/base/model_coder.h"
#include "lightwell/mesh/fan_coder.h"
#include "lightwell/mesh/refinement.h"

namespace lightwell {

/// Codes what a vertex split adds, predicted from a Refinement that encoder and decoder both have. The split is that of
/// Hoppe's progressive meshes ("Progressive Meshes", SIGGRAPH 1996, section 3.1); models keep learning from block to
/// block. `coder` is a ModelWriter or a ModelReader (base/model_coder.h).
class SplitCoder {
 public:
  template <typename Coder>
  uint32_t count(Coder& coder, uint32_t value) {
    return coder.natural(count_, value);
  }
  /// A pass over the vertices present begins: none has new neighbours yet.
  void begin_pass(const Refinement& mesh) { new_neighbours_.assign(mesh.vertices(), 0); }
  /// Whether the point of this first vertex splits (again). It does so the less the more its neighbours have split
  /// before it in this pass.
  template <typename Coder>
  bool splits(Coder& coder, const Refinement& mesh, uint32_t vertex, bool again, bool value) {
    return coder.bit(splits_[again][std::min<size_t>(mesh.fan_size(vertex), 11)][new_neighbours_[vertex]], value);
  }
  /// The vertex is there: its neighbours have a new one.
  void note(const NewVertex& v);
  /// Whether one more vertex comes with the new point; `parents` is the number of vertices of its parent point.
  template <typename Coder>
  bool one_more(Coder& coder, uint32_t parents, bool value) {
    return coder.bit(one_more_[parents > 1], value);
  }
  /// A face of existing vertices that takes no part in the refinement: mostly one with two corners at one place.
  template <typename Coder>
  bool loose_face(Coder& coder, const Refinement& mesh, Face& face, uint16_t& region);
  /// A new vertex whose parent is one of `parent_point`. Its position is coded if it begins a point, otherwise given in
  /// v. False if no encoder writes such a stream.
  template <typename Coder>
  bool new_vertex(Coder& coder, const Refinement& mesh, uint32_t parent_point, bool begins_point, NewVertex& v);

 private:
  // A neighbour of the parent, and how many of their common faces move or stay (at most 2 are counted).
  struct RingVertex {
    uint32_t vertex = 0;
    uint8_t moving = 0, staying = 0;
    bool before_parent = false;  // in the new face between moving and staying ones
  };
  // The new vertex's neighbours: their mean, that of those which are its parent's too, half their mean squared distance
  // from the parent, and their (scaled) area normal.
  struct Surroundings {
    Vec<int64_t, 3> mean, shared;
    int64_t spread = 0;
    Vec<int64_t, 3> normal;
  };

  template <typename Coder>
  bool faces(Coder& coder, const Refinement& mesh, NewVertex& v);
  template <typename Coder>
  void implied_faces(Coder& coder, NewVertex& v);
  template <typename Coder>
  bool vertex(Coder& coder, const Refinement& mesh, AdaptiveNatural& model, uint32_t& value);
  template <typename Coder>
  bool explicit_faces(Coder& coder, const Refinement& mesh, NewVertex& v);
  template <typename Coder>
  bool regions(Coder& coder, const Refinement& mesh, NewVertex& v);
  template <typename Coder>
  bool region(Coder& coder, const Refinement& mesh, uint16_t likely, uint16_t& value);
  template <typename Coder>
  bool position(Coder& coder, const Refinement& mesh, const Surroundings& around, NewVertex& v);
  template <typename Coder>
  bool texcoord(Coder& coder, const Refinement& mesh, int set, NewVertex& v);
  template <typename Coder>
  void color(Coder& coder, const Refinement& mesh, NewVertex& v);

  void gather_ring(const NewVertex& v);
  bool are_implied(const NewVertex& v) const;
  static uint8_t shift_of(const Refinement& mesh, const NewVertex& v);
  static Surroundings surroundings(const Refinement& mesh, const NewVertex& v);

  AdaptiveNatural count_, parent_in_point_, explicit_count_, explicit_corner_, loose_first_, loose_corner_, region_;
  std::array<std::array<std::array<AdaptiveBit, 4>, 12>, 2> splits_;
  std::array<AdaptiveBit, 2> one_more_;
  FanCoder fan_;
  AdaptiveBit explicit_, on_lattice_, in_likely_region_;
  std::array<std::array<AdaptiveBit, 3>, 3> has_face_, turned_;
  std::array<AdaptiveInteger, 54> tangential_, along_normal_;
  std::array<AdaptiveInteger, 24> texcoord_;
  AdaptiveInteger color_;

  std::vector<uint8_t> new_neighbours_;  // of each vertex in this pass, at most 3
  std::vector<RingVertex> ring_;
  std::vector<NewFace> coded_;
  std::vector<Spoke> loose_fan_;
  std::vector<uint32_t> near_;  // vertices that corners are probably among
  uint32_t last_loose_ = 0;
  uint16_t last_region_ = 0;
};

// Calls use(a, b) for the other two corners of each face that the new vertex will have.
template <typename Use>
void for_each_face(const NewVertex& v, Use use) {
  for (size_t i = 0; i < v.fan.size(); i++)
    if (v.moves[i]) use(v.fan[i].a, v.fan[i].b);
  for (const NewFace& face : v.faces) use(face.a, face.b);
}

template <typename Coder>
bool SplitCoder::new_vertex(Coder& coder, const Refinement& mesh, uint32_t parent_point, bool begins_point,
                            NewVertex& v) {
  const uint32_t first = mesh.first_of_point(parent_point), parents = mesh.first_of_point(parent_point + 1) - first;
  const uint32_t place = parents > 1 ? coder.natural(parent_in_point_, v.parent - first) : 0;
  if (place >= parents) return false;
  v.parent = first + place;
  if (mesh.fan_size(v.parent) > max_fan) return false;
  mesh.gather_fan(v.parent, v.fan);
  if (!Coder::writes) v.moves.resize(v.fan.size());
  if (!fan_.moves(coder, mesh, v)) return false;
  if (!faces(coder, mesh, v)) return false;
  if (!mesh.layout().regions.empty() && !regions(coder, mesh, v)) return false;
  const Surroundings around = surroundings(mesh, v);
  if (begins_point && !position(coder, mesh, around, v)) return false;
  // The area normal of a closed ring does not depend on where in it the vertex is.
  if (mesh.layout().has_normals) v.normal = normal_code(around.normal);
  for (int set = 0; set < 2; set++)
    if (mesh.layout().has_texcoords[static_cast<size_t>(set)] && !texcoord(coder, mesh, set, v)) return false;
  if (mesh.layout().has_colors) color(coder, mesh, v);
  return true;
}

inline void SplitCoder::note(const NewVertex& v) {
  for_each_face(v, [&](uint32_t a, uint32_t b) {
    for (const uint32_t x : {a, b})
      if (x != v.parent && x < new_neighbours_.size() && new_neighbours_[x] < 3) new_neighbours_[x]++;
  });
}

// New faces are mostly where a moving face parts from a staying one: they join the new vertex, the parent and the
// neighbour at which those two met. If there are any others, all are listed.
template <typename Coder>
bool SplitCoder::faces(Coder& coder, const Refinement& mesh, NewVertex& v) {
  gather_ring(v);
  if (coder.bit(explicit_, Coder::writes && !are_implied(v))) return explicit_faces(coder, mesh, v);
  implied_faces(coder, v);
  return true;
}

template <typename Coder>
void SplitCoder::implied_faces(Coder& coder, NewVertex& v) {
  coded_.clear();
  for (const RingVertex& x : ring_) {
    const auto known = std::find_if(v.faces.begin(), v.faces.end(),
                                    [&](const NewFace& f) { return f.a == x.vertex || f.b == x.vertex; });
    const bool exists = Coder::writes && known != v.faces.end();
    if (!coder.bit(has_face_[x.moving][x.staying], exists)) continue;
    const bool turned = coder.bit(turned_[x.moving][x.staying], exists && (known->a == x.vertex) != x.before_parent);
    NewFace face = exists ? *known : NewFace{};
    face.a = turned != x.before_parent ? x.vertex : v.parent;
    face.b = turned != x.before_parent ? v.parent : x.vertex;
    coded_.push_back(face);
  }
  std::swap(v.faces, coded_);
}

// The index of an existing vertex: its place among those near, counted from 1, or 0 and the index itself.
template <typename Coder>
bool SplitCoder::vertex(Coder& coder, const Refinement& mesh, AdaptiveNatural& model, uint32_t& value) {
  const auto known = Coder::writes ? std::ranges::find(near_, value) : near_.end();
  const uint32_t place =
      coder.natural(model, known == near_.end() ? 0 : static_cast<uint32_t>(known - near_.begin()) + 1);
  if (place > near_.size()) return false;
  value = place > 0 ? near_[place - 1] : coder.raw(value, std::bit_width(mesh.vertices()));
  return value < mesh.vertices();
}

template <typename Coder>
bool SplitCoder::explicit_faces(Coder& coder, const Refinement& mesh, NewVertex& v) {
  const uint32_t count = coder.natural(explicit_count_, static_cast<uint32_t>(v.faces.size()));
  if (count > max_fan) return false;
  v.faces.resize(count);
  near_.assign(1, v.parent);
  for (const RingVertex& x : ring_) near_.push_back(x.vertex);
  for (NewFace& face : v.faces)
    for (uint32_t* corner : {&face.a, &face.b})
      if (!vertex(coder, mesh, explicit_corner_, *corner)) return false;
  return true;
}

// The region of a face is mostly that of one beside.
template <typename Coder>
bool SplitCoder::region(Coder& coder, const Refinement& mesh, uint16_t likely, uint16_t& value) {
  const uint32_t found = coder.bit(in_likely_region_, value == likely) ? likely : coder.natural(region_, value);
  value = last_region_ = static_cast<uint16_t>(found);
  return found < mesh.layout().regions.size();
}

// Beside a new face is the first face of the fan that has a corner besides the parent in common with it.
template <typename Coder>
bool SplitCoder::regions(Coder& coder, const Refinement& mesh, NewVertex& v) {
  for (NewFace& face : v.faces) {
    const auto beside = std::ranges::find_if(v.fan, [&](const Spoke& spoke) {
      return (face.a != v.parent && spoke.has(face.a)) || (face.b != v.parent && spoke.has(face.b));
    });
    const uint16_t likely = beside == v.fan.end() ? last_region_ : mesh.region_of(beside->corner);
    if (!region(coder, mesh, likely, face.region)) return false;
  }
  return true;
}

// How coarse the lattice is on which all the vertex's faces lie. Faces of regions of different lattices hardly ever
// meet.
inline uint8_t SplitCoder::shift_of(const Refinement& mesh, const NewVertex& v) {
  const std::vector<RegionLayout>& regions = mesh.layout().regions;
  if (regions.empty()) return 0;
  uint8_t shift = MeshLayout::most_shift + 1;
  for (size_t i = 0; i < v.fan.size(); i++)
    if (v.moves[i]) shift = std::min(shift, regions[mesh.region_of(v.fan[i].corner)].shift);
  for (const NewFace& face : v.faces) shift = std::min(shift, regions[face.region].shift);
  return shift > MeshLayout::most_shift ? uint8_t(0) : shift;
}

// Loose faces come by their first corner, which is no later than the others.
template <typename Coder>
bool SplitCoder::loose_face(Coder& coder, const Refinement& mesh, Face& face, uint16_t& region_of_face) {
  const uint32_t step = coder.natural(loose_first_, face[0] - last_loose_);
  if (step >= mesh.vertices() - last_loose_) return false;
  face[0] = last_loose_ += step;
  near_.assign(1, face[0]);
  if (mesh.fan_size(face[0]) <= max_fan) {
    mesh.gather_fan(face[0], loose_fan_);
    for (const Spoke& spoke : loose_fan_)
      for (const uint32_t x : {spoke.a, spoke.b})
        if (std::ranges::find(near_, x) == near_.end()) near_.push_back(x);
  }
  if (!vertex(coder, mesh, loose_corner_, face[1])) return false;
  near_[0] = face[1];
  if (!vertex(coder, mesh, loose_corner_, face[2])) return false;
  return mesh.layout().regions.empty() || region(coder, mesh, last_region_, region_of_face);
}

// The position is predicted from the new vertex's neighbours: their mean, drawn towards the parent and away from the
// neighbours that both have, by shares that regression found on scans of all kinds. The residual is coded along two
// axes across the surface and, on the third, as the height over the plane of the neighbours: a shear, hence exact in
// integers. Where the faces lie on a coarser lattice, in steps of that.
template <typename Coder>
bool SplitCoder::position(Coder& coder, const Refinement& mesh, const Surroundings& around, NewVertex& v) {
  const Vec3i parent = mesh.position(v.parent);
  int shift = shift_of(mesh, v);
  if (shift > 0) {
    const int below = (1 << shift) - 1;
    if (!coder.bit(on_lattice_, ((v.position[0] | v.position[1] | v.position[2]) & below) == 0)) shift = 0;
  }
  const auto scale = static_cast<size_t>(std::bit_width(static_cast<uint64_t>(around.spread) >> (2 * shift)));
  int up = 0;
  for (int i = 1; i < 3; i++)
    if (std::abs(around.normal[i]) > std::abs(around.normal[up])) up = i;
  int64_t height = 0;  // of the plane at the residual, times -normal[up]
  for (int i = 1; i <= 3; i++) {
    const int axis = (up + i) % 3;
    int64_t predicted = around.mean[axis] +
                        (8 * (parent[axis] - around.mean[axis]) - 3 * (around.shared[axis] - around.mean[axis])) / 32;
    if (axis == up && around.normal[up] != 0) predicted -= height / around.normal[up];
    AdaptiveInteger& model = axis == up ? along_normal_[scale] : tangential_[scale];
    const int64_t half_step = (int64_t(1) << shift) / 2, nearest = (predicted + half_step) >> shift;
    const int64_t value = nearest + coder.integer(model, static_cast<int32_t>((v.position[axis] >> shift) - nearest));
    if (std::abs(value) > Lattice::limit >> shift) return false;
    v.position[axis] = static_cast<int>(value * (int64_t(1) << shift));
    height += around.normal[axis] * (v.position[axis] - predicted);
  }
  return true;
}

template <typename Coder>
bool SplitCoder::texcoord(Coder& coder, const Refinement& mesh, int set, NewVertex& v) {
  Vec<int64_t, 2> sum;
  int64_t count = 0;
  for_each_face(v, [&](uint32_t a, uint32_t b) {
    sum += mesh.texcoord(set, a).cast<int64_t>() + mesh.texcoord(set, b).cast<int64_t>();
    count += 2;
  });
  const Vec<int, 2> parent = mesh.texcoord(set, v.parent);
  for (int i = 0; i < 2; i++) {
    const int64_t mean = count > 0 ? sum[i] / count : parent[i];
    const auto scale = static_cast<size_t>(std::bit_width(static_cast<uint64_t>(std::abs(parent[i] - mean))));
    int& value = v.texcoords[static_cast<size_t>(set)][i];
    const int64_t predicted = mean + (parent[i] - mean) / 4;
    const int64_t found = predicted + coder.integer(texcoord_[std::min(scale, texcoord_.size() - 1)],
                                                    static_cast<int32_t>(value - predicted));
    if (std::abs(found) > Lattice::limit) return false;
    value = static_cast<int>(found);
  }
  return true;
}

template <typename Coder>
void SplitCoder::color(Coder& coder, const Refinement& mesh, NewVertex& v) {
  Vec<int, 4> sum;
  int count = 0;
  const auto add = [&](uint32_t vertex) {
    const ColorCode codes = mesh.color(vertex);
    for (int i = 0; i < 4; i++) sum[i] += codes[static_cast<size_t>(i)];
    count++;
  };
  add(v.parent);
  for_each_face(v, [&](uint32_t a, uint32_t b) {
    add(a);
    add(b);
  });
  for (int i = 0; i < 4; i++) {
    uint8_t& value = v.color[static_cast<size_t>(i)];
    const int predicted = sum[i] / count;
    value = static_cast<uint8_t>(static_cast<uint32_t>(coder.integer(color_, value - predicted)) +
                                 static_cast<uint32_t>(predicted));
  }
}

inline void SplitCoder::gather_ring(const NewVertex& v) {
  ring_.clear();
  for (size_t i = 0; i < v.fan.size(); i++)
    for (const uint32_t x : {v.fan[i].a, v.fan[i].b}) {
      // Mostly the last one, else the first.
      const auto is_x = [&](const RingVertex& r) { return r.vertex == x; };
      auto known = !ring_.empty() && is_x(ring_.back()) ? ring_.end() - 1 : std::ranges::find_if(ring_, is_x);
      if (known == ring_.end()) known = ring_.insert(ring_.end(), {x, 0, 0, false});
      uint8_t& count = v.moves[i] ? known->moving : known->staying;
      // A new face continues the order of the moving face or, without one, of the staying face across the gap.
      if (v.moves[i] ? known->moving == 0 : known->moving + known->staying == 0)
        known->before_parent = (v.moves[i] != 0) == (x == v.fan[i].b);
      count = static_cast<uint8_t>(std::min(count + 1, 2));
    }
}

// Whether implied_faces can code the new faces: each has the parent and one of its neighbours, and no neighbour occurs
// twice.
inline bool SplitCoder::are_implied(const NewVertex& v) const {
  for (size_t i = 0; i < v.faces.size(); i++) {
    const NewFace& face = v.faces[i];
    if ((face.a == v.parent) == (face.b == v.parent)) return false;
    const uint32_t x = face.a == v.parent ? face.b : face.a;
    if (std::none_of(ring_.begin(), ring_.end(), [&](const RingVertex& r) { return r.vertex == x; })) return false;
    for (size_t j = 0; j < i; j++)
      if (v.faces[j].a == x || v.faces[j].b == x) return false;
  }
  return true;
}

inline SplitCoder::Surroundings SplitCoder::surroundings(const Refinement& mesh, const NewVertex& v) {
  Surroundings around;
  const Vec<int64_t, 3> parent = mesh.position(v.parent).cast<int64_t>();
  Vec<int64_t, 3> sum, sum_of_shared;
  int64_t count = 0, shared = 0;
  for_each_face(v, [&](uint32_t a, uint32_t b) {
    const Vec<int64_t, 3> p = mesh.position(a).cast<int64_t>() - parent, q = mesh.position(b).cast<int64_t>() - parent;
    sum += p + q;
    around.spread += dot(p, p) / 2 + dot(q, q) / 2;
    around.normal += cross(p, q);
    count += 2;
    if ((a == v.parent) == (b == v.parent)) return;
    sum_of_shared += p + q;  // the parent's own is zero
    shared++;
  });
  if (count == 0) return {parent, parent, 0, {}};
  around.mean = parent + sum / count;
  around.shared = shared > 0 ? parent + sum_of_shared / shared : around.mean;
  around.spread /= count;
  uint64_t largest = 0;
  for (int i = 0; i < 3; i++) largest = std::max(largest, static_cast<uint64_t>(std::abs(around.normal[i])));
  const int excess =
      std::max(0, static_cast<int>(std::bit_width(largest)) - 34);  // so that products with residuals fit 64 bits
  around.normal = around.normal / (int64_t(1) << excess);
  return around;
}

}  // namespace lightwell
