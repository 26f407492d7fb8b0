// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/mergeable_parts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "lightwell/gltf/references.h"

namespace lightwell {
namespace {

/// Scenes of no more parts keep each a mesh of its own: the JSON of so many fits well into the opening.
constexpr size_t few_parts = 32;
/// Of the lattice that parts share: what it can have over all of them, and what the least of them has.
constexpr float steps_of_all = 1 << 20, steps_of_a_part = 1 << 10;
/// Of no more materials each keeps its name, by which a program may look for it.
constexpr size_t few_materials = 64;
/// Fewer parts for a primitive, in the mean, spare too little for what is lost: each a mesh that a program can address.
constexpr size_t parts_of_a_primitive = 2;
/// A part of more vertices is refined by itself: its stream costs little beside them.
constexpr size_t many_vertices = size_t(1) << 16;
/// Vertices that take about as many bytes as a stream, and a mesh in the JSON; and as a node there.
constexpr size_t vertices_of_a_stream = 200, vertices_of_a_node = 50;

/// The nodes that something moves, marks or tells apart.
std::vector<bool> own_nodes(const Json& json, std::span<const ClientLamp> lamps) {
  const Json& nodes = member(json, "nodes");
  std::vector<bool> own(nodes.size());
  for (size_t i = 0; i < nodes.size(); i++)
    own[i] = !member(nodes[i], "extensions").empty() || nodes[i].contains("skin");
  const auto mark = [&](int64_t node) {
    if (node >= 0 && node < static_cast<int64_t>(own.size())) own[static_cast<size_t>(node)] = true;
  };
  for_each_reference(json, "nodes", [&](const Json& value, std::string_view, const ReferencePlace& place) {
    if (place.pattern() != "scenes[].nodes[]" && place.pattern() != "nodes[].children[]") mark(whole_number(value));
  });
  for (const ClientLamp& lamp : lamps) mark(lamp.luminaire.node);
  return own;
}

/// Calls `visit` with every node of a scene, and whether one of `own` is on the way to it or is it; parents first.
template <typename Visit>
void walk(const Json& json, size_t scene, const std::vector<bool>& own, const Visit& visit) {
  std::vector<std::pair<size_t, bool>> open;
  const auto push = [&](const Json& nodes, bool below_own) {
    for (const Json& node : nodes) open.emplace_back(static_cast<size_t>(whole_number(node)), below_own);
  };
  push(member(element(member(json, "scenes"), scene), "nodes"), false);
  while (!open.empty()) {
    auto [node, below_own] = open.back();
    open.pop_back();
    below_own = below_own || own[node];
    visit(node, below_own);
    push(member(json["nodes"][node], "children"), below_own);
  }
}

/// The nodes of the default scene that stay where they are, parents first.
std::vector<size_t> static_nodes(const Json& json, std::span<const ClientLamp> lamps) {
  const std::vector<bool> own = own_nodes(json, lamps);
  const auto shown = static_cast<size_t>(std::max(0, index_of(json, "scene")));
  std::vector<bool> elsewhere(own.size());
  for (size_t scene = 0; scene < member(json, "scenes").size(); scene++)
    if (scene != shown) walk(json, scene, own, [&](size_t node, bool) { elsewhere[node] = true; });
  std::vector<size_t> nodes;
  walk(json, shown, own, [&](size_t node, bool below_own) {
    if (!below_own && !elsewhere[node]) nodes.push_back(node);
  });
  return nodes;
}

/// Whether animations name what they move by its place in the JSON (KHR_animation_pointer), which merging changes.
bool points_by_path(const Json& json) {
  for (const Json& animation : member(json, "animations"))
    for (const Json& channel : member(animation, "channels"))
      if (!member(member(channel, "target"), "extensions").empty()) return true;
  return false;
}

/// What of the scene shows a mesh.
struct Shown {
  size_t nodes = 0;                        // in the document
  size_t primitives = 0;                   // that can be merged
  size_t instances = 0;                    // of those, by static nodes
  size_t vertices = 0, most_vertices = 0;  // of all of them, of the largest
};

bool is_plain(const Json& primitive) {
  return member(primitive, "extensions").empty() && member(primitive, "targets").empty();
}

/// Whether its texture coordinates have the fine step of packs on the 21 bits that they may have.
bool has_usual_texcoords(const Mesh& mesh) {
  constexpr float farthest = 64;
  for (const auto& set : mesh.texcoords)
    for (const Vec2f& t : set)
      if (!(std::abs(t[0]) <= farthest && std::abs(t[1]) <= farthest)) return false;
  return true;
}

std::vector<Shown> shown_meshes(const Scene& scene, const std::vector<bool>& is_static) {
  const Json& json = scene.document.json;
  std::vector<Shown> shown(member(json, "meshes").size());
  for_each_reference(json, "meshes", [&](const Json& value, std::string_view, const ReferencePlace&) {
    shown[static_cast<size_t>(whole_number(value))].nodes++;
  });
  for (const Primitive& primitive : scene.primitives) {
    const auto mesh = static_cast<size_t>(primitive.source_mesh);
    const bool plain = is_plain(json["meshes"][mesh]["primitives"][static_cast<size_t>(primitive.source_primitive)]);
    const bool blended = scene.material_of(primitive).alpha == Material::Alpha::blend;
    if (primitive.deforming || primitive.mesh.faces.empty() || !plain || blended) continue;
    if (!has_usual_texcoords(primitive.mesh)) continue;
    shown[mesh].primitives++;
    const size_t vertices = primitive.mesh.positions.size();
    shown[mesh].vertices += vertices;
    shown[mesh].most_vertices = std::max(shown[mesh].most_vertices, vertices);
  }
  for (const Instance& instance : scene.instances) {
    const Primitive& primitive = scene.primitives[static_cast<size_t>(instance.primitive)];
    if (is_static[static_cast<size_t>(instance.node)]) shown[static_cast<size_t>(primitive.source_mesh)].instances++;
  }
  return shown;
}

bool can_be_merged(const Shown& shown, const Json& mesh) {
  return is_plain(mesh) && shown.primitives > 0 && shown.primitives == member(mesh, "primitives").size() &&
         shown.instances == shown.primitives * shown.nodes && shown.most_vertices <= many_vertices &&
         (shown.vertices <= vertices_of_a_node || (shown.nodes - 1) * shown.vertices <= vertices_of_a_stream);
}

Box3f bounds_of(const Box3f& box, const Transform& to_scene) {
  Box3f bounds;
  for (int corner = 0; corner < 8; corner++) {
    Vec3f p = box.lo;
    for (int i = 0; i < 3; i++)
      if (corner >> i & 1) p[i] = box.hi[i];
    bounds.extend(to_scene.point(p));
  }
  return bounds;
}

/// The parts of a kind share a lattice, of 21 bits over all of them: what is too small for it stays by itself.
void keep_the_small(const Scene& scene, const std::vector<int>& alike, std::vector<bool>& meshes) {
  std::vector<Box3f> boxes;
  for (const Primitive& primitive : scene.primitives) boxes.push_back(primitive.mesh.bounds());
  std::map<PartKind, Box3f> extents;
  const auto each_part = [&](const auto& visit) {
    for (const Instance& instance : scene.instances) {
      const auto index = static_cast<size_t>(instance.primitive);
      const Primitive& primitive = scene.primitives[index];
      const auto mesh = static_cast<size_t>(primitive.source_mesh);
      if (meshes[mesh]) visit(mesh, kind_of(primitive, alike), bounds_of(boxes[index], instance.to_scene));
    }
  };
  each_part([&](size_t, const PartKind& kind, const Box3f& box) { extents[kind].extend(box); });
  std::vector<bool> small(meshes.size());
  each_part([&](size_t mesh, const PartKind& kind, const Box3f& box) {
    if (!(max_component(box.size()) * steps_of_all >= max_component(extents[kind].size()) * steps_of_a_part))
      small[mesh] = true;
  });
  for (size_t mesh = 0; mesh < meshes.size(); mesh++)
    if (small[mesh]) meshes[mesh] = false;
}

std::vector<int> alike_materials(const Json& json) {
  std::map<std::string, int> first;
  std::vector<int> alike;
  const Json& materials = member(json, "materials");
  for (Json material : materials) {
    if (materials.size() > few_materials) {
      material.erase("name");
      material.erase("extras");
    }
    alike.push_back(first.emplace(json_text(material), static_cast<int>(alike.size())).first->second);
  }
  return alike;
}

/// A mesh none of whose primitives has another of its kind gains nothing; nor do parts of nearly as many kinds.
void keep_those_alone(const Scene& scene, const std::vector<int>& alike, std::vector<bool>& meshes) {
  std::map<PartKind, size_t> parts;
  size_t all = 0;
  const auto merged = [&](const Primitive& primitive) { return meshes[static_cast<size_t>(primitive.source_mesh)]; };
  for (const Instance& instance : scene.instances) {
    const Primitive& primitive = scene.primitives[static_cast<size_t>(instance.primitive)];
    if (!merged(primitive)) continue;
    parts[kind_of(primitive, alike)]++;
    all++;
  }
  const bool many = all > few_parts && all >= parts_of_a_primitive * parts.size();
  std::vector<bool> gain(meshes.size());
  for (const Primitive& primitive : scene.primitives)
    if (many && merged(primitive) && parts[kind_of(primitive, alike)] > 1)
      gain[static_cast<size_t>(primitive.source_mesh)] = true;
  meshes = gain;
}

}  // namespace

unsigned attributes_of(const Mesh& mesh) {
  return (mesh.normals.empty() ? 0u : 1u) | (mesh.texcoords[0].empty() ? 0u : 2u) |
         (mesh.texcoords[1].empty() ? 0u : 4u) | (mesh.colors.empty() ? 0u : 8u);
}

PartKind kind_of(const Primitive& primitive, const std::vector<int>& alike) {
  return {primitive.material < 0 ? -1 : alike[static_cast<size_t>(primitive.material)], attributes_of(primitive.mesh)};
}

MergeableParts mergeable_parts(const Scene& scene, std::span<const ClientLamp> lamps) {
  const Json& json = scene.document.json;
  const std::vector<size_t> fixed = static_nodes(json, lamps);
  std::vector<bool> is_static(member(json, "nodes").size());
  for (const size_t node : fixed) is_static[node] = true;

  MergeableParts parts;
  const std::vector<Shown> shown = shown_meshes(scene, is_static);
  const bool pointed = points_by_path(json);
  for (size_t mesh = 0; mesh < shown.size(); mesh++)
    parts.meshes.push_back(!pointed && can_be_merged(shown[mesh], json["meshes"][mesh]));
  parts.alike = alike_materials(json);
  keep_the_small(scene, parts.alike, parts.meshes);
  keep_those_alone(scene, parts.alike, parts.meshes);

  parts.nodes.resize(is_static.size());
  for (size_t i = fixed.size(); i-- > 0;) {  // children before their parents
    const Json& node = json["nodes"][fixed[i]];
    const int mesh = index_of(node, "mesh");
    const Json& children = member(node, "children");
    const bool holds = mesh >= 0 ? parts.meshes[static_cast<size_t>(mesh)] : !children.empty();
    parts.nodes[fixed[i]] = holds && !node.contains("camera") && std::ranges::all_of(children, [&](const Json& child) {
                              return parts.nodes[static_cast<size_t>(whole_number(child))];
                            });
  }
  return parts;
}

}  // namespace lightwell
