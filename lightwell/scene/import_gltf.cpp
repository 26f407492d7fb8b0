// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/import_gltf.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <set>

#include "lightwell/gltf/accessor.h"
#include "lightwell/gltf/node_transform.h"
#include "lightwell/gltf/pose.h"
#include "lightwell/scene/finish_mesh.h"
#include "lightwell/scene/import_gltf_light.h"
#include "lightwell/scene/import_gltf_material.h"
#include "lightwell/scene/noted_sky.h"
#include "lightwell/scene/physical_sky.h"
#include "lightwell/scene/place.h"

namespace lightwell {
namespace {

constexpr size_t max_instances = size_t(1) << 22;
constexpr size_t max_faces = size_t(1) << 27;
/// With every instance of a face: some stages look at each of them, for hundreds of nanoseconds.
constexpr size_t max_placed_faces = size_t(1) << 31;

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
  int skin = -1;
  std::vector<double> weights;  ///< of morph targets
  std::vector<Transform> to_scene;
};

/// Squares of what is larger leave the range of floats.
constexpr double largest = 1e30;

/// True when a map takes volume to nothing, or beyond what floats hold. The threshold is what double precision leaves
/// of a hierarchy whose exact product would be singular.
bool flattens(const Transform& m) {
  const double sizes = length(m.x) * length(m.y) * length(m.z);
  return !(std::abs(m.determinant()) > 1e-9 * sizes) || !(sizes < largest) || !(length(m.t) < largest);
}

/// The nodes that are joints of a skin.
std::set<int> joint_nodes(const Json& json) {
  std::set<int> nodes;
  for (const Json& skin : member(json, "skins"))
    for (const Json& joint : member(skin, "joints")) nodes.insert(static_cast<int>(whole_number(joint)));
  return nodes;
}

/// The weights of a node's morph targets: its own, else its mesh's. Empty when all are zero.
std::vector<double> morph_weights(const Json& node, const Json& mesh) {
  std::vector<double> weights;
  const Json& own = member(node, "weights");
  for (const Json& weight : own.is_array() ? own : member(mesh, "weights"))
    weights.push_back(weight.is_number() ? weight.get<double>() : 0);
  const bool none = std::all_of(weights.begin(), weights.end(), [](double weight) { return weight == 0; });
  return none ? std::vector<double>() : weights;
}

std::string kilometres(double metres) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", metres / 1000);
  return text;
}

/// Where an instance lies.
Place place_of(const Instance& instance, const Primitive& primitive, const Box3f& box) {
  const Transform& m = instance.to_scene;
  const double stretch = std::max({length(m.x), length(m.y), length(m.z)});
  return {m.point(box.center().cast<double>()), 0.5 * length(box.size().cast<double>()) * stretch,
          static_cast<double>(primitive.mesh.faces.size())};
}

/// Builds a Scene from a document: walks the nodes first, then reads the meshes that they show.
class Importer {
 public:
  Importer(Document document, std::string name, Report& report) : report_(report), allowed_(document) {
    scene_.document = std::move(document);
    scene_.name = std::move(name);
  }

  Result<Scene> import(const std::optional<Vec3d>& origin, ImageLimit limit) {
    const Json& json = scene_.document.json;
    scene_.materials = read_materials(json, report_);
    scene_.images = read_images(scene_.document, limit, report_);
    joint_nodes_ = joint_nodes(json);
    LW_CHECK(walk_nodes());
    LW_CHECK(place_meshes());
    count_from(origin ? *origin : found_origin());
    read_lamps_and_cameras();
    read_sky();
    far_.warn(report_, "its lamp or camera stands farther than 1e9 m away; left out");
    flat_.warn(report_, "its transform flattens what it holds; left out of the bake");
    hidden_.warn(report_, "is not visible (KHR_node_visibility); left out of the bake");
    lost_joints_.warn(report_, "is a joint that the scene does not show; taken to be at the origin");
    if (scene_.instances.empty()) LW_CHECK(refuse_points());
    undrawable_.warn(report_, "has no triangles; copied as it is and left out of the bake");
    return std::move(scene_);
  }

 private:
  /// Says of a file without any surface that it holds points, where it does.
  Result<void> refuse_points() const {
    for (const Json& mesh : member(scene_.document.json, "meshes"))
      for (const Json& primitive : member(mesh, "primitives"))
        if (member(primitive, "mode") == 0)
          return fail("", "holds points and no triangles (a point cloud, Gaussian splats); Lightwell takes meshes");
    return {};
  }

  struct Visit {
    int node;
    Transform parent;
    bool hidden;
  };

  Result<void> walk_nodes() {
    const Json& json = scene_.document.json;
    const Json& scenes = member(json, "scenes");
    const Json& shown = element(scenes, static_cast<size_t>(std::max(0, index_of(json, "scene"))));
    if (shown.is_null()) report_.warn("the document has no scene: nothing is shown");
    std::vector<Visit> open;  // a stack of our own: node trees may be deeper than the program's
    const auto push = [&](const Json& nodes, const Transform& parent, bool hidden) {
      for (size_t i = nodes.size(); i-- > 0;)
        open.push_back({static_cast<int>(whole_number(nodes[i])), parent, hidden});
    };
    push(member(shown, "nodes"), Transform(), false);
    while (!open.empty()) {
      Visit visit = open.back();
      open.pop_back();
      const Json& node = element(member(json, "nodes"), static_cast<size_t>(visit.node));
      if (!visit.hidden && !boolean(extension(node, "KHR_node_visibility"), "visible", true)) {
        hidden_.add(element_name("nodes", static_cast<size_t>(visit.node)));
        visit.hidden = true;  // what it holds may still be a joint
      }
      const Transform to_scene = visit.parent * local_transform(node);
      if (joint_nodes_.contains(visit.node)) joints_[visit.node] = to_scene;
      if (!visit.hidden) LW_CHECK(visit_node(node, visit.node, to_scene));
      push(member(node, "children"), to_scene, visit.hidden);
    }
    return {};
  }

  Result<void> visit_node(const Json& node, int index, const Transform& to_scene) {
    const bool lit_or_seen = node.contains("camera") || extension(node, "KHR_lights_punctual").is_object();
    if (!node.contains("mesh") && !lit_or_seen) return {};
    const int skin = index_of(node, "skin");
    if (flattens(to_scene) && skin < 0) {
      flat_.add(element_name("nodes", static_cast<size_t>(index)));
      return {};
    }
    if (lit_or_seen) lamps_and_cameras_.emplace_back(index, to_scene);
    if (!node.contains("mesh")) return {};
    const int mesh = index_of(node, "mesh");
    MeshUse use{
        mesh, index, skin, morph_weights(node, scene_.document.json["meshes"][static_cast<size_t>(mesh)]), {to_scene}};
    if (const Json& instancing = extension(node, "EXT_mesh_gpu_instancing"); instancing.is_object() && skin < 0) {
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

  /// Uses that show a mesh in one pose.
  using Group = std::vector<const MeshUse*>;

  Result<void> place_meshes() {
    std::map<int, Group> by_mesh;
    for (const MeshUse& use : uses_) by_mesh[use.mesh].push_back(&use);
    for (const auto& [mesh, uses] : by_mesh) LW_CHECK(count_corners(mesh, groups_of(uses).size()));
    for (const auto& [mesh, uses] : by_mesh) LW_CHECK(place_mesh(mesh, groups_of(uses)));
    return {};
  }

  /// Every skinned use has a pose of its own.
  static std::vector<Group> groups_of(const Group& uses) {
    std::map<std::pair<int, std::vector<double>>, Group> groups;
    for (const MeshUse* use : uses) groups[{use->skin < 0 ? -1 : use->node, use->weights}].push_back(use);
    std::vector<Group> list;
    for (auto& [pose, group] : groups) list.push_back(std::move(group));
    return list;
  }

  /// Fails before anything is read when there is more than the file can hold.
  Result<void> count_corners(int mesh, size_t poses) {
    const Json& json = scene_.document.json;
    for (const Json& primitive : member(json["meshes"][static_cast<size_t>(mesh)], "primitives")) {
      int accessor = index_of(primitive, "indices");
      if (accessor < 0) accessor = index_of(member(primitive, "attributes"), "POSITION");
      if (accessor < 0) continue;
      const Json& corners = element(member(json, "accessors"), static_cast<size_t>(accessor));
      corners_ += static_cast<size_t>(std::max(0.0, number(corners, "count", 0))) * poses;
      if (corners_ > allowed_.corners)
        return fail(element_name("meshes", static_cast<size_t>(mesh)),
                    "the scene has more corners than the file can hold");
    }
    return {};
  }

  Result<void> place_mesh(int mesh, const std::vector<Group>& groups) {
    const bool skinned = std::any_of(groups.begin(), groups.end(), [](const Group& g) { return g[0]->skin >= 0; });
    const std::string mesh_name = element_name("meshes", static_cast<size_t>(mesh));
    const Json& primitives = scene_.document.json["meshes"][static_cast<size_t>(mesh)]["primitives"];
    for (size_t p = 0; p < primitives.size(); p++) {
      const std::string name = mesh_name + "." + element_name("primitives", p);
      if (!has_triangles(primitives[p]) || !member(primitives[p], "attributes").contains("POSITION")) {
        undrawable_.add(name);
        continue;
      }
      const bool deforming = skinned || !member(primitives[p], "targets").empty();
      const int material = index_of(primitives[p], "material");
      for (const Group& group : groups) {
        Pose pose{group[0]->weights, {}};
        std::vector<Transform> bent;
        if (group[0]->skin >= 0) LW_CHECK(bend(*group[0], pose, bent));
        LW_TRY(read, read_primitive(scene_.document, mesh, static_cast<int>(p), pose, report_));
        scene_.primitives.push_back({std::move(read), material, mesh, static_cast<int>(p), deforming});
        faces_ += scene_.primitives.back().mesh.faces.size();
        if (faces_ > max_faces)
          return fail(ErrorKind::limit, name, "the scene has more than " + std::to_string(max_faces) + " triangles");
        for (const MeshUse* use : group) LW_CHECK(place_instances(use->node, bent.empty() ? use->to_scene : bent));
      }
    }
    return {};
  }

  /// The joints of a skinned use's pose, counted from where its first joint stands, and that place: the node's own does
  /// not count (glTF 2.0, section 3.7.3.3).
  Result<void> bend(const MeshUse& use, Pose& pose, std::vector<Transform>& place) {
    LW_TRY(joints, read_inverse_binds(scene_.document, use.skin));
    const Json& nodes = member(scene_.document.json["skins"][static_cast<size_t>(use.skin)], "joints");
    if (joints.empty()) return {};
    std::optional<Vec3d> base;
    for (size_t i = 0; i < joints.size(); i++) {
      const int node = static_cast<int>(whole_number(nodes[i]));
      const auto found = joints_.find(node);
      if (found == joints_.end()) lost_joints_.add(element_name("nodes", static_cast<size_t>(node)));
      const Transform joint = found == joints_.end() ? Transform() : found->second;
      if (!base) base = joint.t;
      joints[i] = Transform::translation(-*base) * joint * joints[i];
    }
    if (!(length(*base) < largest))
      return fail(element_name("nodes", static_cast<size_t>(use.node)), "the joints of its skin are too far away");
    pose.joints = std::move(joints);
    place = {Transform::translation(*base)};
    return {};
  }

  /// Places the primitive that was read last.
  Result<void> place_instances(int node, const std::vector<Transform>& to_scene) {
    if (scene_.instances.size() + to_scene.size() > max_instances)
      return fail(ErrorKind::limit, "nodes", "place more than " + std::to_string(max_instances) + " instances");
    placed_faces_ += scene_.primitives.back().mesh.faces.size() * to_scene.size();
    if (placed_faces_ > max_placed_faces)
      return fail(ErrorKind::limit, "nodes",
                  "place more than " + std::to_string(max_placed_faces) + " triangles, counted with every instance");
    for (const Transform& transform : to_scene)
      scene_.instances.push_back({static_cast<int>(scene_.primitives.size()) - 1, transform, node});
    return {};
  }

  Vec3d found_origin() {
    std::vector<Box3f> boxes;
    for (const Primitive& primitive : scene_.primitives) boxes.push_back(primitive.mesh.bounds());
    std::vector<Place> places;
    for (const Instance& instance : scene_.instances) {
      const auto index = static_cast<size_t>(instance.primitive);
      if (!boxes[index].empty()) places.push_back(place_of(instance, scene_.primitives[index], boxes[index]));
    }
    const Vec3d origin = origin_amid(std::move(places));
    if (origin != Vec3d{})
      report_.warn("the scene lies " + kilometres(length(origin)) +
                   " km from its origin: it is baked near (0, 0, 0), "
                   "and its pack keeps the place");
    return origin;
  }

  void count_from(const Vec3d& origin) {
    scene_.origin = origin;
    for (Instance& instance : scene_.instances) instance.to_scene.t -= origin;
    for (auto& [node, to_scene] : lamps_and_cameras_) to_scene.t -= origin;
  }

  void read_lamps_and_cameras() {
    const Json& json = scene_.document.json;
    for (const auto& [node, to_scene] : lamps_and_cameras_) {
      auto lamp = read_lamp(json, node, to_scene, report_);
      auto camera = read_camera(json, node, to_scene, report_);
      const bool far = !(max_component(max(to_scene.t, -to_scene.t)) <= farthest_position);
      const bool sun = lamp && lamp->kind == Lamp::Kind::sun;  // it has no place
      if (far && (camera || (lamp && !sun))) far_.add(element_name("nodes", static_cast<size_t>(node)));
      if (lamp && (sun || !far)) scene_.lamps.push_back(std::move(*lamp));
      if (camera && !far) scene_.cameras.push_back(std::move(*camera));
    }
  }

  void read_sky() {
    const NotedSky sky = noted_sky(scene_.document.json);
    const Lamp* sun = strongest_sun(scene_);
    if (sky.radiance) scene_.environment.radiance = *sky.radiance;
    if (sky.turbidity && sun != nullptr) scene_.environment = physical_sky(*sun, *sky.turbidity);
  }

  Scene scene_;
  Report& report_;
  std::set<int> joint_nodes_;
  std::map<int, Transform> joints_;  ///< to_scene of those that the scene has, by node
  std::vector<MeshUse> uses_;
  std::vector<std::pair<int, Transform>> lamps_and_cameras_;
  Allowance allowed_;
  size_t faces_ = 0, corners_ = 0, placed_ = 0, placed_faces_ = 0;
  Tally far_, flat_, hidden_, lost_joints_, undrawable_;
};

}  // namespace

Result<Scene> scene_from_document(Document document, std::string name, Report& report,
                                  const std::optional<Vec3d>& origin, ImageLimit limit) {
  return Importer(std::move(document), std::move(name), report).import(origin, limit);
}

}  // namespace lightwell
