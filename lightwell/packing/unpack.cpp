// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/unpack.h"

#include <array>

#include "lightwell/gltf/extensions.h"
#include "lightwell/light/stream.h"
#include "lightwell/pack/opening.h"
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

// A stream that the JSON names must exist and be of the kind.
Result<void> check_kind(const PackReader& pack, size_t stream, StreamKind kind) {
  const auto& streams = pack.directory().streams;
  if (stream >= streams.size() || streams[stream].kind != kind)
    return fail("JSON", "stream " + std::to_string(stream) + " is no " + to_text(kind) + " stream");
  return {};
}

Result<void> refine_meshes(Document& document, const PackRefinement& refinement) {
  const Json meshes = member(document.json, "meshes");
  for (size_t m = 0; m < meshes.size(); m++) {
    const Json& primitives = member(meshes[m], "primitives");
    for (size_t p = 0; p < primitives.size(); p++) {
      const int stream = index_of(extension(primitives[p], "LIGHTWELL_progressive_mesh"), "stream");
      if (stream < 0) continue;
      LW_TRY(mesh, refinement.mesh(static_cast<size_t>(stream)));
      const Json arrays = DocumentBuilder(document).primitive(mesh);
      Json& target = document.json["meshes"][m]["primitives"][p];
      target["attributes"] = arrays["attributes"];
      target["indices"] = arrays["indices"];
    }
  }
  return {};
}

Result<void> complete_images(Document& document, const PackRefinement& refinement) {
  const Json textures = member(document.json, "textures");
  for (const Json& texture : textures) {
    const Json& progressive = extension(texture, "LIGHTWELL_progressive_texture");
    const int stream = index_of(progressive, "stream"), image = index_of(texture, "source");
    if (stream < 0 || image < 0) continue;
    LW_TRY(file, refinement.image(static_cast<size_t>(stream)));
    if (file.empty()) continue;
    const int view = DocumentBuilder(document).buffer_view(file);
    Json& target = document.json["images"][static_cast<size_t>(image)];
    target["mimeType"] = text(progressive, "mimeType");
    target["bufferView"] = view;
  }
  return {};
}

// Removes the LIGHTWELL_ extensions, which would be wrong of the refined document.
void drop_extensions(Json& json) {
  constexpr std::array names = {"LIGHTWELL_streams", "LIGHTWELL_light_grids", "LIGHTWELL_lamps",
                                "LIGHTWELL_progressive_mesh", "LIGHTWELL_progressive_texture"};
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

Result<Json> pack_json(const PackReader& pack) {
  const Bytes opening = pack.opening(), json = glb_chunks(opening).json;
  return parse_json(json, static_cast<uint64_t>(json.data() - opening.data()));
}

Bytes pack_bin(const PackReader& pack) { return glb_chunks(pack.opening()).bin; }

Result<MeshDecoder> open_mesh_stream(const PackReader& pack, const StreamEntry& entry) {
  ByteReader parameters(entry.parameters);
  LW_TRY(layout, MeshLayout::read(parameters));
  LW_TRY(places, BasePlaces::read(parameters));
  LW_TRY(base, BaseArrays::read(layout, places, pack_bin(pack)));
  return MeshDecoder::open(layout, base.view(), entry.length);
}

Result<void> refine_document(Document& document, const PackRefinement& refinement) {
  LW_CHECK(refine_meshes(document, refinement));
  LW_CHECK(complete_images(document, refinement));
  drop_extensions(document.json);
  drop_unused(document);
  return {};
}

Result<Document> unpack_document(const PackReader& pack, const MeshLevel& level, Report& report) {
  auto document = read_document(pack.opening(), {}, report);
  if (!document) return document;
  const PackRefinement refinement{[&](size_t stream) -> Result<Mesh> {
                                    LW_CHECK(check_kind(pack, stream, StreamKind::mesh));
                                    return unpack_mesh(pack, stream, level);
                                  },
                                  [&](size_t stream) -> Result<std::vector<uint8_t>> {
                                    LW_CHECK(check_kind(pack, stream, StreamKind::texture));
                                    return unpack_image(pack, stream);
                                  }};
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

Result<size_t> find_light_stream(const PackReader& pack) {
  const auto& streams = pack.directory().streams;
  for (size_t i = 0; i < streams.size(); i++)
    if (streams[i].kind == StreamKind::light) return i;
  return fail("", "holds no light");
}

}  // namespace lightwell
