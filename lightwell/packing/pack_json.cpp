// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/pack_json.h"

#include <algorithm>

#include "lightwell/light/stream.h"

namespace lightwell {
namespace {

Json to_json(int32_t x) { return x; }
Json to_json(float x) { return shortest(x); }

template <typename T, int N>
Json to_json(const Vec<T, N>& v) {
  Json array = Json::array();
  for (const T x : v.e) array.push_back(to_json(x));
  return array;
}

void use_extension(Json& json, const char* name) {
  Json& used = json["extensionsUsed"];
  if (std::find(used.begin(), used.end(), name) == used.end()) used.push_back(name);
}

const char* name_of(ClientLamp::Kind kind) {
  switch (kind) {
    case ClientLamp::Kind::rectangle: return "rectangle";
    case ClientLamp::Kind::sphere: return "sphere";
    case ClientLamp::Kind::point: return "point";
    case ClientLamp::Kind::spot: return "spot";
    case ClientLamp::Kind::sun: return "sun";
  }
  return "";
}

Json lamp_json(const ClientLamp& lamp) {
  using Kind = ClientLamp::Kind;
  Json json{{"kind", name_of(lamp.kind)}};
  if (!lamp.name.empty()) json["name"] = lamp.name;
  if (lamp.kind != Kind::sun) json["center"] = to_json(lamp.center);
  if (lamp.kind != Kind::point && lamp.kind != Kind::sphere) json["normal"] = to_json(lamp.normal);
  if (lamp.kind == Kind::rectangle) {
    json["u"] = to_json(lamp.half_u);
    json["v"] = to_json(lamp.half_v);
    if (lamp.two_sided) json["twoSided"] = true;
  }
  if (lamp.kind == Kind::sphere) json["radius"] = to_json(lamp.radius);
  if (lamp.kind == Kind::rectangle || lamp.kind == Kind::sphere)
    json["radiance"] = to_json(lamp.radiance);
  else
    json["intensity"] = to_json(lamp.intensity);
  if (lamp.range > 0) json["range"] = to_json(lamp.range);
  if (lamp.kind == Kind::spot) {
    json["innerConeAngle"] = to_json(lamp.inner_cone);
    json["outerConeAngle"] = to_json(lamp.outer_cone);
  }
  if (lamp.node >= 0) json["node"] = lamp.node;
  if (lamp.primitive >= 0) json["primitive"] = lamp.primitive;
  return json;
}

Json grid_json(const PackLight& light) {
  const GridShape& shape = light.grid->shape;
  Json contains = {"indirect"};
  if (light.contains_environment) contains.push_back("environment");
  if (light.contains_lamps) contains.push_back("lamps");
  return {{"stream", 0},
          {"min", to_json(shape.lo)},
          {"cell", to_json(shape.cell)},
          {"nodes", to_json(shape.nodes)},
          {"codec", light_codec_slices},
          {"normalOffset", to_json(light.grid->normal_offset)},
          {"estimatedError", to_json(light.estimated_error)},
          {"priority", 0},
          {"contains", std::move(contains)}};
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
  json["extensions"]["LIGHTWELL_light_grids"]["grids"] = Json::array({grid_json(light)});
  use_extension(json, "LIGHTWELL_light_grids");
  Json& lamps = json["extensions"]["LIGHTWELL_lamps"]["lamps"] = Json::array();
  for (const ClientLamp& lamp : light.lamps) lamps.push_back(lamp_json(lamp));
  use_extension(json, "LIGHTWELL_lamps");
}

void add_pack_identity(Json& json, const PackId& id, float exposure) {
  json["extensions"]["LIGHTWELL_streams"] = {{"version", format_version},
                                             {"id", to_text(id)},
                                             {"generator", "lightwell " LIGHTWELL_VERSION},
                                             {"exposure", to_json(exposure)}};
  use_extension(json, "LIGHTWELL_streams");
}

}  // namespace lightwell
