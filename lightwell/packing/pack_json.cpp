// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/pack_json.h"

#include <algorithm>

#include "lightwell/light/lattice_stream.h"
#include "lightwell/packing/grids_extension.h"
#include "lightwell/packing/lamps_extension.h"
#include "lightwell/packing/mesh_extension.h"
#include "lightwell/packing/streams_extension.h"
#include "lightwell/packing/texture_extension.h"

namespace lightwell {
namespace {

void use_extension(Json& json, const char* name) {
  Json& used = json["extensionsUsed"];
  if (std::find(used.begin(), used.end(), name) == used.end()) used.push_back(name);
}

std::vector<GridDescription> describe(const PackLight& light, const PackContent& content) {
  std::vector<GridDescription> grids;
  for (const PackGrid& grid : light.grids)
    grids.push_back({static_cast<uint32_t>(content.grid_stream(grids.size())), grid.grid->shape,
                     grid.order == LightNodeOrder::slices ? light_codec_slices : light_codec_lattice,
                     grid.grid->normal_offset, grid.estimated_error, grid.estimate, grid.priority, grid.contains,
                     content.light.bricks[grids.size()]});
  return grids;
}

RefinedPrimitive describe(const StreamedMesh& mesh, size_t region, const Primitive& source, size_t stream) {
  const MeshLayout& layout = mesh.encoded.layout;
  return {static_cast<uint32_t>(stream),
          static_cast<uint32_t>(region),
          region == 0 ? layout.vertices : 0,
          layout.regions.empty() ? layout.faces : layout.regions[region].faces,
          mesh.bounds[region],
          region == 0 ? layout.base_error : 0,
          static_cast<size_t>(source.source_mesh),
          static_cast<size_t>(source.source_primitive),
          mesh.accessors};
}

}  // namespace

void add_extensions(Document& document, const Scene& scene, const PackLight& light, const PackContent& content) {
  Json& json = document.json;
  for (size_t i = 0; i < content.meshes.size(); i++)
    for (size_t region = 0; region < content.meshes[i].primitives.size(); region++) {
      const Primitive& source = scene.primitives[static_cast<size_t>(content.meshes[i].primitives[region])];
      const RefinedPrimitive refined = describe(content.meshes[i], region, source, content.mesh_stream(i));
      json["meshes"][refined.mesh]["primitives"][refined.primitive]["extensions"][mesh_extension] = to_json(refined);
      use_extension(json, mesh_extension);
    }
  std::vector<TextureLevel> levels;
  for (size_t i = 0; i < content.images.size(); i++) {
    const auto stream = static_cast<uint32_t>(content.image_stream(i));
    const TextureParameters& parameters = content.images[i].parameters;
    if (content.images[i].is_level) {
      levels.push_back({stream, parameters.width, parameters.height});
      continue;
    }
    for (Json& texture : json["textures"])
      if (index_of(texture, "source") == content.images[i].image)
        texture["extensions"][texture_extension] = to_json(RefinedTexture{
            .stream = stream,
            .width = parameters.width,
            .height = parameters.height,
            .format = parameters.format,
            .levels = levels,
        });
    levels.clear();
  }
  if (!content.images.empty())
    use_extension(json, texture_extension);  // may move the textures: not while they are changed
  json["extensions"][grids_extension] = to_json(describe(light, content));
  use_extension(json, grids_extension);
  json["extensions"][lamps_extension] = to_json(light.lamps);
  use_extension(json, lamps_extension);
  if (content.parts) {
    const auto all_but_last = [&](const char* array) { return static_cast<uint32_t>(json[array].size() - 1); };
    const auto materials = static_cast<uint32_t>(member(json, "materials").size());
    json["extensions"][parts_extension] = to_json(PartsDescription{
        static_cast<uint32_t>(content.parts_stream()), all_but_last("nodes"), all_but_last("meshes"), materials});
    use_extension(json, parts_extension);
  }
  if (!content.environment) return;
  json["extensions"][environment_extension] = to_json(*content.environment);
  use_extension(json, environment_extension);
}

void add_pack_identity(Json& json, const PackId& id, float exposure, const Vec3d& origin) {
  json["extensions"][streams_extension] =
      to_json(PackIdentity{format_version, to_text(id), "lightwell " LIGHTWELL_VERSION, exposure, origin});
  use_extension(json, streams_extension);
}

}  // namespace lightwell
