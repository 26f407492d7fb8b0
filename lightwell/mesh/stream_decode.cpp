// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include "lightwell/mesh/normal_coder.h"
#include "lightwell/mesh/refinement.h"
#include "lightwell/mesh/split_coder.h"
#include "lightwell/mesh/stream.h"
#include "lightwell/mesh/sweep.h"

namespace lightwell {
namespace {

// Keeps the offset of every byte in a buffer below 2^32: a vertex's position and a face take 12 bytes each.
constexpr uint32_t most_elements = 0xffffffff / 12;
// The most visits of all passes together, per existing point. Every pass of an encoder but the first refines at least
// one point in 128.
constexpr uint64_t visits_per_point = 256;

tl::unexpected<Error> corrupt(std::string_view reason) { return fail("mesh block", reason); }

}  // namespace

Result<void> MeshLayout::read(ByteReader& reader) {
  for (uint32_t* count : {&vertices, &faces, &base_vertices, &base_faces, &loose_faces}) *count = reader.u32();
  base_error = reader.f32();
  const uint8_t flags = reader.u8();
  has_normals = flags & 1;
  has_texcoords = {(flags & 2) != 0, (flags & 4) != 0};
  has_colors = flags & 8;
  for (Lattice* lattice : {&positions, &texcoords[0], &texcoords[1]})
    lattice->exponent = static_cast<int8_t>(reader.u8());
  if (!reader.ok()) return fail("mesh layout", "too short");
  if (flags > 15) return fail(ErrorKind::unsupported, "mesh layout", "an unknown attribute");
  return check();
}

Result<void> MeshLayout::read_regions(ByteReader& reader) {
  constexpr size_t bytes = 9;
  const size_t count = reader.remaining() / bytes;
  if (reader.remaining() != count * bytes || count < 2 || count > most_regions)
    return fail("mesh layout", "too few regions, or too many");
  regions.resize(count);
  for (RegionLayout& region : regions) {
    region.faces = reader.u32();
    region.base_faces = reader.u32();
    region.shift = reader.u8();
  }
  return check();
}

uint64_t MeshLayout::buffer_bytes() const {
  uint64_t vertex = sizeof(Vec3f);
  if (has_normals) vertex += sizeof(Normal16);
  for (const bool has_set : has_texcoords)
    if (has_set) vertex += sizeof(Vec2f);
  if (has_colors) vertex += sizeof(Color16);
  // The links between faces take their places, too, where regions have theirs.
  return vertices * vertex + faces * uint64_t(sizeof(Face)) * (regions.empty() ? 1 : 2);
}

Result<void> MeshLayout::check() const {
  for (const Lattice& lattice : {positions, texcoords[0], texcoords[1]})
    if (lattice.exponent < Lattice::min_exponent || lattice.exponent > Lattice::max_exponent)
      return fail("mesh layout", "a lattice is out of range");
  if (vertices > most_elements || faces > most_elements) return fail(ErrorKind::limit, "mesh layout", "too large");
  if (base_vertices > vertices || base_faces > faces || loose_faces > faces - base_faces)
    return fail("mesh layout", "its coarsest level is larger than its final one");
  uint64_t of_regions = 0, of_base = 0;
  bool possible = true;
  for (const RegionLayout& region : regions) {
    possible = possible && region.base_faces <= region.faces && region.shift <= most_shift;
    of_regions += region.faces;
    of_base += region.base_faces;
  }
  if (!regions.empty() && (!possible || of_regions != faces || of_base != base_faces))
    return fail("mesh layout", "its regions do not make up its faces");
  return {};
}

struct MeshDecoder::State {
  explicit State(Refinement base) : mesh(std::move(base)), sweep(mesh.points()) {}

  Result<void> decode(Bytes payload);
  Result<void> add_point(ModelReader& reader);
  Result<void> add_vertex(ModelReader& reader, uint32_t parent_point, bool begins_point);
  Result<void> add_loose_face(ModelReader& reader);
  Result<void> add_normal(ModelReader& reader);
  bool has_all_faces() const {
    return mesh.vertices() == mesh.layout().vertices && mesh.faces() == mesh.layout().faces;
  }
  /// Whether its region has room for one more face beside so many that are about to come.
  bool has_room(uint16_t region, size_t coming) const {
    const std::vector<RegionLayout>& regions = mesh.layout().regions;
    return regions.empty() || mesh.faces(region) + coming < regions[region].faces;
  }
  /// Deducts vertices and faces from payload_elements; fails when fewer are left.
  Result<void> spend(size_t elements);

  Refinement mesh;
  Sweep sweep;
  SplitCoder coder;
  NormalCoder normals;
  uint32_t left_of_pass = 0;
  bool again = false;
  bool failed = false;
  uint64_t payload_elements = 0;  ///< vertices and faces that the current payload may still add
  NewVertex vertex;
};

Result<MeshDecoder> MeshDecoder::open(MeshLayout layout, const MeshArrays& base, uint64_t stream_bytes) {
  LW_CHECK(layout.check());
  const uint64_t added = uint64_t(layout.vertices - layout.base_vertices) + (layout.faces - layout.base_faces);
  if (added / elements_per_byte > stream_bytes)
    return fail("mesh stream", "it promises more vertices and faces than its bytes can hold");
  LW_TRY(mesh, Refinement::open(std::move(layout), base));
  return MeshDecoder(std::make_unique<State>(std::move(mesh)));
}

Result<void> MeshDecoder::append(Bytes payload) {
  if (state_->failed) return fail("mesh block", "follows a corrupt one");
  Result<void> result = state_->decode(payload);
  state_->failed = !result;
  return result;
}

Result<void> MeshDecoder::State::decode(Bytes payload) {
  ModelReader reader(payload);
  payload_elements = uint64_t(payload.size()) * elements_per_byte;
  const uint32_t splits = coder.count(reader, 0);
  for (uint32_t i = 0; i < splits; i++) LW_CHECK(add_point(reader));
  const uint32_t loose = coder.count(reader, 0);
  for (uint32_t i = 0; i < loose; i++) LW_CHECK(add_loose_face(reader));
  const uint32_t count = coder.count(reader, 0);
  for (uint32_t i = 0; i < count; i++) LW_CHECK(add_normal(reader));
  if (reader.overrun()) return corrupt("too short");
  return {};
}

Result<void> MeshDecoder::State::add_point(ModelReader& reader) {
  if (left_of_pass == 0) {
    left_of_pass = coder.count(reader, 0);
    if (left_of_pass == 0 || mesh.points() == 0) return corrupt("an empty pass");
    sweep.begin_pass();
    coder.begin_pass(mesh);
    again = false;
    if (sweep.work() > visits_per_point * mesh.points()) return corrupt("too many passes");
  }
  while (!coder.splits(reader, mesh, mesh.first_of_point(sweep.point()), again, false)) {
    again = false;
    if (!sweep.advance()) return corrupt("a pass with too few splits");
  }
  again = true;

  const uint32_t parent = sweep.point(), child = mesh.points();
  bool begins_point = true;
  do {
    LW_CHECK(add_vertex(reader, parent, begins_point));
    begins_point = false;
  } while (coder.one_more(reader, mesh.first_of_point(parent + 1) - mesh.first_of_point(parent), false));
  sweep.add(child);
  left_of_pass--;
  return {};
}

Result<void> MeshDecoder::State::add_vertex(ModelReader& reader, uint32_t parent_point, bool begins_point) {
  const MeshLayout& layout = mesh.layout();
  if (mesh.vertices() == layout.vertices || !coder.new_vertex(reader, mesh, parent_point, begins_point, vertex))
    return corrupt("an impossible split");
  if (reader.overrun()) return corrupt("too short");
  if (vertex.faces.size() > layout.faces - layout.loose_faces - mesh.faces()) return corrupt("too many faces");
  for (size_t i = 0; i < vertex.faces.size(); i++) {
    const uint16_t region = vertex.faces[i].region;
    const auto before = std::span(vertex.faces).first(i);
    if (!has_room(region, static_cast<size_t>(std::ranges::count(before, region, &NewFace::region))))
      return corrupt("too many faces in a region");
  }
  LW_CHECK(spend(1 + vertex.faces.size()));
  mesh.add(vertex, begins_point);
  coder.note(vertex);
  return {};
}

Result<void> MeshDecoder::State::add_loose_face(ModelReader& reader) {
  const MeshLayout& layout = mesh.layout();
  Face face{};
  uint16_t region = 0;
  if (mesh.vertices() < layout.vertices || mesh.faces() < layout.faces - layout.loose_faces ||
      mesh.faces() == layout.faces || !coder.loose_face(reader, mesh, face, region))
    return corrupt("an impossible loose face");
  if (!has_room(region, 0)) return corrupt("too many faces in a region");
  if (reader.overrun()) return corrupt("too short");
  LW_CHECK(spend(1));
  mesh.add_loose(face, region);
  return {};
}

Result<void> MeshDecoder::State::add_normal(ModelReader& reader) {
  NormalCode normal;
  if (!has_all_faces() || !mesh.layout().has_normals || mesh.final_normals() == mesh.vertices() ||
      !normals.normal(reader, mesh, mesh.final_normals(), normal))
    return corrupt("an impossible normal");
  if (reader.overrun()) return corrupt("too short");
  mesh.set_next_normal(normal);
  return {};
}

Result<void> MeshDecoder::State::spend(size_t elements) {
  if (elements > payload_elements) return corrupt("adds more than its bytes may hold");
  payload_elements -= elements;
  return {};
}

MeshDecoder::MeshDecoder(std::unique_ptr<State> state) : state_(std::move(state)) {}
MeshDecoder::MeshDecoder(MeshDecoder&&) noexcept = default;
MeshDecoder& MeshDecoder::operator=(MeshDecoder&&) noexcept = default;
MeshDecoder::~MeshDecoder() = default;

const MeshLayout& MeshDecoder::layout() const { return state_->mesh.layout(); }
uint32_t MeshDecoder::vertices() const { return state_->mesh.vertices(); }
uint32_t MeshDecoder::faces() const { return state_->mesh.faces(); }
bool MeshDecoder::complete() const {
  return state_->has_all_faces() && (!layout().has_normals || state_->mesh.final_normals() == vertices());
}
std::span<const Vec3f> MeshDecoder::positions() const { return state_->mesh.position_buffer; }
std::span<const Normal16> MeshDecoder::normals() const { return state_->mesh.normal_buffer; }
std::span<const Vec2f> MeshDecoder::texcoords(int set) const {
  return state_->mesh.texcoord_buffers[static_cast<size_t>(set)];
}
std::span<const Color16> MeshDecoder::colors() const { return state_->mesh.color_buffer; }
std::span<const uint32_t> MeshDecoder::indices(size_t region) const { return state_->mesh.indices(region); }
std::span<const uint32_t> MeshDecoder::index_buffer() const { return state_->mesh.index_buffer; }
MeshChanges MeshDecoder::take_changes() { return state_->mesh.take_changes(); }

}  // namespace lightwell
