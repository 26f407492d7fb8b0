// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/import_gltf.h"

#include <charconv>
#include <map>
#include <set>

#include "lightwell/gltf/accessor.h"
#include "lightwell/scene/import_gltf_light.h"
#include "lightwell/scene/import_gltf_material.h"

namespace lightwell {
namespace {

constexpr size_t max_instances = size_t(1) << 22;
constexpr size_t max_faces = size_t(1) << 27;

/// The expansion that a document's bytes are allowed, so that a small file that uses the same data again and again does
/// not fill the memory: a corner or an instance takes a byte or more, and some may be shared.
struct Allowance {
  size_t corners = 0;
  size_t instances = 0;

  explicit Allowance(const Document& document) {
    size_t bytes = 0;
    for (const auto& buffer : document.buffers) bytes += buffer.size();
    corners = (size_t(1) << 25) + bytes;
    instances = std::min(max_instances, (size_t(1) << 16) + bytes);
  }
};

/// Counts occurrences that share one warning.
struct Tally {
  size_t count = 0;
  std::string first;

  void add(const std::string& name) {
    if (count++ == 0) first = name;
  }
  void warn(Report& report, const std::string& text) const {
    if (count > 0) report.warn(first + (count > 1 ? " and " + std::to_string(count - 1) + " more" : "") + ": " + text);
  }
};

/// A node that shows a mesh, once for each of its instances.
struct MeshUse {
  int mesh = 0;
  int node = 0;
  bool animated = false;  ///< it or a node above it moves
  bool skinned = false;
  std::vector<Transform> to_scene;
};

Transform scaled_rotation(const Vec3d& scale, const Vec<double, 4>& rotation, const Vec3d& translation) {
  const Vec<double, 4> q = length(rotation) > 0 ? normalized(rotation) : Vec<double, 4>{{0, 0, 0, 1}};
  return Transform::translation(translation) * Transform::rotation(q) * Transform::scaling(scale);
}

Transform local_transform(const Json& node) {
  if (node.contains("matrix")) {
    const auto m = numbers<16>(node, "matrix", {});
    return {{{m[0], m[1], m[2]}}, {{m[4], m[5], m[6]}}, {{m[8], m[9], m[10]}}, {{m[12], m[13], m[14]}}};
  }
  return scaled_rotation(numbers<3>(node, "scale", Vec3d::filled(1)), numbers<4>(node, "rotation", {{0, 0, 0, 1}}),
                         numbers<3>(node, "translation", {}));
}

/// True when a map takes volume to nothing, or beyond what floats hold. The threshold is what double precision leaves
/// of a hierarchy whose exact product would be singular.
bool flattens(const Transform& m) {
  constexpr double largest = 1e30;
  const double sizes = length(m.x) * length(m.y) * length(m.z);
  return !(std::abs(m.determinant()) > 1e-9 * sizes) || !(sizes < largest) || !(length(m.t) < largest);
}

/// The nodes that an animation moves directly.
std::set<int> animated_nodes(const Json& json) {
  std::set<int> nodes;
  for (const Json& animation : member(json, "animations"))
    for (const Json& channel : member(animation, "channels")) {
      const Json& target = member(channel, "target");
      if (text(target, "path") != "weights") nodes.insert(index_of(target, "node"));
      const std::string pointer = text(extension(target, "KHR_animation_pointer"), "pointer");
      constexpr std::string_view prefix = "/nodes/";
      int node = -1;
      if (pointer.starts_with(prefix))
        std::from_chars(pointer.data() + prefix.size(), pointer.data() + pointer.size(), node);
      nodes.insert(node);
    }
  return nodes;
}

/// Builds a Scene from a document: walks the nodes first, then reads the meshes that they show.
class Importer {
 public:
  Importer(Document document, std::string name, Report& report) : report_(report), allowed_(document) {
    scene_.document = std::move(document);
    scene_.name = std::move(name);
  }

  Result<Scene> import() {
    const Json& json = scene_.document.json;
    scene_.materials = read_materials(json, report_);
    scene_.images = read_images(scene_.document, report_);
    LW_CHECK(walk_nodes());
    LW_CHECK(place_meshes());
    flat_.warn(report_, "its transform flattens what it holds; left out of the bake");
    hidden_.warn(report_, "is not visible (KHR_node_visibility); left out of the bake");
    animated_.warn(report_, "is animated; left out of the bake");
    deforming_.warn(report_, "is skinned or morphed; copied as it is and left out of the bake");
    undrawable_.warn(report_, "has no triangles; copied as it is and left out of the bake");
    return std::move(scene_);
  }

 private:
  struct Visit {
    int node;
    Transform parent;
    bool animated;
  };

  Result<void> walk_nodes() {
    const Json& json = scene_.document.json;
    const Json& scenes = member(json, "scenes");
    const Json& shown = element(scenes, static_cast<size_t>(std::max(0, index_of(json, "scene"))));
    if (shown.is_null()) report_.warn("the document has no scene: nothing is shown");
    scene_.environment = read_environment(shown);
    moving_ = animated_nodes(json);
    std::vector<Visit> open;  // a stack of our own: node trees may be deeper than the program's
    const auto push = [&](const Json& nodes, const Transform& parent, bool animated) {
      for (size_t i = nodes.size(); i-- > 0;)
        open.push_back({static_cast<int>(whole_number(nodes[i])), parent, animated});
    };
    push(member(shown, "nodes"), Transform(), false);
    while (!open.empty()) {
      const Visit visit = open.back();
      open.pop_back();
      const Json& node = element(member(json, "nodes"), static_cast<size_t>(visit.node));
      if (!boolean(extension(node, "KHR_node_visibility"), "visible", true)) {
        hidden_.add(element_name("nodes", static_cast<size_t>(visit.node)));
        continue;
      }
      const Transform to_scene = visit.parent * local_transform(node);
      const bool animated = visit.animated || moving_.contains(visit.node);
      LW_CHECK(visit_node(node, visit.node, to_scene, animated));
      push(member(node, "children"), to_scene, animated);
    }
    return {};
  }

  Result<void> visit_node(const Json& node, int index, const Transform& to_scene, bool animated) {
    const bool shows =
        node.contains("mesh") || node.contains("camera") || extension(node, "KHR_lights_punctual").is_object();
    if (!shows) return {};
    if (flattens(to_scene)) {
      flat_.add(element_name("nodes", static_cast<size_t>(index)));
      return {};
    }
    const Json& json = scene_.document.json;
    if (auto lamp = read_lamp(json, index, to_scene)) scene_.lamps.push_back(std::move(*lamp));
    if (auto camera = read_camera(json, index, to_scene, report_)) scene_.cameras.push_back(std::move(*camera));
    if (!node.contains("mesh")) return {};
    MeshUse use{index_of(node, "mesh"), index, animated, node.contains("skin"), {to_scene}};
    if (const Json& instancing = extension(node, "EXT_mesh_gpu_instancing"); instancing.is_object()) {
      LW_TRY(transforms, instance_transforms(instancing, to_scene, element_name("nodes", static_cast<size_t>(index))));
      use.to_scene = std::move(transforms);
    }
    uses_.push_back(std::move(use));
    return {};
  }

  /// The attributes of EXT_mesh_gpu_instancing as one transform an instance. Flattened ones are left out.
  Result<std::vector<Transform>> instance_transforms(const Json& instancing, const Transform& node,
                                                     const std::string& name) {
    std::vector<Vec3f> translations, scales;
    std::vector<Vec4f> rotations;
    LW_CHECK(read_instances<3>(instancing, "TRANSLATION", translations, name));
    LW_CHECK(read_instances<4>(instancing, "ROTATION", rotations, name));
    LW_CHECK(read_instances<3>(instancing, "SCALE", scales, name));
    const size_t count = std::max({translations.size(), rotations.size(), scales.size()});
    if ((!translations.empty() && translations.size() != count) || (!rotations.empty() && rotations.size() != count) ||
        (!scales.empty() && scales.size() != count))
      return fail(name + ".EXT_mesh_gpu_instancing", "its attributes have different counts");
    placed_ += count;
    if (placed_ > allowed_.instances)
      return fail(ErrorKind::limit, name + ".EXT_mesh_gpu_instancing", "places more than the file can hold");
    std::vector<Transform> transforms;
    for (size_t i = 0; i < count; i++) {
      const Transform local =
          scaled_rotation(scales.empty() ? Vec3d::filled(1) : scales[i].cast<double>(),
                          rotations.empty() ? Vec<double, 4>{{0, 0, 0, 1}} : rotations[i].cast<double>(),
                          translations.empty() ? Vec3d{} : translations[i].cast<double>());
      if (flattens(node * local))
        flat_.add(name);
      else
        transforms.push_back(node * local);
    }
    return transforms;
  }

  template <int N>
  Result<void> read_instances(const Json& instancing, const char* semantic, std::vector<Vec<float, N>>& values,
                              const std::string& name) {
    const int accessor = index_of(member(instancing, "attributes"), semantic);
    if (accessor < 0) return {};
    auto data = locate(scene_.document, accessor);
    if (!data) return fail(in_element(data.error(), name + ".EXT_mesh_gpu_instancing." + semantic));
    if (data->type.rows != N || data->type.columns != 1 || data->count > max_instances)
      return fail(name + ".EXT_mesh_gpu_instancing." + semantic, "is of a type or count that it cannot have");
    values = read_vectors<N>(*data);
    return {};
  }

  Result<void> place_meshes() {
    std::map<int, std::vector<const MeshUse*>> by_mesh;
    for (const MeshUse& use : uses_) by_mesh[use.mesh].push_back(&use);
    for (const auto& [mesh, uses] : by_mesh) LW_CHECK(count_corners(mesh));
    for (const auto& [mesh, uses] : by_mesh) LW_CHECK(place_mesh(mesh, uses));
    return {};
  }

  /// Fails before anything is read when there is more than the file can hold.
  Result<void> count_corners(int mesh) {
    const Json& json = scene_.document.json;
    for (const Json& primitive : member(json["meshes"][static_cast<size_t>(mesh)], "primitives")) {
      int accessor = index_of(primitive, "indices");
      if (accessor < 0) accessor = index_of(member(primitive, "attributes"), "POSITION");
      if (accessor < 0) continue;
      const Json& corners = element(member(json, "accessors"), static_cast<size_t>(accessor));
      corners_ += static_cast<size_t>(std::max(0.0, number(corners, "count", 0)));
      if (corners_ > allowed_.corners)
        return fail(element_name("meshes", static_cast<size_t>(mesh)),
                    "the scene has more corners than the file can hold");
    }
    return {};
  }

  Result<void> place_mesh(int mesh, const std::vector<const MeshUse*>& uses) {
    bool skinned = false, all_animated = true;
    for (const MeshUse* use : uses) {
      skinned |= use->skinned;
      all_animated &= use->animated;
      if (use->animated) animated_.add(element_name("nodes", static_cast<size_t>(use->node)));
    }
    const std::string mesh_name = element_name("meshes", static_cast<size_t>(mesh));
    const Json& primitives = scene_.document.json["meshes"][static_cast<size_t>(mesh)]["primitives"];
    for (size_t p = 0; p < primitives.size(); p++) {
      const std::string name = mesh_name + "." + element_name("primitives", p);
      if (!has_triangles(primitives[p]) || !member(primitives[p], "attributes").contains("POSITION")) {
        undrawable_.add(name);
        continue;
      }
      LW_TRY(read, read_primitive(scene_.document, mesh, static_cast<int>(p), report_));
      const bool deforms = skinned || !member(primitives[p], "targets").empty();
      if (deforms) deforming_.add(name);
      const int material = index_of(primitives[p], "material");
      scene_.primitives.push_back({std::move(read), material, mesh, static_cast<int>(p), deforms || all_animated});
      faces_ += scene_.primitives.back().mesh.faces.size();
      if (faces_ > max_faces)
        return fail(ErrorKind::limit, name, "the scene has more than " + std::to_string(max_faces) + " triangles");
      if (!deforms) LW_CHECK(place_instances(uses));
    }
    return {};
  }

  /// Places the primitive that was read last where nothing moves it.
  Result<void> place_instances(const std::vector<const MeshUse*>& uses) {
    for (const MeshUse* use : uses) {
      if (use->animated) continue;
      if (scene_.instances.size() + use->to_scene.size() > max_instances)
        return fail(ErrorKind::limit, "nodes", "place more than " + std::to_string(max_instances) + " instances");
      for (const Transform& transform : use->to_scene)
        scene_.instances.push_back({static_cast<int>(scene_.primitives.size()) - 1, transform, use->node});
    }
    return {};
  }

  Scene scene_;
  Report& report_;
  std::set<int> moving_;
  std::vector<MeshUse> uses_;
  Allowance allowed_;
  size_t faces_ = 0, corners_ = 0, placed_ = 0;
  Tally flat_, hidden_, animated_, deforming_, undrawable_;
};

/// "a, b and 3 more".
std::string list_of(const std::vector<std::string>& names) {
  constexpr size_t most = 5;
  std::string list;
  for (size_t i = 0; i < std::min(names.size(), most); i++) list += (i > 0 ? ", " : "") + names[i].substr(0, 80);
  if (names.size() > most) list += " and " + std::to_string(names.size() - most) + " more";
  return list;
}

}  // namespace

Result<void> choose_scene(Document& document, const std::string& choice, Report& report) {
  Json& json = document.json;
  const Json& scenes = member(json, "scenes");
  const auto name = [&](size_t i) {
    const std::string given = text(scenes[i], "name");
    return given.empty() ? std::to_string(i) : '"' + given + '"';
  };
  std::vector<std::string> names;
  for (size_t i = 0; i < scenes.size(); i++) names.push_back(name(i));
  size_t shown = static_cast<size_t>(std::max(0, index_of(json, "scene")));
  if (!choice.empty()) {
    shown = 0;
    while (shown < scenes.size() && text(scenes[shown], "name") != choice && std::to_string(shown) != choice) shown++;
    if (shown == scenes.size())
      return fail("scene " + choice.substr(0, 80),
                  names.empty() ? "there is none in the file" : "is not in the file, which has " + list_of(names));
    json["scene"] = shown;
  }
  if (names.size() < 2 || shown >= names.size()) return {};
  const std::string chosen = names[shown];
  names.erase(names.begin() + static_cast<std::ptrdiff_t>(shown));
  report.warn("scene " + chosen + " is shown, not " + list_of(names) + "; --scene chooses");
  return {};
}

Result<Scene> scene_from_document(Document document, std::string name, Report& report) {
  return Importer(std::move(document), std::move(name), report).import();
}

}  // namespace lightwell
