// SPDX-License-Identifier: Apache-2.0
#include "lightwell/mesh/base_places.h"

namespace lightwell {
namespace {

// The bytes of `count` elements of `size` bytes; the reader fails when they are not all there.
ByteReader at(Bytes bin, uint32_t place, size_t count, size_t size) {
  if (place > bin.size() || count > (bin.size() - place) / size) {
    ByteReader nothing({});
    nothing.u8();
    return nothing;
  }
  return ByteReader(bin.subspan(place, count * size));
}

template <int N>
bool read_floats(std::vector<Vec<float, N>>& values, Bytes bin, uint32_t place, size_t count) {
  ByteReader reader = at(bin, place, count, size_t(4) * N);
  if (!reader.ok()) return false;
  values.resize(count);
  for (auto& value : values)
    for (int i = 0; i < N; i++) value[i] = reader.f32();
  return true;
}

}  // namespace

void BasePlaces::write(ByteWriter& writer) const {
  for (const uint32_t place : {positions, normals, texcoords[0], texcoords[1], colors, indices}) writer.u32(place);
  writer.u8(short_indices);
}

Result<BasePlaces> BasePlaces::read(ByteReader& reader) {
  BasePlaces places;
  for (uint32_t* place : {&places.positions, &places.normals, &places.texcoords[0], &places.texcoords[1],
                          &places.colors, &places.indices})
    *place = reader.u32();
  const uint8_t width = reader.u8();
  if (!reader.ok()) return fail("mesh parameters", "are too short");
  if (width > 1) return fail(ErrorKind::unsupported, "mesh parameters", "an unknown width of indices");
  places.short_indices = width == 1;
  return places;
}

bool BasePlaces::only_of(const MeshLayout& layout) const {
  return (layout.has_normals || normals == 0) && (layout.has_texcoords[0] || texcoords[0] == 0) &&
         (layout.has_texcoords[1] || texcoords[1] == 0) && (layout.has_colors || colors == 0);
}

Result<MeshParameters> MeshParameters::read(Bytes parameters, bool has_regions) {
  ByteReader reader(parameters);
  MeshParameters out;
  LW_CHECK(out.layout.read(reader));
  LW_TRY(places, BasePlaces::read(reader));
  out.places = places;
  if (has_regions) LW_CHECK(out.layout.read_regions(reader));
  if (reader.remaining() != 0) return fail("mesh parameters", "are too long");
  if (!places.only_of(out.layout)) return fail("mesh parameters", "a place of an attribute that there is not");
  return out;
}

Result<BaseArrays> BaseArrays::read(const MeshLayout& layout, const BasePlaces& places, Bytes bin) {
  const size_t count = layout.base_vertices;
  BaseArrays arrays;
  bool inside = read_floats(arrays.positions, bin, places.positions, count);
  if (layout.has_normals) inside = inside && read_floats(arrays.normals, bin, places.normals, count);
  for (size_t set = 0; set < 2; set++)
    if (layout.has_texcoords[set])
      inside = inside && read_floats(arrays.texcoords[set], bin, places.texcoords[set], count);
  if (layout.has_colors) {
    ByteReader reader = at(bin, places.colors, count, 8);
    inside = inside && reader.ok();
    if (inside) arrays.colors.resize(count);
    for (Color16& color : arrays.colors)
      for (uint16_t& channel : color) channel = reader.u16();
  }
  const size_t corners = size_t(3) * layout.base_faces;
  ByteReader reader = at(bin, places.indices, corners, places.short_indices ? 2 : 4);
  if (!inside || !reader.ok()) return fail("mesh", "its coarsest level lies outside the opening");
  arrays.indices.resize(corners);
  for (uint32_t& index : arrays.indices) index = places.short_indices ? reader.u16() : reader.u32();
  return arrays;
}

}  // namespace lightwell
