// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/unpack.h"

#include <algorithm>
#include <array>

#include "lightwell/asset/light_asset.h"
#include "lightwell/asset/mesh_asset.h"
#include "lightwell/asset/parts_asset.h"
#include "lightwell/asset/texture_asset.h"
#include "lightwell/gltf/extensions.h"
#include "lightwell/gltf/parsed_document.h"
#include "lightwell/pack/opening.h"
#include "lightwell/packing/deformation.h"
#include "lightwell/packing/environment_picture.h"
#include "lightwell/packing/lamps_extension.h"
#include "lightwell/packing/restore_parts.h"
#include "lightwell/texture/image_file.h"

namespace lightwell {
namespace {

bool fine_enough(const MeshAsset& mesh, float error, const MeshLevel& level) {
  if (level.share >= 1 && level.error < 0) return mesh.complete();
  const auto wanted = static_cast<double>(level.share) * mesh.layout().faces;
  return mesh.complete() || (mesh.buffers().faces >= wanted && (level.error < 0 || error <= level.error));
}

// A mesh for each region.
std::vector<Mesh> meshes_of(const MeshAsset& asset) {
  const MeshBuffers buffers = asset.buffers();
  Mesh mesh;
  const size_t count = buffers.vertices;
  const auto positions = buffers.positions.first(count);
  mesh.positions.assign(positions.begin(), positions.end());
  for (const Normal16& n : buffers.normals.first(std::min(count, buffers.normals.size())))
    mesh.normals.push_back(normalized(Vec3f{{float(n[0]), float(n[1]), float(n[2])}}));
  for (size_t set = 0; set < 2; set++) {
    const auto texcoords = buffers.texcoords[set];
    if (!texcoords.empty())
      mesh.texcoords[set].assign(texcoords.begin(), texcoords.begin() + static_cast<ptrdiff_t>(count));
  }
  for (const Color16& c : buffers.colors.first(std::min(count, buffers.colors.size())))
    mesh.colors.push_back(color_of(c));
  std::vector<Mesh> meshes;
  for (size_t region = 0; region < asset.layout().region_count(); region++) {
    const auto indices = asset.indices(region);
    std::vector<Face> faces;
    for (size_t i = 0; i < indices.size(); i += 3) faces.push_back({indices[i], indices[i + 1], indices[i + 2]});
    meshes.push_back(asset.layout().regions.empty() ? mesh : mesh_of_faces(mesh, faces));
    if (asset.layout().regions.empty()) meshes.back().faces = std::move(faces);
  }
  return meshes;
}

// Appends a stream's blocks as long as wanted(block) returns true.
template <typename Wanted>
Result<void> append_blocks(const PackReader& pack, size_t stream, AssetDecoder& decoder, const Wanted& wanted) {
  for (uint32_t block = 0; block < pack.directory().streams[stream].blocks && wanted(block); block++) {
    LW_TRY(payload, pack.block(stream, block));
    LW_CHECK(decoder.append(payload));
  }
  return {};
}

Result<std::vector<Mesh>> unpack_meshes(const PackReader& pack, size_t stream, const MeshLevel& level) {
  LW_TRY(mesh, open_asset_as<MeshAsset>(pack, stream));
  LW_CHECK(append_blocks(pack, stream, *mesh, [&](uint32_t block) {
    const float error = block == 0 ? pack.directory().streams[stream].error : pack.rows(stream)[block - 1].error;
    return !fine_enough(*mesh, error, level);
  }));
  return meshes_of(*mesh);
}

Result<void> refine_meshes(Document& document, const PackRefinement& refinement) {
  LW_TRY(primitives, read_refined_primitives(document.json));
  std::map<uint32_t, std::vector<Mesh>> of_stream;
  std::map<uint32_t, size_t> left;  // of its regions
  for (const RefinedPrimitive& refined : primitives) left[refined.stream]++;
  for (const RefinedPrimitive& refined : primitives) {
    if (!of_stream.contains(refined.stream)) {
      LW_TRY(meshes, refinement.meshes(refined.stream));
      of_stream[refined.stream] = std::move(meshes);
    }
    std::vector<Mesh>& meshes = of_stream[refined.stream];
    if (refined.region >= meshes.size()) return fail(mesh_extension, "a region that its stream does not have");
    const Mesh mesh = left[refined.stream] == 1 ? std::move(meshes[refined.region]) : meshes[refined.region];
    if (--left[refined.stream] == 0) of_stream.erase(refined.stream);
    const Json arrays = DocumentBuilder(document).primitive(mesh);
    Json& target = document.json["meshes"][refined.mesh]["primitives"][refined.primitive];
    target["attributes"] = arrays["attributes"];
    target["indices"] = arrays["indices"];
    if (!refined.deformation) continue;
    LW_TRY(bending, prefix_of(*refined.deformation, mesh.positions.size(), document));
    bend_by(bending, document.json["meshes"][refined.mesh]["primitives"][refined.primitive]);
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

// Removes the LIGHTWELL_ extensions, which do not hold for the refined document.
void drop_extensions(Json& json) {
  constexpr std::array names = {streams_extension, grids_extension,       lamps_extension, mesh_extension,
                                texture_extension, environment_extension, parts_extension};
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

void drop_last(Json& json, const char* array) {
  json[array].erase(json[array].size() - 1);
  if (json[array].empty()) json.erase(array);
}

/// Removes the picture of the surroundings, the last texture and the last image, where the baker appends it: no
/// material shows it.
void drop_environment(Json& json) {
  const Json& textures = member(json, "textures");
  const int texture = index_of(extension(json, environment_extension), "texture");
  if (texture < 0 || texture + 1 != static_cast<int>(textures.size())) return;
  const int image = index_of(element(textures, static_cast<size_t>(texture)), "source");
  const auto shows = [&](const Json& other) { return index_of(other, "source") == image; };
  const bool alone = std::ranges::count_if(textures, shows) == 1;
  drop_last(json, "textures");
  if (alone && image + 1 == static_cast<int>(member(json, "images").size())) drop_last(json, "images");
}

/// The file of a texture's image: of the stream that brings it, or in the opening.
Result<std::vector<uint8_t>> image_of_texture(const OpenedPack& pack, uint32_t texture) {
  for (const RefinedTexture& refined : pack.textures())
    if (refined.texture == texture) return unpack_image(pack.reader(), refined.stream);
  Report ignored;
  LW_TRY(document, read_document(pack.json(), pack.bin(), ignored));
  return read_image(document, index_of(element(member(pack.json(), "textures"), texture), "source"));
}

}  // namespace

Result<std::vector<uint8_t>> unpack_image(const PackReader& pack, size_t stream) {
  LW_TRY(image, open_asset_as<TextureAsset>(pack, stream));
  LW_CHECK(append_blocks(pack, stream, *image, [](uint32_t) { return true; }));
  if (!image->complete()) return fail("stream " + std::to_string(stream), "the image is not complete");
  return image->file();
}

Result<std::optional<RadianceImage>> unpack_environment(const OpenedPack& pack, ImageLimit limit) {
  if (!pack.environment()) return std::nullopt;
  const auto image = [&]() -> Result<Image> {
    LW_TRY(file, image_of_texture(pack, pack.environment()->texture));
    return read_image_file(file, limit);
  }();
  if (!image) return fail(image.error().kind, environment_extension, image.error().message());
  return decoded(*image, *pack.environment());
}

Result<void> refine_document(Document& document, const PackRefinement& refinement) {
  LW_CHECK(refine_meshes(document, refinement));
  LW_CHECK(complete_images(document, refinement));
  drop_environment(document.json);
  drop_extensions(document.json);
  drop_unused(document);
  return {};
}

Result<Document> unpack_document(const OpenedPack& pack, const MeshLevel& level, Report& report) {
  auto document = read_document(pack.json(), pack.bin(), report);
  if (!document) return document;
  const PackRefinement refinement{[&](size_t stream) { return unpack_meshes(pack.reader(), stream, level); },
                                  [&](size_t stream) { return unpack_image(pack.reader(), stream); }};
  LW_CHECK(refine_document(*document, refinement));
  return document;
}

Result<void> unpack_parts(const OpenedPack& pack, Document& document) {
  if (!pack.parts()) return {};
  LW_TRY(parts, open_asset_as<PartsAsset>(pack.reader(), pack.parts()->stream));
  LW_CHECK(append_blocks(pack.reader(), pack.parts()->stream, *parts, [](uint32_t) { return true; }));
  LW_TRY(file, read_parts_file(parts->file(), parts->parameters().inflated));
  const size_t mesh = pack.parts()->meshes;
  std::map<uint32_t, std::vector<Mesh>> of_stream;
  const auto final_level = [&](size_t primitive) -> Result<Mesh> {
    for (const RefinedPrimitive& refined : pack.primitives()) {
      if (refined.mesh != mesh || refined.primitive != primitive) continue;
      if (!of_stream.contains(refined.stream)) {
        LW_TRY(meshes, unpack_meshes(pack.reader(), refined.stream, {}));
        of_stream[refined.stream] = std::move(meshes);
      }
      if (refined.region >= of_stream[refined.stream].size())
        return fail(mesh_extension, "a region that its stream does not have");
      return of_stream[refined.stream][refined.region];
    }
    Report known;
    return read_primitive(document, static_cast<int>(mesh), static_cast<int>(primitive), known);
  };
  return restore_parts(document, *pack.parts(), std::move(file), final_level, pack.identity().origin);
}

Result<std::map<uint32_t, BricksLayout>> bricks_of_grid(const Directory& directory, size_t grid) {
  std::map<uint32_t, BricksLayout> bricks;
  for (uint32_t stream = 0; stream < directory.streams.size(); stream++) {
    const StreamEntry& entry = directory.streams[stream];
    if (entry.kind != StreamKind::bricks) continue;
    LW_TRY(layout, BricksLayout::read(entry.parameters));
    if (layout.grid == grid) bricks[stream] = layout;
  }
  return bricks;
}

Result<LightGrid> unpack_light(const PackReader& pack, size_t stream, const LightLevel& level) {
  AssetContext context{.bin = glb_chunks(pack.opening()).bin};
  LW_TRY(light, open_asset_as<LightAsset>(pack.directory(), stream, context));
  const double wanted = static_cast<double>(level.share) * static_cast<double>(light->total());
  const auto more = [&](uint32_t) { return static_cast<double>(light->received()) < wanted; };
  LW_CHECK(append_blocks(pack, stream, *light, more));
  LW_TRY(of_grid, bricks_of_grid(pack.directory(), stream));
  for (const auto& [other, layout] : of_grid) {
    LW_TRY(bricks, open_asset(pack.directory(), other, context));
    LW_CHECK(append_blocks(pack, other, *bricks, more));
  }
  if (level.share >= 1 && light->received() < light->total())
    return fail("stream " + std::to_string(stream), "the light grid is not complete");
  return light->filled(level.fill);
}

}  // namespace lightwell
