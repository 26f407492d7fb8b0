// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <numeric>

#include "lightwell/gltf/accessor.h"
#include "lightwell/gltf/document.h"
#include "lightwell/gltf/extensions.h"
#include "lightwell/gltf/pose.h"

namespace lightwell {
namespace {

/// The faces of a list, strip or fan of corners, in the order of glTF 2.0, section 3.7.2.1.
std::vector<Face> faces_of(const std::vector<uint32_t>& corners, PrimitiveMode mode) {
  std::vector<Face> faces;
  if (mode == PrimitiveMode::triangles) {
    faces.resize(corners.size() / 3);
    for (size_t i = 0; i < faces.size(); i++) faces[i] = {corners[3 * i], corners[3 * i + 1], corners[3 * i + 2]};
    return faces;
  }
  for (size_t i = 0; i + 2 < corners.size(); i++) {
    if (mode == PrimitiveMode::triangle_fan)
      faces.push_back({corners[i + 1], corners[i + 2], corners[0]});
    else
      faces.push_back({corners[i], corners[i + 1 + i % 2], corners[i + 2 - i % 2]});
  }
  return faces;
}

/// Renumbers the corners to index only the vertices in use, and returns those in ascending order.
std::vector<uint32_t> compact(std::vector<uint32_t>& corners) {
  std::vector<uint32_t> used = corners;
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (uint32_t& corner : corners)
    corner = static_cast<uint32_t>(std::lower_bound(used.begin(), used.end(), corner) - used.begin());
  return used;
}

/// Reads one primitive, attribute by attribute.
class PrimitiveReader {
 public:
  PrimitiveReader(const Document& document, const Json& primitive, std::string name, const Pose& pose, Report& report)
      : document_(document), primitive_(primitive), name_(std::move(name)), pose_(pose), report_(report) {}

  Result<Mesh> read() {
    if (!has_triangles(primitive_)) return fail(name_, "is not made of triangles");
    LW_TRY(position, attribute("POSITION", 3, 3, true));
    if (!position.stride) return fail(name_, "has no POSITION");
    if (position.type.component != Component::f32 && !uses_extension(document_.json, "KHR_mesh_quantization"))
      report_.warn("some positions are quantised, but KHR_mesh_quantization is not declared");
    LW_CHECK(read_faces(position.count));
    LW_CHECK(read_positions(position));
    LW_CHECK(read_normals());
    LW_CHECK(read_texcoords("TEXCOORD_0", mesh_.texcoords[0]));
    LW_CHECK(read_texcoords("TEXCOORD_1", mesh_.texcoords[1]));
    LW_CHECK(read_colors());
    LW_CHECK(apply_pose(document_, primitive_, name_, pose_, vertex_count_, only_, mesh_));
    return std::move(mesh_);
  }

  /// Of each vertex that was read its row in the accessors.
  std::vector<uint32_t> rows() {
    if (only_) return std::move(used_);
    std::vector<uint32_t> all(vertex_count_);
    std::iota(all.begin(), all.end(), 0u);
    return all;
  }

 private:
  /// Locates an attribute of `least` to `most` rows; the stride is 0 when the primitive does not have it. Integers must
  /// be normalised unless `plain_integers` (KHR_mesh_quantization) are allowed.
  Result<AccessorData> attribute(const char* semantic, int least, int most, bool plain_integers) {
    const int accessor = index_of(member(primitive_, "attributes"), semantic);
    if (accessor < 0) return AccessorData();
    const std::string name = name_ + ".attributes." + semantic;
    auto data = locate(document_, accessor);
    if (!data) return fail(in_element(data.error(), name));
    const ElementType& type = data->type;
    if (type.columns != 1 || type.rows < least || type.rows > most || type.component == Component::u32)
      return fail(name, element_name("accessors", static_cast<size_t>(accessor)) + " is of a type that it cannot have");
    if (type.component != Component::f32 && !type.normalized && !plain_integers)
      return fail(name, "holds integers that are not normalized");
    if (vertex_count_ > 0 && data->count != vertex_count_) return fail(name, "has another count than POSITION");
    return data;
  }

  Result<void> read_faces(size_t vertex_count) {
    vertex_count_ = vertex_count;
    std::vector<uint32_t> corners;
    if (const int accessor = index_of(primitive_, "indices"); accessor >= 0) {
      LW_TRY(indices, read_indices(document_, accessor));
      corners = std::move(indices);
    } else {
      corners.resize(vertex_count);
      for (size_t i = 0; i < corners.size(); i++) corners[i] = static_cast<uint32_t>(i);
    }
    const auto outside = std::find_if(corners.begin(), corners.end(), [&](uint32_t i) { return i >= vertex_count; });
    if (outside != corners.end())
      return fail(name_ + ".indices",
                  std::to_string(*outside) + " is outside the " + std::to_string(vertex_count) + " vertices");
    if (vertex_count > corners.size()) {
      used_ = compact(corners);
      only_ = &used_;
    }
    const PrimitiveMode mode = primitive_mode(primitive_);
    if (mode == PrimitiveMode::triangles ? corners.size() % 3 != 0 : corners.size() < 3)
      report_.warn(name_ + ": the last corners make no whole triangle and are left out");
    mesh_.faces = faces_of(corners, mode);
    return {};
  }

  Result<void> read_positions(const AccessorData& data) {
    mesh_.positions = read_vectors<3>(data, only_);
    const auto& positions = mesh_.positions;
    const auto wrong =
        std::find_if_not(positions.begin(), positions.end(), [](const Vec3f& p) { return is_finite(p); });
    if (wrong == positions.end()) return {};
    return fail(name_ + ".attributes.POSITION",
                "vertex " + std::to_string(wrong - positions.begin()) + " is not at a finite position");
  }

  /// Replaces normals without a direction, which exporters write for triangles without area, by normals computed from
  /// the faces.
  Result<void> read_normals() {
    LW_TRY(data, attribute("NORMAL", 3, 3, false));
    if (!data.stride) return {};
    mesh_.normals = read_vectors<3>(data, only_);
    std::vector<Vec3f> smooth;
    for (size_t i = 0; i < mesh_.normals.size(); i++) {
      Vec3f& normal = mesh_.normals[i];
      if (is_finite(normal) && length(normal) > 1e-6f) {
        normal = normalized(normal);
        continue;
      }
      if (smooth.empty()) smooth = smooth_normals(mesh_);
      normal = smooth[i];
    }
    if (!smooth.empty()) report_.warn(name_ + ": some normals are no directions and were computed from the faces");
    return {};
  }

  Result<void> read_texcoords(const char* semantic, std::vector<Vec2f>& texcoords) {
    LW_TRY(data, attribute(semantic, 2, 2, true));
    if (!data.stride) return {};
    texcoords = read_vectors<2>(data, only_);
    replace_infinite(texcoords, semantic);
    return {};
  }

  Result<void> read_colors() {
    LW_TRY(data, attribute("COLOR_0", 3, 4, false));
    if (!data.stride) return {};
    mesh_.colors = read_vectors<4>(data, only_, 1);
    replace_infinite(mesh_.colors, "COLOR_0");
    for (Vec4f& color : mesh_.colors) color = min(max(color, Vec4f{}), Vec4f::filled(1));
    return {};
  }

  template <int N>
  void replace_infinite(std::vector<Vec<float, N>>& values, const char* semantic) {
    bool replaced = false;
    for (auto& value : values)
      for (float& component : value.e)
        if (!std::isfinite(component)) {
          component = 0;
          replaced = true;
        }
    if (replaced) report_.warn(name_ + ": " + semantic + " holds numbers that are not finite, taken as 0");
  }

  const Document& document_;
  const Json& primitive_;
  const std::string name_;
  const Pose& pose_;
  Report& report_;
  Mesh mesh_;
  size_t vertex_count_ = 0;
  std::vector<uint32_t> used_;                   ///< the vertices to read when not all are in use
  const std::vector<uint32_t>* only_ = nullptr;  ///< then points to used_
};

std::string name_of(int mesh, int primitive) {
  return element_name("meshes", static_cast<size_t>(std::max(0, mesh))) + "." +
         element_name("primitives", static_cast<size_t>(std::max(0, primitive)));
}

Result<const Json*> find_primitive(const Document& document, int mesh, int primitive) {
  const Json& meshes = member(document.json, "meshes");
  const Json& json =
      element(member(element(meshes, static_cast<size_t>(mesh)), "primitives"), static_cast<size_t>(primitive));
  if (!json.is_object()) return fail(name_of(mesh, primitive), "does not exist");
  return &json;
}

}  // namespace

PrimitiveMode primitive_mode(const Json& primitive) {
  const int mode = index_of(primitive, "mode");
  return mode < 0 || mode > 6 ? PrimitiveMode::triangles : static_cast<PrimitiveMode>(mode);
}

bool has_triangles(const Json& primitive) { return primitive_mode(primitive) >= PrimitiveMode::triangles; }

Result<Mesh> read_primitive(const Document& document, int mesh, int primitive, Report& report) {
  return read_primitive(document, mesh, primitive, Pose(), report);
}

Result<Mesh> read_primitive(const Document& document, int mesh, int primitive, const Pose& pose, Report& report) {
  LW_TRY(json, find_primitive(document, mesh, primitive));
  return PrimitiveReader(document, *json, name_of(mesh, primitive), pose, report).read();
}

Result<MeshAtRest> read_at_rest(const Document& document, int mesh, int primitive, Report& report) {
  LW_TRY(json, find_primitive(document, mesh, primitive));
  const Pose rest;
  PrimitiveReader reader(document, *json, name_of(mesh, primitive), rest, report);
  LW_TRY(read, reader.read());
  return MeshAtRest{std::move(read), reader.rows()};
}

}  // namespace lightwell
