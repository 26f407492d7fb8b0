// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/pack_scene.h"

#include <algorithm>
#include <set>
#include <span>

#include "lightwell/asset/parts_asset.h"
#include "lightwell/mesh/base_places.h"
#include "lightwell/pack/self_contained.h"
#include "lightwell/packing/lamps_extension.h"
#include "lightwell/packing/pack_json.h"
#include "lightwell/packing/pack_lamps.h"
#include "lightwell/packing/primitive_arrays.h"

namespace lightwell {
namespace {

Json& primitive_json(Json& json, const Primitive& primitive) {
  return json["meshes"][static_cast<size_t>(primitive.source_mesh)]["primitives"]
             [static_cast<size_t>(primitive.source_primitive)];
}

// What a primitive shows in the opening: the coarsest level when it is streamed, else the whole mesh.
struct Shown {
  const Mesh* mesh = nullptr;
  StreamedMesh* streamed = nullptr;

  bool is_region() const { return streamed && streamed->primitives.size() > 1; }
  bool has(const std::string& name) const {
    return has_attribute(*mesh, name) ||
           (streamed && streamed->deforming && streamed->deforming->deformation.has(name));
  }
};

// The arrays of a mesh whose primitives share all but their indices, which follow one another.
void give_arrays_of_regions(Document& document, const Scene& scene, const StreamedMesh& mesh) {
  const Mesh& base = mesh.encoded.base;
  DocumentBuilder builder(document);
  const Json attributes = builder.vertices(base);
  auto first = base.faces.begin();
  for (size_t i = 0; i < mesh.primitives.size(); i++) {
    const auto end = first + static_cast<ptrdiff_t>(mesh.encoded.layout.regions[i].base_faces);
    Json& json = primitive_json(document.json, scene.primitives[static_cast<size_t>(mesh.primitives[i])]);
    json["attributes"] = attributes;
    json["indices"] = builder.indices({first, end}, base.positions.size());
    first = end;
  }
}

Result<void> give_arrays(Document& document, const Primitive& primitive, const Shown& shown) {
  const Json arrays = DocumentBuilder(document).primitive(*shown.mesh);
  primitive_json(document.json, primitive).update(arrays);
  if (!shown.streamed || !shown.streamed->deforming) return {};
  StreamedMesh& streamed = *shown.streamed;
  streamed.accessors = streamed.deforming->deformation.write(document, streamed.deforming->rows);
  LW_TRY(base, prefix_of(*streamed.accessors, shown.mesh->positions.size(), document));
  bend_by(base, primitive_json(document.json, primitive));
  return {};
}

// Replaces the arrays of every mesh by those of the opening; what deforms and is not streamed keeps the file's. The old
// arrays go first: of scenes of very many parts the JSON is most of the memory.
Result<void> shrink_meshes(const Scene& scene, std::vector<StreamedMesh>& streamed, Document& document,
                           std::set<std::string> lost, Report& report) {
  std::vector<Shown> shown(scene.primitives.size());
  for (size_t i = 0; i < shown.size(); i++) shown[i].mesh = &scene.primitives[i].mesh;
  for (StreamedMesh& mesh : streamed)
    for (const int primitive : mesh.primitives) shown[static_cast<size_t>(primitive)] = {&mesh.encoded.base, &mesh};
  const auto replaced = [&](size_t i) {
    return (!scene.primitives[i].deforming || shown[i].streamed) && !shown[i].mesh->faces.empty();
  };
  for (size_t i = 0; i < shown.size(); i++)
    if (replaced(i))
      take_arrays(
          primitive_json(document.json, scene.primitives[i]),
          [&](const std::string& name) { return shown[i].has(name); }, lost);
  drop_unused(document);
  for (size_t i = 0; i < shown.size(); i++)
    if (replaced(i) && !shown[i].is_region()) LW_CHECK(give_arrays(document, scene.primitives[i], shown[i]));
  for (const StreamedMesh& mesh : streamed)
    if (mesh.primitives.size() > 1) give_arrays_of_regions(document, scene, mesh);
  std::string names;
  for (const std::string& name : lost)
    if (names.size() < 400) names += (names.empty() ? "" : ", ") + name;
  if (!lost.empty()) report.warn("vertex attributes left out, not supported: " + names);
  return {};
}

// Replaces references to texture coordinate sets that Mesh does not support by set 0, as the import does.
void use_known_texcoords(Json& json) {
  constexpr int sets = 2;
  if (json.is_object() && index_of(json, "texCoord") >= sets) json.erase("texCoord");
  for (auto& [name, part] : json.items())
    if (part.is_structured() && name != "extras") use_known_texcoords(part);
}

// Names an unnamed scene after its file.
void name_scene(Json& json, const std::string& name) {
  const auto shown = static_cast<size_t>(std::max(0, index_of(json, "scene")));
  if (shown >= member(json, "scenes").size()) return;
  Json& scene = json["scenes"][shown];
  if (text(scene, "name").empty()) scene["name"] = name;
}

// The offset of an accessor's first element in the BIN chunk.
uint32_t place_of(const Json& json, const Json& accessor_index) {
  if (!accessor_index.is_number()) return 0;
  const Json& accessor = json["accessors"][accessor_index.get<size_t>()];
  const Json& view = json["bufferViews"][accessor["bufferView"].get<size_t>()];
  return static_cast<uint32_t>(number(view, "byteOffset", 0) + number(accessor, "byteOffset", 0));
}

BasePlaces places_of(const Json& json, const Json& primitive) {
  const Json& attributes = primitive["attributes"];
  BasePlaces places;
  places.positions = place_of(json, member(attributes, "POSITION"));
  places.normals = place_of(json, member(attributes, "NORMAL"));
  places.texcoords = {place_of(json, member(attributes, "TEXCOORD_0")),
                      place_of(json, member(attributes, "TEXCOORD_1"))};
  places.colors = place_of(json, member(attributes, "COLOR_0"));
  places.indices = place_of(json, primitive["indices"]);
  constexpr int unsigned_short = 5123;
  places.short_indices = json["accessors"][primitive["indices"].get<size_t>()]["componentType"] == unsigned_short;
  return places;
}

PackStream mesh_stream(StreamedMesh& mesh, const Json& json, const Json& primitive) {
  PackStream stream;
  stream.kind = StreamKind::mesh;
  stream.codec = mesh.encoded.layout.regions.empty() ? mesh_codec_splits : mesh_codec_regions;
  stream.error = mesh.encoded.layout.base_error;
  ByteWriter parameters;
  mesh.encoded.layout.write(parameters);
  places_of(json, primitive).write(parameters);
  mesh.encoded.layout.write_regions(parameters);
  stream.parameters = parameters.release();
  for (MeshBlock& block : mesh.encoded.blocks)
    stream.blocks.push_back({std::move(block.payload), block.vertices, block.error});
  return stream;
}

PackStream image_stream(const StreamedImage& image) {
  PackStream stream;
  stream.kind = StreamKind::texture;
  stream.codec = texture_codec_file;
  stream.parameters = encode_texture_parameters(image.parameters);
  stream.error = 1;
  size_t left = image.file.size();
  for (const Bytes block : file_blocks(image.file)) {
    left -= block.size();
    stream.blocks.push_back({{block.begin(), block.end()},
                             static_cast<uint32_t>(block.size()),
                             static_cast<float>(left) / static_cast<float>(image.file.size())});
  }
  return stream;
}

// Without an error: nothing that is seen waits for it.
PackStream parts_stream(const PartsFile& parts) {
  PackStream stream;
  stream.kind = StreamKind::parts;
  stream.codec = parts_codec_gzip;
  PartsParameters parameters;
  const std::vector<uint8_t> file = write_parts_file(parts, parameters);
  stream.parameters = parameters.write();
  for (const Bytes block : file_blocks(file))
    stream.blocks.push_back({{block.begin(), block.end()}, static_cast<uint32_t>(block.size()), 0});
  return stream;
}

// About the bytes of the opening and the directory that meshes do not take, and of the first light, which shall come
// with them: without it the first picture is lit by the corners of the grid alone.
uint64_t rest_of_opening(const Document& document, const PackLight& light, const PackContent& content) {
  constexpr uint64_t stream_head_bytes = 28, json_of_a_grid = 400, json_of_an_image = 250;
  const auto entry = [](size_t parameters, size_t blocks) {
    return stream_head_bytes + parameters + row_bytes * std::min<size_t>(blocks, rows_per_page);
  };
  Json json = document.json;
  for (const char* array : {"meshes", "accessors", "bufferViews", "images"}) json.erase(array);
  uint64_t bytes =
      json_text(json).size() + json_text(to_json(light.lamps)).size() + json_of_a_grid * light.grids.size();
  for (const PackStream& stream : content.light.streams) {
    bytes += entry(stream.parameters.size(), stream.blocks.size());
    if (stream.kind == StreamKind::light && !stream.blocks.empty()) bytes += stream.blocks.front().payload.size();
  }
  for (const StreamedImage& image : content.images)
    bytes += entry(encode_texture_parameters(image.parameters).size(), file_blocks(image.file).size());
  for (const Json& image : member(document.json, "images")) {
    const Json& view =
        element(member(document.json, "bufferViews"), static_cast<size_t>(index_of(image, "bufferView")));
    bytes += json_of_an_image + static_cast<uint64_t>(number(view, "byteLength", 0));
  }
  return bytes;
}

OpeningBudget opening_budget(const Scene& scene, std::span<const MeshGroup> groups, const PackLight& light,
                             const PackContent& content) {
  if (content.parts) return OpeningBudget::beside(rest_of_opening(scene.document, light, content));
  size_t regions = 0;
  for (const MeshGroup& group : groups) regions += group.size();
  return OpeningBudget::of(scene.primitives.size() - regions + groups.size(), regions - groups.size(),
                           length(scene.bounds().size()));
}

void count(const Scene& scene, PackStatistics& statistics) {
  for (const Primitive& primitive : scene.primitives) {
    statistics.triangles += primitive.mesh.faces.size();
    statistics.vertices += primitive.mesh.positions.size();
  }
}

void count(const PackPlan& plan, size_t file_bytes, PackStatistics& statistics) {
  for (const StreamEntry& entry : plan.streams) switch (entry.kind) {
      case StreamKind::light:
      case StreamKind::bricks: statistics.light_bytes += entry.length; break;
      case StreamKind::mesh:
      case StreamKind::parts: statistics.geometry_bytes += entry.length; break;
      case StreamKind::texture: statistics.texture_bytes += entry.length; break;
    }
  statistics.opening_bytes = file_bytes - statistics.light_bytes - statistics.geometry_bytes - statistics.texture_bytes;
}

}  // namespace

Result<std::vector<uint8_t>> make_pack(Scene scene, const PackLight& light, const PackOptions& options,
                                       Progress& progress, Report& report, PackStatistics& statistics) {
  PackContent content;
  LW_TRY(encoded_light, encode_light(light.grids));
  content.light = std::move(encoded_light);
  PackLight stated = light;
  std::set<std::string> lost;
  // Before materials go with the parts.
  if (scene.document.json.contains("materials")) use_known_texcoords(scene.document.json["materials"]);
  content.parts = merge_parts(scene, stated.lamps, lost);
  name_scene(scene.document.json, scene.name);
  content.environment = add_environment(scene, scene.document);
  const int surroundings = content.environment ? static_cast<int>(scene.images.size()) - 1 : -1;
  content.images = shrink_images(scene, scene.document, surroundings);
  const PositionErrors errors = position_errors(scene, content.parts, options);
  const std::vector<MeshGroup> groups = mesh_groups(scene, errors.most, stated.lamps);
  const OpeningBudget budget = opening_budget(scene, groups, stated, content);
  LW_TRY(meshes, encode_meshes(scene, groups, errors.wanted, content.parts, budget, options, progress));
  content.meshes = std::move(meshes);
  progress.stage("writing", 0, "");
  Document document = std::move(scene.document);
  LW_CHECK(shrink_meshes(scene, content.meshes, document, std::move(lost), report));
  stated.lamps = lamps_of_pack(stated.lamps, scene, content.meshes);
  add_extensions(document, scene, stated, content);
  drop_unused_images(document);
  share_buffer_views(document);
  document = single_buffer(std::move(document), report);

  std::vector<PackStream> streams = std::move(content.light.streams);
  for (StreamedMesh& mesh : content.meshes) {
    const Primitive& source = scene.primitives[static_cast<size_t>(mesh.primitives[0])];
    streams.push_back(mesh_stream(mesh, document.json, primitive_json(document.json, source)));
  }
  for (const StreamedImage& image : content.images) streams.push_back(image_stream(image));
  if (content.parts) streams.push_back(parts_stream(content.parts->file));

  count(scene, statistics);
  std::vector<uint8_t> bin;
  if (!document.buffers.empty()) bin = std::move(document.buffers[0]);
  LW_TRY(writer, PackWriter::create(std::move(bin), std::move(streams)));
  add_pack_identity(document.json, writer.plan().id, light.exposure, scene.origin);
  std::string json = json_text(std::exchange(document.json, {}));
  LW_CHECK(check_self_contained(json));
  auto file = writer.finish(std::move(json));
  if (!file) return fail(file.error());
  count(writer.plan(), file->size(), statistics);
  return file;
}

}  // namespace lightwell
