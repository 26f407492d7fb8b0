// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/pack_json.h"

#include <algorithm>

#include "lightwell/light/stream.h"
#include "lightwell/packing/grids_extension.h"
#include "lightwell/packing/lamps_extension.h"
#include "lightwell/packing/member_reader.h"

namespace lightwell {
namespace {

void use_extension(Json& json, const char* name) {
  Json& used = json["extensionsUsed"];
  if (std::find(used.begin(), used.end(), name) == used.end()) used.push_back(name);
}

std::vector<GridDescription> describe(const PackLight& light, const PackContent& content) {
  std::vector<GridDescription> grids;
  for (const PackGrid& grid : light.grids)
    grids.push_back({static_cast<uint32_t>(content.grid_stream(grids.size())), grid.grid->shape, light_codec_slices,
                     grid.grid->normal_offset, grid.estimated_error, grid.priority, grid.contains});
  return grids;
}

Json mesh_json(const StreamedMesh& mesh, const Mesh& original, size_t stream) {
  const MeshLayout& layout = mesh.encoded.layout;
  const Box3f bounds = original.bounds();
  return {{"stream", stream},
          {"vertices", layout.vertices},
          {"faces", layout.faces},
          {"bounds", {{"min", to_json(bounds.lo)}, {"max", to_json(bounds.hi)}}},
          {"error", to_json(layout.base_error)}};
}

}  // namespace

void add_extensions(Document& document, const Scene& scene, const PackLight& light, const PackContent& content) {
  Json& json = document.json;
  for (size_t i = 0; i < content.meshes.size(); i++) {
    const Primitive& source = scene.primitives[static_cast<size_t>(content.meshes[i].primitive)];
    Json& primitive = json["meshes"][static_cast<size_t>(source.source_mesh)]["primitives"]
                          [static_cast<size_t>(source.source_primitive)];
    primitive["extensions"]["LIGHTWELL_progressive_mesh"] =
        mesh_json(content.meshes[i], source.mesh, content.mesh_stream(i));
    use_extension(json, "LIGHTWELL_progressive_mesh");
  }
  for (size_t i = 0; i < content.images.size(); i++)
    for (Json& texture : json["textures"]) {
      if (index_of(texture, "source") != content.images[i].image) continue;
      const TextureParameters& parameters = content.images[i].parameters;
      texture["extensions"]["LIGHTWELL_progressive_texture"] = {{"stream", content.image_stream(i)},
                                                                {"width", parameters.width},
                                                                {"height", parameters.height},
                                                                {"mimeType", mime_type(parameters.format)}};
      use_extension(json, "LIGHTWELL_progressive_texture");
    }
  json["extensions"][grids_extension] = to_json(describe(light, content));
  use_extension(json, grids_extension);
  json["extensions"][lamps_extension] = to_json(light.lamps);
  use_extension(json, lamps_extension);
}

void add_pack_identity(Json& json, const PackId& id, float exposure) {
  json["extensions"]["LIGHTWELL_streams"] = {{"version", format_version},
                                             {"id", to_text(id)},
                                             {"generator", "lightwell " LIGHTWELL_VERSION},
                                             {"exposure", to_json(exposure)}};
  use_extension(json, "LIGHTWELL_streams");
}

}  // namespace lightwell
