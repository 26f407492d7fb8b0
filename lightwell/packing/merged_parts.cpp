// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/merged_parts.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "lightwell/gltf/references.h"
#include "lightwell/packing/mergeable_parts.h"
#include "lightwell/packing/primitive_arrays.h"

namespace lightwell {
namespace {

/// New numbers that put what goes behind what stays.
struct Renumbering {
  std::vector<int> numbers;
  int staying = 0;

  explicit Renumbering(const std::vector<bool>& goes) : numbers(goes.size()) {
    int next = 0;
    for (const bool wanted : {false, true}) {
      for (size_t i = 0; i < goes.size(); i++)
        if (goes[i] == wanted) numbers[i] = next++;
      if (!wanted) staying = next;
    }
  }
  int operator()(int old) const { return old < 0 ? old : numbers[static_cast<size_t>(old)]; }
};

void renumber(Json& json, const char* array, const Renumbering& renumbering) {
  for_each_reference(json, array, [&](Json& value, std::string_view, const ReferencePlace&) {
    value = renumbering(static_cast<int>(whole_number(value)));
  });
}

/// Puts an array of the document into its new order, and moves what goes from it to `gone`.
void take_out(Json& json, const char* array, const Renumbering& renumbering, Json& gone) {
  Json ordered = Json::array();
  Json& old = json[array];
  std::vector<Json> placed(old.size());
  for (size_t i = 0; i < old.size(); i++) placed[static_cast<size_t>(renumbering.numbers[i])] = std::move(old[i]);
  for (size_t i = 0; i < placed.size(); i++)
    (static_cast<int>(i) < renumbering.staying ? ordered : gone).push_back(std::move(placed[i]));
  old = std::move(ordered);
}

/// Takes what has gone from a list of nodes, and notes where it was.
void take_from(Json& owner, const char* list, int parent, int staying, Json& roots) {
  Json left = Json::array();
  for (const Json& node : member(owner, list)) {
    if (whole_number(node) < staying)
      left.push_back(node);
    else
      roots.push_back({node, parent});
  }
  owner[list] = std::move(left);
  if (owner[list].empty()) owner.erase(list);
}

class Merger {
 public:
  Merger(Scene& scene, std::vector<ClientLamp>& lamps, std::set<std::string>& lost)
      : scene_(scene), lamps_(lamps), lost_(lost) {}

  std::optional<MergedParts> merge() {
    const MergeableParts parts = mergeable_parts(scene_, lamps_);
    if (std::ranges::none_of(parts.meshes, [](bool merged) { return merged; })) return std::nullopt;
    merge_primitives(parts);
    const Renumbering nodes(parts.nodes), meshes(parts.meshes), materials(materials_that_go(parts));
    take_arrays_of_what_goes(parts.meshes);
    renumber(json(), "nodes", nodes);
    renumber(json(), "meshes", meshes);
    renumber(json(), "materials", materials);
    if (materials.staying < static_cast<int>(materials.numbers.size()))
      take_out(json(), "materials", materials, merged_.file.materials);
    take_out(json(), "nodes", nodes, merged_.file.nodes);
    take_out(json(), "meshes", meshes, merged_.file.meshes);
    take_references(nodes.staying, meshes.staying);
    for (PartsFile::Merged& of_kind : merged_.file.merged)
      for (PartsFile::Part& part : of_kind.parts) part.node = static_cast<uint32_t>(nodes(static_cast<int>(part.node)));
    for (ClientLamp& lamp : lamps_) lamp.luminaire.node = nodes(lamp.luminaire.node);
    for (Lamp& lamp : scene_.lamps) lamp.node = nodes(lamp.node);
    for (Instance& instance : scene_.instances) instance.node = nodes(instance.node);
    drop(parts.meshes);
    for (Primitive& primitive : scene_.primitives) primitive.source_mesh = meshes(primitive.source_mesh);
    for (auto* primitives : {&scene_.primitives, &primitives_})
      for (Primitive& primitive : *primitives) primitive.material = materials(primitive.material);
    std::vector<Material> ordered(scene_.materials.size());
    for (size_t i = 0; i < ordered.size(); i++)
      ordered[static_cast<size_t>(materials.numbers[i])] = std::move(scene_.materials[i]);
    scene_.materials = std::move(ordered);
    show(nodes.staying, meshes.staying);
    return std::move(merged_);
  }

 private:
  Json& json() { return scene_.document.json; }

  /// Puts every part into the mesh of its kind.
  void merge_primitives(const MergeableParts& parts) {
    std::map<PartKind, size_t> kinds;
    for (const Instance& instance : scene_.instances) {
      const Primitive& primitive = scene_.primitives[static_cast<size_t>(instance.primitive)];
      if (!parts.meshes[static_cast<size_t>(primitive.source_mesh)]) continue;
      const auto [kind, is_new] = kinds.emplace(kind_of(primitive, parts.alike), kinds.size());
      if (is_new) {
        primitives_.push_back({{}, kind->first.first, -1, static_cast<int>(kind->second)});
        merged_.meshes.emplace_back();
        merged_.file.merged.emplace_back();
      }
      append(primitive.mesh, instance.to_scene, kind->second);
      merged_.file.merged[kind->second].parts.push_back(
          {static_cast<uint32_t>(instance.node), static_cast<uint32_t>(primitive.source_primitive)});
    }
  }

  /// Those that only what goes has, and for which another stands.
  std::vector<bool> materials_that_go(const MergeableParts& parts) {
    std::vector<bool> goes(parts.alike.size());
    for (const Primitive& primitive : scene_.primitives)
      if (primitive.material >= 0 && parts.meshes[static_cast<size_t>(primitive.source_mesh)]) {
        const auto material = static_cast<size_t>(primitive.material);
        goes[material] = parts.alike[material] != primitive.material;
      }
    Json staying = {{"meshes", Json::array()}};
    for (size_t i = 0; i < parts.meshes.size(); i++)
      if (!parts.meshes[i]) staying["meshes"].push_back(json()["meshes"][i]);
    for_each_reference(std::as_const(staying), "materials",
                       [&](const Json& value, std::string_view, const ReferencePlace&) {
                         goes[static_cast<size_t>(whole_number(value))] = false;
                       });
    return goes;
  }

  void append(const Mesh& part, const Transform& to_scene, size_t kind) {
    Mesh& mesh = primitives_[kind].mesh;
    MergedMesh& merged = merged_.meshes[kind];
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    const auto number = static_cast<uint32_t>(merged_.file.merged[kind].parts.size());
    Box3f bounds;
    for (const Vec3f& p : part.positions) {
      mesh.positions.push_back(to_scene.point(p));
      bounds.extend(mesh.positions.back());
      merged.part_of_vertex.push_back(number);
    }
    for (const Vec3f& n : part.normals) mesh.normals.push_back(to_scene.normal(n));
    for (size_t set = 0; set < 2; set++)
      mesh.texcoords[set].insert(mesh.texcoords[set].end(), part.texcoords[set].begin(), part.texcoords[set].end());
    mesh.colors.insert(mesh.colors.end(), part.colors.begin(), part.colors.end());
    const bool mirrored = to_scene.determinant() < 0;
    for (const Face& f : part.faces)
      mesh.faces.push_back({first + f[0], first + f[mirrored ? 2 : 1], first + f[mirrored ? 1 : 2]});
    if (bounds.empty()) return;
    // The least part has 10 bits then.
    constexpr float largest_to_least = 16;
    const float side = max_component(bounds.size());
    sides_.resize(merged_.meshes.size());
    auto& [least, largest] = sides_[kind];
    least = std::min(least, side);
    largest = std::max(largest, side);
    merged.part_size = std::min(largest, largest_to_least * least);
  }

  void take_arrays_of_what_goes(const std::vector<bool>& goes) {
    for (const Primitive& primitive : scene_.primitives) {
      const auto mesh = static_cast<size_t>(primitive.source_mesh);
      if (!goes[mesh]) continue;
      take_arrays(
          json()["meshes"][mesh]["primitives"][static_cast<size_t>(primitive.source_primitive)],
          [&](const std::string& name) { return has_attribute(primitive.mesh, name); }, lost_);
    }
  }

  /// The references of what stays to what goes.
  void take_references(int nodes, int meshes) {
    PartsFile& file = merged_.file;
    for (int i = 0; i < nodes; i++) {
      Json& node = json()["nodes"][static_cast<size_t>(i)];
      if (node.contains("children")) take_from(node, "children", i, nodes, file.roots);
      if (index_of(node, "mesh") < meshes) continue;
      file.shown.push_back({i, node["mesh"]});
      node.erase("mesh");
    }
    take_from(default_scene(), "nodes", -1, nodes, file.roots);
  }

  Json& default_scene() { return json()["scenes"][static_cast<size_t>(std::max(0, index_of(json(), "scene")))]; }

  /// Drops the primitives and instances of what goes.
  void drop(const std::vector<bool>& goes) {
    std::vector<Primitive> primitives;
    std::vector<int> number;  // of each old primitive
    for (Primitive& primitive : scene_.primitives) {
      const bool stays = !goes[static_cast<size_t>(primitive.source_mesh)];
      number.push_back(stays ? static_cast<int>(primitives.size()) : -1);
      if (stays) primitives.push_back(std::move(primitive));
    }
    std::erase_if(scene_.instances, [&](const Instance& i) { return number[static_cast<size_t>(i.primitive)] < 0; });
    for (Instance& instance : scene_.instances) instance.primitive = number[static_cast<size_t>(instance.primitive)];
    merged_.first_primitive = primitives.size();
    scene_.primitives = std::move(primitives);
  }

  /// Adds the merged mesh and the node that shows it.
  void show(int nodes, int meshes) {
    Json mesh;
    for (Primitive& primitive : primitives_) {
      Json of_kind = Json::object();
      if (primitive.material >= 0) of_kind["material"] = primitive.material;
      mesh["primitives"].push_back(std::move(of_kind));
      primitive.source_mesh = meshes;
      scene_.instances.push_back({static_cast<int>(scene_.primitives.size()), {}, nodes});
      scene_.primitives.push_back(std::move(primitive));
    }
    json()["meshes"].push_back(std::move(mesh));
    Json node = {{"mesh", meshes}};
    if (scene_.origin != Vec3d{}) node["translation"] = scene_.origin.e;
    json()["nodes"].push_back(std::move(node));
    default_scene()["nodes"].push_back(nodes);
  }

  Scene& scene_;
  std::vector<ClientLamp>& lamps_;
  std::set<std::string>& lost_;
  MergedParts merged_;
  struct Sides {
    float least = std::numeric_limits<float>::infinity(), largest = 0;
  };
  std::vector<Primitive> primitives_;  ///< of the merged mesh, by kind
  std::vector<Sides> sides_;           ///< of its parts, by kind
};

}  // namespace

std::optional<MergedParts> merge_parts(Scene& scene, std::vector<ClientLamp>& lamps, std::set<std::string>& lost) {
  return Merger(scene, lamps, lost).merge();
}

}  // namespace lightwell
