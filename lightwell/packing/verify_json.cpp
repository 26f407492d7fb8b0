// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/verify_json.h"

#include <algorithm>
#include <limits>

#include "lightwell/light/stream.h"
#include "lightwell/mesh/base_places.h"
#include "lightwell/pack/opening.h"
#include "lightwell/pack/self_contained.h"
#include "lightwell/packing/unpack.h"
#include "lightwell/texture/stream.h"

namespace lightwell {
namespace {

// Numbers of JSON are doubles that came from floats.
bool says(const Json& object, const char* key, double value) {
  const Json& said = member(object, key);
  return said.is_number() && static_cast<float>(said.get<double>()) == static_cast<float>(value);
}

bool says(const Json& object, const char* key, const Vec3f& value) {
  const Json& said = member(object, key);
  if (!said.is_array() || said.size() != 3) return false;
  for (size_t i = 0; i < 3; i++)
    if (!said[i].is_number() || static_cast<float>(said[i].get<double>()) != value[static_cast<int>(i)]) return false;
  return true;
}

tl::unexpected<Error> differs(const std::string& what) {
  return fail("JSON", what + " differs from what the streams say");
}

Result<void> verify_identity(const Json& json, const Directory& directory) {
  const Json& identity = extension(json, "LIGHTWELL_streams");
  if (!says(identity, "version", format_version)) return differs("the version in LIGHTWELL_streams");
  if (text(identity, "id") != to_text(directory.id)) return differs("the id in LIGHTWELL_streams");
  return {};
}

Result<void> verify_grid(const Json& grid, const StreamEntry& entry) {
  LW_TRY(layout, LightLayout::read(entry.parameters));
  const GridShape& shape = layout.shape;
  if (!says(grid, "min", shape.lo) || !says(grid, "cell", shape.cell) ||
      !says(grid, "nodes", shape.nodes.cast<float>()) || !says(grid, "normalOffset", layout.normal_offset) ||
      whole_number(member(grid, "codec")) != entry.codec)
    return differs("LIGHTWELL_light_grids: a grid");
  return {};
}

// A bound of the input holds for what is decoded but for the rounding to the lattice. One that is missing holds for
// nothing.
bool holds(const Json& bounds, const BaseArrays& base, float step) {
  const Vec3d none = Vec3d::filled(std::numeric_limits<double>::quiet_NaN());
  const Vec3f lo = numbers<3>(bounds, "min", none).cast<float>() - Vec3f::filled(step);
  const Vec3f hi = numbers<3>(bounds, "max", none).cast<float>() + Vec3f::filled(step);
  const auto inside = [&](const Vec3f& p) {
    for (int i = 0; i < 3; i++)
      if (!(p[i] >= lo[i] && p[i] <= hi[i])) return false;
    return true;
  };
  return std::all_of(base.positions.begin(), base.positions.end(), inside);
}

Result<void> verify_primitive(const Json& primitive, const StreamEntry& entry, Bytes bin) {
  ByteReader parameters(entry.parameters);
  LW_TRY(layout, MeshLayout::read(parameters));
  LW_TRY(places, BasePlaces::read(parameters));
  LW_TRY(base, BaseArrays::read(layout, places, bin));
  if (!says(primitive, "vertices", layout.vertices) || !says(primitive, "faces", layout.faces) ||
      !says(primitive, "error", layout.base_error) ||
      !holds(member(primitive, "bounds"), base, layout.positions.step()))
    return differs("LIGHTWELL_progressive_mesh: a primitive");
  return {};
}

Result<void> verify_texture(const Json& texture, const StreamEntry& entry) {
  LW_TRY(parameters, decode_texture_parameters(entry.parameters));
  if (!says(texture, "width", parameters.width) || !says(texture, "height", parameters.height) ||
      text(texture, "mimeType") != mime_type(parameters.format))
    return differs("LIGHTWELL_progressive_texture: a texture");
  return {};
}

// Calls verify(object, entry) when the object is there, with the stream that it names.
template <typename Verify>
Result<void> verify_named(const Directory& directory, const Json& object, StreamKind kind, const Verify& verify) {
  if (!object.is_object()) return {};
  const int stream = index_of(object, "stream");
  if (stream < 0 || static_cast<size_t>(stream) >= directory.streams.size() ||
      directory.streams[static_cast<size_t>(stream)].kind != kind)
    return fail("JSON", "names a " + std::string(to_text(kind)) + " stream that there is not");
  return verify(object, directory.streams[static_cast<size_t>(stream)]);
}

}  // namespace

Result<void> verify_json(const PackReader& pack) {
  const GlbChunks chunks = glb_chunks(pack.opening());
  LW_CHECK(check_self_contained({reinterpret_cast<const char*>(chunks.json.data()), chunks.json.size()}));
  LW_TRY(json, pack_json(pack));
  const Directory& directory = pack.directory();
  LW_CHECK(verify_identity(json, directory));
  for (const Json& grid : member(extension(json, "LIGHTWELL_light_grids"), "grids"))
    LW_CHECK(verify_named(directory, grid, StreamKind::light, verify_grid));
  for (const Json& mesh : member(json, "meshes"))
    for (const Json& primitive : member(mesh, "primitives"))
      LW_CHECK(verify_named(
          directory, extension(primitive, "LIGHTWELL_progressive_mesh"), StreamKind::mesh,
          [&](const Json& said, const StreamEntry& entry) { return verify_primitive(said, entry, chunks.bin); }));
  for (const Json& texture : member(json, "textures"))
    LW_CHECK(verify_named(directory, extension(texture, "LIGHTWELL_progressive_texture"), StreamKind::texture,
                          verify_texture));
  return {};
}

}  // namespace lightwell
