// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/unpack.h"

#include <array>

#include "lightwell/gltf/extensions.h"
#include "lightwell/gltf/parsed_document.h"
#include "lightwell/light/stream.h"
#include "lightwell/pack/opening.h"
#include "lightwell/packing/lamps_extension.h"
#include "lightwell/texture/stream.h"

namespace lightwell {
namespace {

bool fine_enough(const MeshDecoder& decoder, float error, const MeshLevel& level) {
  const auto wanted = static_cast<double>(level.share) * decoder.layout().faces;
  return decoder.complete() || (decoder.faces() >= wanted && (level.error < 0 || error <= level.error));
}

Mesh mesh_of(const MeshDecoder& decoder) {
  Mesh mesh;
  const size_t count = decoder.vertices();
  const auto positions = decoder.positions().first(count);
  mesh.positions.assign(positions.begin(), positions.end());
  for (const Normal16& n : decoder.normals().first(std::min(count, decoder.normals().size())))
    mesh.normals.push_back(normalized(Vec3f{{float(n[0]), float(n[1]), float(n[2])}}));
  for (int set = 0; set < 2; set++) {
    const auto texcoords = decoder.texcoords(set);
    if (!texcoords.empty())
      mesh.texcoords[static_cast<size_t>(set)].assign(texcoords.begin(),
                                                      texcoords.begin() + static_cast<ptrdiff_t>(count));
  }
  for (const Color16& c : decoder.colors().first(std::min(count, decoder.colors().size())))
    mesh.colors.push_back(color_of(c));
  const auto indices = decoder.indices().first(size_t(3) * decoder.faces());
  for (size_t i = 0; i < indices.size(); i += 3) mesh.faces.push_back({indices[i], indices[i + 1], indices[i + 2]});
  return mesh;
}

Result<Mesh> unpack_mesh(const PackReader& pack, size_t stream, const MeshLevel& level) {
  const StreamEntry& entry = pack.directory().streams[stream];
  LW_TRY(decoder, open_mesh_stream(pack, entry));
  float error = entry.error;
  for (uint32_t block = 0; block < entry.blocks && !fine_enough(decoder, error, level); block++) {
    LW_TRY(payload, pack.block(stream, block));
    LW_CHECK(decoder.append(payload));
    error = pack.rows(stream)[block].error;
  }
  return mesh_of(decoder);
}

Result<std::vector<uint8_t>> unpack_image(const PackReader& pack, size_t stream) {
  const StreamEntry& entry = pack.directory().streams[stream];
  LW_TRY(parameters, decode_texture_parameters(entry.parameters));
  TextureDecoder decoder(parameters);
  for (uint32_t block = 0; block < entry.blocks; block++) {
    LW_TRY(payload, pack.block(stream, block));
    LW_CHECK(decoder.append(payload));
  }
  if (!decoder.complete()) return fail("stream " + std::to_string(stream), "the image is not complete");
  return decoder.file();
}

Result<void> refine_meshes(Document& document, const PackRefinement& refinement) {
  LW_TRY(primitives, read_refined_primitives(document.json));
  for (const RefinedPrimitive& refined : primitives) {
    LW_TRY(mesh, refinement.mesh(refined.stream));
    const Json arrays = DocumentBuilder(document).primitive(mesh);
    Json& target = document.json["meshes"][refined.mesh]["primitives"][refined.primitive];
    target["attributes"] = arrays["attributes"];
    target["indices"] = arrays["indices"];
  }
  return {};
}

Result<void> complete_images(Document& document, const PackRefinement& refinement) {
  LW_TRY(textures, read_refined_textures(document.json));
  for (const RefinedTexture& refined : textures) {
    LW_TRY(file, refinement.image(refined.stream));
    if (file.empty()) continue;
    const int view = DocumentBuilder(document).buffer_view(file);
    Json& target = document.json["images"][refined.source];
    target["mimeType"] = mime_type(refined.format);
    target["bufferView"] = view;
  }
  return {};
}

// Removes the LIGHTWELL_ extensions, which would be wrong of the refined document.
void drop_extensions(Json& json) {
  constexpr std::array names = {streams_extension, grids_extension, lamps_extension, mesh_extension, texture_extension};
  const auto drop = [&](Json& object) {
    if (!object.contains("extensions")) return;
    for (const char* name : names) object["extensions"].erase(name);
    if (object["extensions"].empty()) object.erase("extensions");
  };
  drop(json);
  if (json.contains("meshes"))
    for (Json& mesh : json["meshes"])
      for (Json& primitive : mesh["primitives"]) drop(primitive);
  if (json.contains("textures"))
    for (Json& texture : json["textures"]) drop(texture);
  for (const char* name : names) forget_extension(json, name);
}

}  // namespace

Result<MeshDecoder> open_mesh_stream(const PackReader& pack, const StreamEntry& entry) {
  ByteReader parameters(entry.parameters);
  LW_TRY(layout, MeshLayout::read(parameters));
  LW_TRY(places, BasePlaces::read(parameters));
  LW_TRY(base, BaseArrays::read(layout, places, glb_chunks(pack.opening()).bin));
  return MeshDecoder::open(layout, base.view(), entry.length);
}

Result<void> refine_document(Document& document, const PackRefinement& refinement) {
  LW_CHECK(refine_meshes(document, refinement));
  LW_CHECK(complete_images(document, refinement));
  drop_extensions(document.json);
  drop_unused(document);
  return {};
}

Result<Document> unpack_document(const OpenedPack& pack, const MeshLevel& level, Report& report) {
  auto document = read_document(pack.json(), pack.bin(), report);
  if (!document) return document;
  const PackRefinement refinement{[&](size_t stream) { return unpack_mesh(pack.reader(), stream, level); },
                                  [&](size_t stream) { return unpack_image(pack.reader(), stream); }};
  LW_CHECK(refine_document(*document, refinement));
  return document;
}

Result<LightGrid> unpack_light(const PackReader& pack, size_t stream, const LightLevel& level) {
  const StreamEntry& entry = pack.directory().streams[stream];
  LW_TRY(decoder, LightDecoder::open(entry.parameters, entry.length));
  const double wanted = static_cast<double>(level.share) * static_cast<double>(decoder.grid().shape.count());
  for (uint32_t block = 0; block < entry.blocks && static_cast<double>(decoder.received()) < wanted; block++) {
    LW_TRY(payload, pack.block(stream, block));
    LW_CHECK(decoder.append(payload));
  }
  if (level.share >= 1 && !decoder.complete())
    return fail("stream " + std::to_string(stream), "the light grid is not complete");
  LightGrid grid = decoder.grid();
  push_pull(grid, decoder.known(), level.fill);
  return grid;
}

}  // namespace lightwell
