// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <bit>
#include <utility>

#include "lightwell/base/model_coder.h"
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
  /// Whether the current point splits (again).
  template <typename Coder>
  bool splits(Coder& coder, uint32_t fan_size, bool again, bool value) {
    return coder.bit(splits_[again][std::min<size_t>(fan_size, 15)], value);
  }
  /// Whether one more vertex comes with the new point; `parents` is the number of vertices of its parent point.
  template <typename Coder>
  bool one_more(Coder& coder, uint32_t parents, bool value) {
    return coder.bit(one_more_[parents > 1], value);
  }
  /// The index of an existing vertex.
  template <typename Coder>
  uint32_t vertex(Coder& coder, const Refinement& mesh, uint32_t value) {
    return coder.raw(value, std::bit_width(mesh.vertices()));
  }
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
  // The new vertex's neighbours: their mean, half their mean squared distance from the parent, and their (scaled) area
  // normal.
  struct Surroundings {
    Vec<int64_t, 3> mean;
    int64_t spread = 0;
    Vec<int64_t, 3> normal;
  };

  template <typename Coder>
  void moves(Coder& coder, NewVertex& v);
  template <typename Coder>
  bool faces(Coder& coder, const Refinement& mesh, NewVertex& v);
  template <typename Coder>
  void implied_faces(Coder& coder, NewVertex& v);
  template <typename Coder>
  bool explicit_faces(Coder& coder, const Refinement& mesh, NewVertex& v);
  template <typename Coder>
  bool position(Coder& coder, const Refinement& mesh, const Surroundings& around, NewVertex& v);
  template <typename Coder>
  bool normal(Coder& coder, const Refinement& mesh, NewVertex& v);
  template <typename Coder>
  bool texcoord(Coder& coder, const Refinement& mesh, int set, NewVertex& v);
  template <typename Coder>
  void color(Coder& coder, const Refinement& mesh, NewVertex& v);

  void gather_ring(const NewVertex& v);
  bool are_implied(const NewVertex& v) const;
  static Surroundings surroundings(const Refinement& mesh, const NewVertex& v);

  AdaptiveNatural count_, parent_in_point_, explicit_count_;
  std::array<std::array<AdaptiveBit, 16>, 2> splits_;
  std::array<AdaptiveBit, 2> one_more_;
  std::array<std::array<std::array<std::array<AdaptiveBit, 2>, 4>, 4>, 16> moves_;
  AdaptiveBit explicit_;
  std::array<std::array<AdaptiveBit, 3>, 3> has_face_, turned_;
  std::array<AdaptiveInteger, 54> tangential_, along_normal_;
  std::array<AdaptiveInteger, 12> normal_;
  std::array<AdaptiveInteger, 24> texcoord_;
  AdaptiveInteger color_;
  uint32_t recent_normal_error_ = 16;

  std::vector<RingVertex> ring_;
  std::vector<NewFace> coded_;
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
  moves(coder, v);
  if (!faces(coder, mesh, v)) return false;
  if (begins_point && !position(coder, mesh, surroundings(mesh, v), v)) return false;
  if (mesh.layout().has_normals && !normal(coder, mesh, v)) return false;
  for (int set = 0; set < 2; set++)
    if (mesh.layout().has_texcoords[static_cast<size_t>(set)] && !texcoord(coder, mesh, set, v)) return false;
  if (mesh.layout().has_colors) color(coder, mesh, v);
  return true;
}

// The moving faces are mostly one run of the fan: the model sees the fan's size, how often moving has begun or ended,
// and the length of the current run.
template <typename Coder>
void SplitCoder::moves(Coder& coder, NewVertex& v) {
  size_t changes = 0, run = 0;
  bool last = false;
  for (uint8_t& move : v.moves) {
    const bool now = coder.bit(moves_[std::min<size_t>(v.fan.size(), 15)][changes][run][last], move != 0);
    run = now == last ? std::min<size_t>(run + 1, 3) : 0;
    if (now != last) changes = std::min<size_t>(changes + 1, 3);
    last = now;
    move = now;
  }
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
    const uint32_t source = exists ? known->source : 0;
    coded_.push_back(turned != x.before_parent ? NewFace{x.vertex, v.parent, source}
                                               : NewFace{v.parent, x.vertex, source});
  }
  std::swap(v.faces, coded_);
}

template <typename Coder>
bool SplitCoder::explicit_faces(Coder& coder, const Refinement& mesh, NewVertex& v) {
  const uint32_t count = coder.natural(explicit_count_, static_cast<uint32_t>(v.faces.size()));
  if (count > max_fan) return false;
  v.faces.resize(count);
  for (NewFace& face : v.faces) {
    face.a = vertex(coder, mesh, face.a);
    face.b = vertex(coder, mesh, face.b);
    if (face.a >= mesh.vertices() || face.b >= mesh.vertices()) return false;
  }
  return true;
}

// The position is predicted from the new vertex's neighbours. The residual is coded along two axes across the surface
// and, on the third, as the height over the plane of the neighbours: a shear, hence exact in integers.
template <typename Coder>
bool SplitCoder::position(Coder& coder, const Refinement& mesh, const Surroundings& around, NewVertex& v) {
  const Vec3i parent = mesh.position(v.parent);
  const auto scale = static_cast<size_t>(std::bit_width(static_cast<uint64_t>(around.spread)));
  int up = 0;
  for (int i = 1; i < 3; i++)
    if (std::abs(around.normal[i]) > std::abs(around.normal[up])) up = i;
  int64_t height = 0;  // of the plane at the residual, times -normal[up]
  for (int i = 1; i <= 3; i++) {
    const int axis = (up + i) % 3;
    int64_t predicted = around.mean[axis] + (parent[axis] - around.mean[axis]) / 4;
    if (axis == up && around.normal[up] != 0) predicted -= height / around.normal[up];
    AdaptiveInteger& model = axis == up ? along_normal_[scale] : tangential_[scale];
    const int64_t residual = coder.integer(model, static_cast<int32_t>(v.position[axis] - predicted));
    if (std::abs(predicted + residual) > Lattice::limit) return false;
    v.position[axis] = static_cast<int>(predicted + residual);
    height += around.normal[axis] * residual;
  }
  return true;
}

// The normal is predicted from the vertex's faces; the model depends on how good recent predictions were.
template <typename Coder>
bool SplitCoder::normal(Coder& coder, const Refinement& mesh, NewVertex& v) {
  Vec<int64_t, 3> area;
  for_each_face(v, [&](uint32_t a, uint32_t b) {
    area += cross((mesh.position(a) - v.position).cast<int64_t>(), (mesh.position(b) - v.position).cast<int64_t>());
  });
  const NormalCode predicted = normal_code(area);
  AdaptiveInteger& model = normal_[std::min<size_t>(std::bit_width(recent_normal_error_), normal_.size() - 1)];
  const int64_t du = coder.integer(model, v.normal.u - predicted.u),
                dv = coder.integer(model, v.normal.v - predicted.v);
  if (std::abs(predicted.u + du) > 511 || std::abs(predicted.v + dv) > 511) return false;
  v.normal = {static_cast<int16_t>(predicted.u + du), static_cast<int16_t>(predicted.v + dv)};
  recent_normal_error_ = (recent_normal_error_ * 7 + static_cast<uint32_t>(std::abs(du) + std::abs(dv)) * 4) / 8;
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
      auto known = std::find_if(ring_.begin(), ring_.end(), [&](const RingVertex& r) { return r.vertex == x; });
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
  Vec<int64_t, 3> sum;
  int64_t count = 0;
  for_each_face(v, [&](uint32_t a, uint32_t b) {
    const Vec<int64_t, 3> p = mesh.position(a).cast<int64_t>() - parent, q = mesh.position(b).cast<int64_t>() - parent;
    sum += p + q;
    around.spread += dot(p, p) / 2 + dot(q, q) / 2;
    around.normal += cross(p, q);
    count += 2;
  });
  if (count == 0) return {parent, 0, {}};
  around.mean = parent + sum / count;
  around.spread /= count;
  uint64_t largest = 0;
  for (int i = 0; i < 3; i++) largest = std::max(largest, static_cast<uint64_t>(std::abs(around.normal[i])));
  const int excess =
      std::max(0, static_cast<int>(std::bit_width(largest)) - 34);  // so that products with residuals fit 64 bits
  around.normal = around.normal / (int64_t(1) << excess);
  return around;
}

}  // namespace lightwell
