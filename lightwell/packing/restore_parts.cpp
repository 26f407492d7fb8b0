// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/restore_parts.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "lightwell/gltf/check.h"
#include "lightwell/gltf/node_transform.h"
#include "lightwell/mesh/part_table.h"

namespace lightwell {
namespace {

Error unfit(const std::string& element, const std::string& reason) { return {"", "parts." + element, reason}; }

/// The faces of some parts of a mesh, as meshes of their own.
class Separation {
 public:
  Separation(const Mesh& mesh, const std::vector<uint32_t>& part_of_face, size_t parts)
      : mesh_(mesh), faces_(parts), number_(mesh.positions.size(), none) {
    for (size_t f = 0; f < mesh.faces.size(); f++) faces_[part_of_face[f]].push_back(mesh.faces[f]);
  }

  /// A part in the space that `from_scene` leads to.
  Mesh part(size_t index, const Transform& from_scene) {
    Mesh part;
    used_.clear();
    const bool mirrored = from_scene.determinant() < 0;
    for (const Face& f : faces_[index])
      part.faces.push_back({renumber(f[0]), renumber(f[mirrored ? 2 : 1]), renumber(f[mirrored ? 1 : 2])});
    for (const uint32_t v : used_) {
      number_[v] = none;
      part.positions.push_back(from_scene.point(mesh_.positions[v]));
      if (!mesh_.normals.empty()) part.normals.push_back(from_scene.normal(mesh_.normals[v]));
      for (size_t set = 0; set < 2; set++)
        if (!mesh_.texcoords[set].empty()) part.texcoords[set].push_back(mesh_.texcoords[set][v]);
      if (!mesh_.colors.empty()) part.colors.push_back(mesh_.colors[v]);
    }
    return part;
  }

 private:
  static constexpr uint32_t none = ~0u;

  uint32_t renumber(uint32_t v) {
    if (number_[v] == none) {
      number_[v] = static_cast<uint32_t>(used_.size());
      used_.push_back(v);
    }
    return number_[v];
  }

  const Mesh& mesh_;
  std::vector<std::vector<Face>> faces_;  ///< by part
  std::vector<uint32_t> number_, used_;
};

/// The transforms of the default scene's nodes. Survives nodes in a ring, which a check finds later.
std::vector<std::optional<Transform>> transforms(const Json& json, const Vec3d& origin) {
  const Json& nodes = member(json, "nodes");
  std::vector<std::optional<Transform>> to_scene(nodes.size());
  std::vector<std::pair<const Json*, Transform>> open;
  const auto scene = static_cast<size_t>(std::max(0, index_of(json, "scene")));
  open.emplace_back(&member(element(member(json, "scenes"), scene), "nodes"), Transform::translation(-origin));
  while (!open.empty()) {
    const auto [list, parent] = open.back();
    open.pop_back();
    if (!list->is_array()) continue;
    for (const Json& value : *list) {
      const int64_t node = whole_number(value);
      if (node < 0 || node >= static_cast<int64_t>(nodes.size())) continue;
      const auto index = static_cast<size_t>(node);
      if (to_scene[index] || !nodes[index].is_object()) continue;
      to_scene[index] = parent * local_transform(nodes[index]);
      open.emplace_back(&member(nodes[index], "children"), *to_scene[index]);
    }
  }
  return to_scene;
}

class Restoration {
 public:
  Restoration(Document& document, const PartsDescription& description, PartsFile file)
      : document_(document), json_(document.json), description_(description), file_(std::move(file)) {}

  Result<void> restore(const std::function<Result<Mesh>(size_t)>& final_level, const Vec3d& origin) {
    LW_CHECK(read_levels(final_level));
    LW_CHECK(put_back());
    const auto to_scene = transforms(json_, origin);
    for (size_t i = 0; i < file_.merged.size(); i++) LW_CHECK(give_arrays(i, to_scene));
    drop_empty();
    share_buffer_views(document_);
    drop_unused(document_);
    Report known;
    return check_document(json_, known);
  }

 private:
  /// The merged mesh, and of each of its faces the part.
  Result<void> read_levels(const std::function<Result<Mesh>(size_t)>& final_level) {
    const Json& primitives = member(json_["meshes"][description_.meshes], "primitives");
    if (primitives.size() != file_.merged.size()) return fail(unfit("merged", "is not as long as the merged mesh"));
    for (size_t i = 0; i < file_.merged.size(); i++) {
      const PartsFile::Merged& merged = file_.merged[i];
      Report known;
      LW_TRY(level, read_primitive(document_, static_cast<int>(description_.meshes), static_cast<int>(i), known));
      LW_TRY(finest, final_level(i));
      auto parts = parts_of_faces(finest, merged.table, static_cast<uint32_t>(merged.parts.size()));
      if (!parts) return fail(in_element(parts.error(), "parts." + element_name("merged", i) + ".table"));
      if (level.faces.size() > parts->size()) return fail(unfit("merged", "has fewer faces than a level"));
      levels_.push_back(std::move(level));
      part_of_face_.push_back(std::move(*parts));
    }
    return {};
  }

  /// Takes the merged mesh and its node away, and has the nodes and meshes of the file in their places.
  Result<void> put_back() {
    json_["meshes"].erase(description_.meshes);
    json_["nodes"].erase(description_.nodes);
    Json& scenes = json_["scenes"];
    const auto shown = static_cast<size_t>(std::max(0, index_of(json_, "scene")));
    if (shown >= scenes.size()) return fail(unfit("nodes", "have no scene"));
    for (Json& scene : scenes) {
      Json left = Json::array();
      for (const Json& node : member(scene, "nodes"))
        if (whole_number(node) != description_.nodes) left.push_back(node);
      scene["nodes"] = std::move(left);
    }
    for (Json& node : file_.nodes) json_["nodes"].push_back(std::move(node));
    for (Json& mesh : file_.meshes) json_["meshes"].push_back(std::move(mesh));
    for (Json& material : file_.materials) json_["materials"].push_back(std::move(material));
    for (const Json& root : file_.roots) {
      const Json& parent = element(root, 1);
      const int64_t above = whole_number(parent);
      const bool known = parent == -1 || (above >= 0 && above < description_.nodes);
      if (!known) return fail(unfit("roots", "name what is no node of the opening"));
      Json& owner = parent == -1 ? scenes[shown] : json_["nodes"][static_cast<size_t>(above)];
      owner[parent == -1 ? "nodes" : "children"].push_back(element(root, 0));
    }
    for (const Json& pair : file_.shown) {
      const int64_t node = whole_number(element(pair, 0));
      if (node < 0 || node >= description_.nodes) return fail(unfit("shown", "names what is no node of the opening"));
      json_["nodes"][static_cast<size_t>(node)]["mesh"] = element(pair, 1);
    }
    return {};
  }

  Result<void> give_arrays(size_t merged, const std::vector<std::optional<Transform>>& to_scene) {
    const std::vector<PartsFile::Part>& parts = file_.merged[merged].parts;
    Separation separation(levels_[merged], part_of_face_[merged], parts.size());
    for (size_t i = 0; i < parts.size(); i++) {
      const PartsFile::Part& part = parts[i];
      if (part.node >= to_scene.size() || !to_scene[part.node] || !(std::abs(to_scene[part.node]->determinant()) > 0))
        return fail(unfit(element_name("merged", merged), "names a node without a place"));
      Json* primitive = primitive_of(part);
      if (!primitive) return fail(unfit(element_name("merged", merged), "names a primitive that is not there"));
      if (primitive->contains("attributes")) continue;  // of another node that shows the same mesh
      const Mesh mesh = separation.part(i, to_scene[part.node]->inverse());
      if (!mesh.faces.empty()) primitive->update(DocumentBuilder(document_).primitive(mesh));
    }
    return {};
  }

  Json* primitive_of(const PartsFile::Part& part) {
    const int mesh = index_of(json_["nodes"][part.node], "mesh");
    if (mesh < static_cast<int>(description_.meshes) || static_cast<size_t>(mesh) >= json_["meshes"].size())
      return nullptr;
    const Json& primitives = member(json_["meshes"][static_cast<size_t>(mesh)], "primitives");
    if (!primitives.is_array() || part.primitive >= primitives.size() || !primitives[part.primitive].is_object())
      return nullptr;
    return &json_["meshes"][static_cast<size_t>(mesh)]["primitives"][part.primitive];
  }

  /// Drops primitives without faces, and meshes without primitives.
  void drop_empty() {
    Json left = Json::array();
    std::vector<int> numbers;
    for (Json& mesh : json_["meshes"]) {
      Json primitives = Json::array();
      for (const Json& primitive : member(mesh, "primitives"))
        if (primitive.contains("attributes")) primitives.push_back(primitive);
      numbers.push_back(primitives.empty() ? -1 : static_cast<int>(left.size()));
      if (primitives.empty()) continue;
      mesh["primitives"] = std::move(primitives);
      left.push_back(std::move(mesh));
    }
    json_["meshes"] = std::move(left);
    if (json_["meshes"].empty()) json_.erase("meshes");
    for (Json& node : json_["nodes"]) {
      const int mesh = index_of(node, "mesh");
      if (mesh < 0 || static_cast<size_t>(mesh) >= numbers.size()) continue;
      const int number = numbers[static_cast<size_t>(mesh)];
      if (number < 0)
        node.erase("mesh");
      else
        node["mesh"] = number;
    }
  }

  Document& document_;
  Json& json_;
  const PartsDescription& description_;
  PartsFile file_;
  std::vector<Mesh> levels_;
  std::vector<std::vector<uint32_t>> part_of_face_;
};

}  // namespace

Result<void> restore_parts(Document& document, const PartsDescription& description, PartsFile file,
                           const std::function<Result<Mesh>(size_t primitive)>& final_level, const Vec3d& origin) {
  return Restoration(document, description, std::move(file)).restore(final_level, origin);
}

}  // namespace lightwell
