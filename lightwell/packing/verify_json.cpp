// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/verify_json.h"

#include <algorithm>
#include <map>
#include <set>

#include "lightwell/asset/light_asset.h"
#include "lightwell/asset/mesh_asset.h"
#include "lightwell/pack/opening.h"
#include "lightwell/packing/lamps_extension.h"
#include "lightwell/packing/unpack.h"
#include "lightwell/packing/verify_primitive.h"
#include "lightwell/scene/import_gltf_material.h"
#include "lightwell/texture/stream.h"

namespace lightwell {
namespace {

const StreamEntry& entry_of(const OpenedPack& pack, uint32_t stream) {
  return pack.reader().directory().streams[stream];
}

tl::unexpected<Error> differs(const char* extension, const std::string& what) {
  return fail(extension, what + " differs from what the streams say");
}

Result<void> verify_identity(const OpenedPack& pack) {
  const PackIdentity& identity = pack.identity();
  if (identity.version != format_version) return differs(streams_extension, "the version");
  if (identity.id != to_text(pack.reader().directory().id)) return differs(streams_extension, "the id");
  return {};
}

// Checks that the BIN chunk is the only buffer and holds no compressed data, so that offsets into it mean the same to
// streams and to glTF loaders.
Result<void> verify_plain_form(const OpenedPack& pack) {
  const Json& buffers = member(pack.json(), "buffers");
  if (buffers.size() > 1) return fail("buffers", "are more than one");
  for (const Json& buffer : buffers) {
    constexpr size_t most_padding = 3;
    const int64_t length = whole_number(member(buffer, "byteLength"));
    const auto held = static_cast<int64_t>(pack.bin().size());
    if (!member(buffer, "uri").is_null() || length > held || length + static_cast<int64_t>(most_padding) < held)
      return fail("buffers[0]", "is not the BIN chunk");
  }
  const Json& views = member(pack.json(), "bufferViews");
  for (size_t i = 0; i < views.size(); i++)
    for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"})
      if (!extension(element(views, i), name).is_null()) return fail(element_name("bufferViews", i), "is compressed");
  return {};
}

/// Grids of different light that are looked up together have the same cells, since clients add them up.
Result<void> verify_same_cells(const OpenedPack& pack, const GridDescription& a, const GridDescription& b) {
  if (a.contains == b.contains || a.priority != b.priority) return {};
  LW_TRY(one, open_asset_as<LightAsset>(pack.reader(), a.stream));
  LW_TRY(other, open_asset_as<LightAsset>(pack.reader(), b.stream));
  if (a.shape == b.shape && a.normal_offset == b.normal_offset && std::ranges::equal(one->bricks(), other->bricks()))
    return {};
  return fail(grids_extension, "grids of different light have different cells");
}

/// The streams of bricks of a grid as its parameters and theirs say.
Result<std::vector<BricksDescription>> bricks_of(const OpenedPack& pack, uint32_t grid) {
  std::vector<BricksDescription> bricks;
  const std::vector<StreamEntry>& streams = pack.reader().directory().streams;
  if (streams[grid].codec != light_codec_lattice) return bricks;
  LW_TRY(layout, LatticeLayout::read(streams[grid].parameters));
  LW_TRY(of_grid, bricks_of_grid(pack.reader().directory(), grid));
  for (const auto& [stream, parameters] : of_grid)
    if (parameters.region < layout.regions.size())
      bricks.push_back(describe_bricks(layout.shape, layout.regions[parameters.region], stream));
  return bricks;
}

Result<void> verify_grids(const OpenedPack& pack) {
  for (size_t i = 1; i < pack.grids().size(); i++)
    LW_CHECK(verify_same_cells(pack, pack.grids()[i - 1], pack.grids()[i]));
  for (const GridDescription& grid : pack.grids()) {
    LW_TRY(light, open_asset_as<LightAsset>(pack.reader(), grid.stream));
    if (grid.shape != light->shape() || grid.normal_offset != light->normal_offset() ||
        grid.codec != entry_of(pack, grid.stream).codec)
      return differs(grids_extension, "a grid");
    LW_TRY(bricks, bricks_of(pack, grid.stream));
    if (grid.bricks != bricks) return differs(grids_extension, "a grid's bricks");
  }
  return {};
}

// Checks that exactly one element names each stream of light, bricks or parts, and each region of a mesh. A program
// that follows the JSON would not show an unnamed one; if two elements named one, programs that start from the stream
// would refine only one of them. Images may belong to any number of textures.
Result<void> verify_named_once(const OpenedPack& pack) {
  std::map<uint32_t, size_t> names;
  for (const GridDescription& grid : pack.grids()) {
    names[grid.stream]++;
    for (const BricksDescription& bricks : grid.bricks) names[bricks.stream]++;
  }
  std::set<std::pair<uint32_t, uint32_t>> regions;
  std::map<uint32_t, size_t> mesh_of;
  for (const RefinedPrimitive& refined : pack.primitives()) {
    if (!regions.emplace(refined.stream, refined.region).second)
      return fail("stream " + std::to_string(refined.stream), "two primitives name one region");
    names[refined.stream]++;
    if (mesh_of.emplace(refined.stream, refined.mesh).first->second != refined.mesh)
      return fail("stream " + std::to_string(refined.stream), "its regions belong to two meshes");
  }
  if (pack.parts()) names[pack.parts()->stream]++;
  const auto& streams = pack.reader().directory().streams;
  for (uint32_t i = 0; i < streams.size(); i++) {
    size_t wanted = 1;
    if (streams[i].kind == StreamKind::mesh) {
      LW_TRY(mesh, open_asset_as<MeshAsset>(pack.reader(), i));
      wanted = mesh->layout().region_count();
    }
    if (streams[i].kind != StreamKind::texture && names[i] != wanted)
      return fail("stream " + std::to_string(i), "is named by " + std::to_string(names[i]) + " elements of the JSON");
  }
  return {};
}

// Checks that levels are smaller images, from coarse to fine, each named for one image alone. `image_of_level` has
// those of the textures before.
Result<void> verify_levels(const OpenedPack& pack, const RefinedTexture& refined, const std::string& name,
                           std::map<uint32_t, uint32_t>& image_of_level) {
  uint32_t width = 0, height = 0;
  for (const TextureLevel& level : refined.levels) {
    LW_TRY(parameters, decode_texture_parameters(entry_of(pack, level.stream).parameters));
    if (level.width != parameters.width || level.height != parameters.height) return differs(texture_extension, name);
    if (level.width < width || level.height < height || level.width > refined.width || level.height > refined.height)
      return fail(name, "its levels are not smaller images of it, from coarse to fine");
    width = level.width;
    height = level.height;
    if (image_of_level.emplace(level.stream, refined.source).first->second != refined.source)
      return fail(name, "stream " + std::to_string(level.stream) + " brings a level of another image");
  }
  return {};
}

Result<void> verify_textures(const OpenedPack& pack) {
  const Json& textures = member(pack.json(), "textures");
  std::map<uint32_t, uint32_t> image_of_stream, image_of_level;
  std::map<int, size_t> refined_of_image;
  for (const RefinedTexture& refined : pack.textures()) {
    const std::string name = element_name("textures", refined.texture);
    LW_TRY(parameters, decode_texture_parameters(entry_of(pack, refined.stream).parameters));
    if (refined.width != parameters.width || refined.height != parameters.height || refined.format != parameters.format)
      return differs(texture_extension, name);
    const int image = image_of(element(textures, refined.texture));
    if (image != static_cast<int>(refined.source) || refined.source >= member(pack.json(), "images").size())
      return fail(name, "its source is not the image that the stream brings");
    if (!image_of_stream.emplace(refined.stream, refined.source).second &&
        image_of_stream[refined.stream] != refined.source)
      return fail(name, "stream " + std::to_string(refined.stream) + " brings another image");
    refined_of_image[image]++;
    LW_CHECK(verify_levels(pack, refined, name, image_of_level));
  }
  for (const auto& [stream, image] : image_of_level)
    if (image_of_stream.contains(stream))
      return fail(texture_extension, "stream " + std::to_string(stream) + " is a level and an image");
  if (image_of_stream.size() != refined_of_image.size()) return fail(texture_extension, "two streams bring one image");
  // Either all textures of an image are refined, or none.
  for (size_t i = 0; i < textures.size(); i++)
    if (const Json& texture = element(textures, i);
        refined_of_image.contains(image_of(texture)) && extension(texture, texture_extension).is_null())
      return fail(element_name("textures", i), "shows an image that a stream brings, but does not say so");
  return {};
}

Result<void> verify_lamps(const OpenedPack& pack) {
  const Json& nodes = member(pack.json(), "nodes");
  const Json& meshes = member(pack.json(), "meshes");
  for (const ClientLamp& lamp : pack.lamps()) {
    const LuminaireId& id = lamp.luminaire;
    if (id.node < 0 && id.primitive < 0) continue;
    const Json& node = element(nodes, static_cast<size_t>(id.node));
    if (id.node < 0 || node.is_null()) return fail(lamps_extension, "a lamp names a node that there is not");
    if (id.primitive < 0) continue;
    const Json& mesh = element(meshes, static_cast<size_t>(index_of(node, "mesh")));
    const Json& primitive = element(member(mesh, "primitives"), static_cast<size_t>(id.primitive));
    if (primitive.is_null()) return fail(lamps_extension, "a lamp names a primitive that there is not");
    const int positions = index_of(member(primitive, "attributes"), "POSITION");
    const Json& accessor = element(member(pack.json(), "accessors"), static_cast<size_t>(positions));
    if (positions < 0 || id.vertex >= number(accessor, "count", 0))
      return fail(lamps_extension, "a lamp names a vertex that the opening does not have");
  }
  return {};
}

}  // namespace

Result<void> verify_json(const OpenedPack& pack) {
  LW_CHECK(verify_identity(pack));
  LW_CHECK(verify_plain_form(pack));
  LW_CHECK(verify_grids(pack));
  LW_CHECK(verify_named_once(pack));
  for (const RefinedPrimitive& refined : pack.primitives()) LW_CHECK(verify_primitive(pack, refined));
  LW_CHECK(verify_textures(pack));
  return verify_lamps(pack);
}

}  // namespace lightwell
