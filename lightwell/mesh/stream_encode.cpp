// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <optional>

#include "lightwell/base/assert.h"
#include "lightwell/mesh/normal_coder.h"
#include "lightwell/mesh/progressive.h"
#include "lightwell/mesh/split_coder.h"
#include "lightwell/mesh/stream.h"
#include "lightwell/mesh/sweep.h"

namespace lightwell {
namespace {

// The first `count` values.
template <typename T>
std::vector<T> head(const std::vector<T>& values, size_t count) {
  return {values.begin(), values.begin() + static_cast<ptrdiff_t>(std::min(count, values.size()))};
}

QuantizedMesh base_of(const ProgressiveMesh& mesh) {
  QuantizedMesh base;
  const uint32_t vertices = mesh.base_vertices();
  base.position_lattice = mesh.mesh.position_lattice;
  base.texcoord_lattices = mesh.mesh.texcoord_lattices;
  base.positions = head(mesh.mesh.positions, vertices);
  base.normals = head(mesh.mesh.normals, vertices);
  for (size_t set = 0; set < 2; set++) base.texcoords[set] = head(mesh.mesh.texcoords[set], vertices);
  base.colors = head(mesh.mesh.colors, vertices);
  base.faces = head(mesh.mesh.faces, mesh.base_faces);
  base.regions = head(mesh.mesh.regions, mesh.base_faces);
  for (Face& face : base.faces)
    for (uint32_t& v : face) v = mesh.ancestor(v, vertices);
  return base;
}

MeshLayout layout_of(const ProgressiveMesh& mesh) {
  MeshLayout layout;
  layout.vertices = static_cast<uint32_t>(mesh.mesh.positions.size());
  layout.faces = static_cast<uint32_t>(mesh.mesh.faces.size());
  layout.base_vertices = mesh.base_vertices();
  layout.base_faces = mesh.base_faces;
  layout.loose_faces = mesh.loose_faces;
  layout.has_normals = !mesh.mesh.normals.empty();
  layout.has_colors = !mesh.mesh.colors.empty();
  for (size_t set = 0; set < 2; set++) layout.has_texcoords[set] = !mesh.mesh.texcoords[set].empty();
  layout.positions = mesh.mesh.position_lattice;
  layout.texcoords = mesh.mesh.texcoord_lattices;
  layout.base_error = mesh.passes.empty() ? 0 : mesh.passes[0].error;
  for (const uint8_t shift : mesh.mesh.region_shifts) layout.regions.push_back({.shift = shift});
  for (uint32_t f = 0; f < mesh.mesh.regions.size(); f++) {
    RegionLayout& region = layout.regions[mesh.mesh.regions[f]];
    region.faces++;
    region.base_faces += f < mesh.base_faces;
  }
  return layout;
}

Refinement open_base(const MeshLayout& layout, const Mesh& base, const QuantizedMesh& codes) {
  MeshArrays arrays;
  arrays.positions = base.positions;
  arrays.normals = base.normals;
  for (size_t set = 0; set < 2; set++) arrays.texcoords[set] = base.texcoords[set];
  std::vector<Color16> colors;
  for (const ColorCode& code : codes.colors) colors.push_back(color_value(code));
  arrays.colors = colors;
  arrays.indices = {base.faces.empty() ? nullptr : base.faces[0].data(), 3 * base.faces.size()};
  auto mesh = Refinement::open(layout, arrays);
  LW_ASSERT(mesh);
  return std::move(*mesh);
}

// Replays the refinement as a decoder will and encodes each step.
class Encoder {
 public:
  explicit Encoder(const ProgressiveMesh& mesh)
      : mesh_(mesh), base_(base_of(mesh)), sweep_(mesh.base_points), next_face_(mesh.base_faces) {
    out_.layout = layout_of(mesh);
    out_.base = dequantize(base_);
    level_.emplace(open_base(out_.layout, out_.base, base_));
    finals_.resize(3 * mesh.mesh.faces.size());
    next_place_.push_back(0);
    for (const RegionLayout& region : out_.layout.regions) next_place_.push_back(next_place_.back() + 3 * region.faces);
    for (uint32_t f = 0; f < mesh.base_faces; f++)
      for (uint32_t k = 0; k < 3; k++) finals_[next_place_[region_of(f)]++] = mesh.mesh.faces[f][k];
  }

  EncodedMesh run(uint32_t block_vertices) {
    const auto points = static_cast<uint32_t>(mesh_.first_of_point.size() - 1);
    for (uint32_t point = mesh_.base_points; point < points;) {
      uint32_t end = point + 1;
      while (end < points && mesh_.first_of_point[end] - mesh_.first_of_point[point] < block_vertices) end++;
      add_block({.point = point, .end = end});
      point = end;
    }
    for (uint32_t left = mesh_.loose_faces; left > 0; left -= std::min(left, block_vertices))
      add_block({.point = points, .end = points, .loose = std::min(left, block_vertices)});
    if (!out_.layout.has_normals) return std::move(out_);
    for (uint32_t left = level_->vertices() - level_->final_normals(); left > 0; left -= std::min(left, block_vertices))
      add_block({.point = points, .end = points, .normals = std::min(left, block_vertices)});
    return std::move(out_);
  }

 private:
  /// What a block brings: the points up to `end`, faces, normals.
  struct Share {
    uint32_t point = 0, end = 0, loose = 0, normals = 0;
  };

  void add_block(const Share& share) {
    const uint32_t vertices = level_->vertices(), faces = level_->faces();
    ModelWriter writer;
    coder_.count(writer, share.end - share.point);
    for (uint32_t i = share.point; i < share.end; i++) add_point(writer, i);
    coder_.count(writer, share.loose);
    for (uint32_t i = 0; i < share.loose; i++) add_loose_face(writer);
    coder_.count(writer, share.normals);
    for (uint32_t i = 0; i < share.normals; i++) add_normal(writer);

    MeshBlock block{writer.finish(), level_->vertices() - vertices, error_before(share.end)};
    const uint32_t elements = block.vertices + level_->faces() - faces;
    block.payload.resize(
        std::max<size_t>(block.payload.size(), (elements + elements_per_byte - 1) / elements_per_byte));
    out_.blocks.push_back(std::move(block));
  }

  void add_point(ModelWriter& writer, uint32_t point) {
    if (pass_ == 0 || point == mesh_.passes[pass_ - 1].point_end) {
      coder_.count(writer, mesh_.passes[pass_++].point_end - point);
      sweep_.begin_pass();
      coder_.begin_pass(*level_);
      again_ = false;
    }
    const uint32_t first = mesh_.first_of_point[point], end = mesh_.first_of_point[point + 1];
    const uint32_t parent = mesh_.point_of(mesh_.parent[first]);
    while (true) {
      const bool here = sweep_.point() == parent;
      coder_.splits(writer, *level_, level_->first_of_point(sweep_.point()), again_, here);
      again_ = here;
      if (here) break;
      const bool more = sweep_.advance();
      LW_ASSERT(more);
    }
    for (uint32_t v = first; v < end; v++) {
      add_vertex(writer, v, parent, v == first);
      coder_.one_more(writer, level_->first_of_point(parent + 1) - level_->first_of_point(parent), v + 1 < end);
    }
    sweep_.add(point);
  }

  void add_vertex(ModelWriter& writer, uint32_t v, uint32_t parent_point, bool begins_point) {
    NewVertex vertex;
    vertex.parent = mesh_.parent[v];
    level_->gather_fan(vertex.parent, vertex.fan);
    for (const Spoke& spoke : vertex.fan) vertex.moves.push_back(mesh_.ancestor(finals_[spoke.corner], v + 1) == v);
    const uint32_t refined = out_.layout.faces - out_.layout.loose_faces;
    for (; next_face_ < refined && mesh_.appears_with[next_face_] == v; next_face_++)
      vertex.faces.push_back(new_face(v));
    set_attributes(vertex, v);
    const bool coded = coder_.new_vertex(writer, *level_, parent_point, begins_point, vertex);
    LW_ASSERT(coded);
    level_->add(vertex, begins_point);
    coder_.note(vertex);
    for (const NewFace& face : vertex.faces)
      for (uint32_t k = 0; k < 3; k++) finals_[next_place_[face.region]++] = final_corner(face.source, k);
  }

  // The k-th corner, in the final level, of the face of `source`, counted from the corner of `source` (3 * face +
  // corner).
  uint32_t final_corner(uint32_t source, uint32_t k) const { return mesh_.mesh.faces[source / 3][(source + k) % 3]; }

  // The next face as it appears with vertex v.
  NewFace new_face(uint32_t v) const {
    uint32_t source = 3 * next_face_;
    while (mesh_.ancestor(mesh_.mesh.faces[next_face_][source % 3], v + 1) != v) source++;
    const Face& face = mesh_.mesh.faces[next_face_];
    return {mesh_.ancestor(face[(source + 1) % 3], v + 1), mesh_.ancestor(face[(source + 2) % 3], v + 1), source,
            region_of(next_face_)};
  }

  void set_attributes(NewVertex& vertex, uint32_t v) const {
    const QuantizedMesh& codes = mesh_.mesh;
    vertex.position = codes.positions[v];
    for (size_t set = 0; set < 2; set++)
      if (!codes.texcoords[set].empty()) vertex.texcoords[set] = codes.texcoords[set][v];
    if (!codes.colors.empty()) vertex.color = codes.colors[v];
  }

  void add_loose_face(ModelWriter& writer) {
    uint16_t region = region_of(next_face_);
    Face face = mesh_.mesh.faces[next_face_++];
    const bool coded = coder_.loose_face(writer, *level_, face, region);
    LW_ASSERT(coded);
    level_->add_loose(face, region);
  }

  uint16_t region_of(uint32_t face) const {
    return mesh_.mesh.regions.empty() ? uint16_t(0) : mesh_.mesh.regions[face];
  }

  void add_normal(ModelWriter& writer) {
    const uint32_t v = level_->final_normals();
    NormalCode normal = mesh_.mesh.normals[v];
    const bool coded = normals_.normal(writer, *level_, v, normal);
    LW_ASSERT(coded);
    level_->set_next_normal(normal);
  }

  // The error of the level that ends before a point.
  float error_before(uint32_t point) const {
    const auto pass = std::find_if(mesh_.passes.begin(), mesh_.passes.end(),
                                   [&](const ProgressiveMesh::Pass& p) { return point < p.point_end; });
    return pass == mesh_.passes.end() ? 0 : pass->error;
  }

  const ProgressiveMesh& mesh_;
  const QuantizedMesh base_;
  EncodedMesh out_;
  std::optional<Refinement> level_;
  Sweep sweep_;
  SplitCoder coder_;
  NormalCoder normals_;
  size_t pass_ = 0;
  bool again_ = false;
  uint32_t next_face_;
  std::vector<uint32_t> finals_;      // what each index of the current level becomes in the final one
  std::vector<uint32_t> next_place_;  // in the index buffer, of the next face of each region
};

}  // namespace

void MeshLayout::write(ByteWriter& writer) const {
  writer.u32(vertices);
  writer.u32(faces);
  writer.u32(base_vertices);
  writer.u32(base_faces);
  writer.u32(loose_faces);
  writer.f32(base_error);
  writer.u8(static_cast<uint8_t>(has_normals | has_texcoords[0] << 1 | has_texcoords[1] << 2 | has_colors << 3));
  for (const Lattice& lattice : {positions, texcoords[0], texcoords[1]})
    writer.u8(static_cast<uint8_t>(lattice.exponent));
}

void MeshLayout::write_regions(ByteWriter& writer) const {
  for (const RegionLayout& region : regions) {
    writer.u32(region.faces);
    writer.u32(region.base_faces);
    writer.u8(region.shift);
  }
}

EncodedMesh encode(const ProgressiveMesh& mesh, uint32_t block_vertices) { return Encoder(mesh).run(block_vertices); }

}  // namespace lightwell
