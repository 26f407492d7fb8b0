// SPDX-License-Identifier: Apache-2.0
#include <draco/mesh/mesh.h>

#include <cstring>
#include <map>

#include "lightwell/gltf/accessor.h"
#include "lightwell/gltf/draco_mesh.h"
#include "lightwell/gltf/expand.h"
#include "lightwell/gltf/extensions.h"

namespace lightwell {
namespace {

constexpr const char* extension_name = "KHR_draco_mesh_compression";
constexpr int array_buffer = 34962;
constexpr int element_array_buffer = 34963;

/// Writes the values of all points as components of type T, elements `stride` bytes apart. False when a value is
/// damaged.
template <typename T>
bool copy_values(const draco::PointAttribute& attribute, uint32_t points, int components, size_t stride,
                 std::vector<uint8_t>& bytes) {
  for (uint32_t i = 0; i < points; i++) {
    T values[4] = {};
    const draco::AttributeValueIndex index = attribute.mapped_index(draco::PointIndex(i));
    if (index.value() >= attribute.size() || !attribute.ConvertValue<T>(index, static_cast<int8_t>(components), values))
      return false;
    std::memcpy(&bytes[i * stride], values, sizeof(T) * static_cast<size_t>(components));
  }
  return true;
}

bool copy_values(const draco::PointAttribute& attribute, uint32_t points, const ElementType& type, size_t stride,
                 std::vector<uint8_t>& bytes) {
  switch (type.component) {
    case Component::i8: return copy_values<int8_t>(attribute, points, type.rows, stride, bytes);
    case Component::u8: return copy_values<uint8_t>(attribute, points, type.rows, stride, bytes);
    case Component::i16: return copy_values<int16_t>(attribute, points, type.rows, stride, bytes);
    case Component::u16: return copy_values<uint16_t>(attribute, points, type.rows, stride, bytes);
    case Component::u32: return copy_values<uint32_t>(attribute, points, type.rows, stride, bytes);
    case Component::f32: return copy_values<float>(attribute, points, type.rows, stride, bytes);
  }
  return false;
}

/// Decodes the Draco primitives of a document one after the other.
class Expansion {
 public:
  Expansion(Document& document, Budget& budget) : document_(document), budget_(budget) {}

  Result<void> expand(Json& primitive, const std::string& name) {
    const Json draco = extension(primitive, extension_name);
    const int view = index_of(draco, "bufferView");
    if (view < 0) return fail(name, "has no bufferView");
    LW_TRY(bytes, locate_range(document_, document_.json["bufferViews"][static_cast<size_t>(view)], name));
    LW_TRY(mesh, decode_draco(bytes, name));
    if (primitive.contains("indices")) LW_CHECK(expand_indices(*mesh, primitive["indices"], view, name));
    if (!member(draco, "attributes").is_object()) return fail(name, "has no attributes");
    for (const auto& [semantic, id] : member(draco, "attributes").items())
      LW_CHECK(
          expand_attribute(*mesh, whole_number(id), primitive, semantic, view, name + "." + semantic.substr(0, 40)));
    primitive["mode"] = static_cast<int>(PrimitiveMode::triangles);  // strips have been decoded to triangles
    primitive["extensions"].erase(extension_name);
    if (primitive["extensions"].empty()) primitive.erase("extensions");
    return {};
  }

 private:
  Result<void> expand_indices(const draco::Mesh& mesh, Json& reference, int view, const std::string& name) {
    LW_CHECK(budget_.take(12.0 * mesh.num_faces(), name));
    if (mesh.num_faces() == 0) return fail(name, "holds no faces");
    std::vector<uint8_t> bytes(size_t(12) * mesh.num_faces());
    for (uint32_t i = 0; i < mesh.num_faces(); i++) {
      const draco::Mesh::Face& face = mesh.face(draco::FaceIndex(i));
      const uint32_t corners[3] = {face[0].value(), face[1].value(), face[2].value()};
      std::memcpy(&bytes[size_t(12) * i], corners, sizeof(corners));
    }
    Json& accessor = own_accessor(reference, view);
    accessor["componentType"] = static_cast<int>(Component::u32);
    accessor["count"] = size_t(3) * mesh.num_faces();
    accessor["bufferView"] = append_buffer_view(document_, std::move(bytes), 0, element_array_buffer);
    return {};
  }

  Result<void> expand_attribute(const draco::Mesh& mesh, int64_t id, Json& primitive, const std::string& semantic,
                                int view, const std::string& name) {
    const draco::PointAttribute* attribute =
        id < 0 || id > UINT32_MAX ? nullptr : mesh.GetAttributeByUniqueId(static_cast<uint32_t>(id));
    if (!attribute || !member(primitive["attributes"], semantic.c_str()).is_number())
      return fail(name, "is not among the attributes");
    Json& accessor = own_accessor(primitive["attributes"][semantic], view);
    const ElementType type = element_type(accessor);
    if (type.columns != 1 || type.rows != attribute->num_components()) return fail(name, "has other components");
    const size_t stride = (type.size() + 3) / 4 * 4;
    LW_CHECK(budget_.take(static_cast<double>(stride) * mesh.num_points(), name));
    if (mesh.num_points() == 0) return fail(name, "holds no vertices");
    std::vector<uint8_t> bytes(stride * mesh.num_points());
    if (!copy_values(*attribute, mesh.num_points(), type, stride, bytes)) return fail(name, "damaged Draco data");
    accessor["count"] = mesh.num_points();
    accessor["bufferView"] = append_buffer_view(document_, std::move(bytes), stride, array_buffer);
    // Draco's quantisation moves the bounds a little.
    if (accessor.contains("min")) update_bounds(document_, index_of(primitive["attributes"], semantic.c_str()));
    return {};
  }

  /// The accessor at `reference`, to be filled from the Draco stream in `view`. An accessor that another stream has
  /// filled is copied first, and `reference` redirected to the copy.
  Json& own_accessor(Json& reference, int view) {
    auto index = static_cast<size_t>(whole_number(reference));
    Json& accessors = document_.json["accessors"];
    const auto [filled, is_new] = filled_from_.emplace(index, view);
    if (!is_new && filled->second != view) {
      accessors.push_back(Json(accessors[index]));
      index = accessors.size() - 1;
      reference = index;
    }
    accessors[index].erase("byteOffset");
    accessors[index].erase("sparse");
    return accessors[index];
  }

  Document& document_;
  Budget& budget_;
  std::map<size_t, int> filled_from_;  ///< accessor to buffer view
};

}  // namespace

Result<void> expand_draco(Document& document, Budget& budget) {
  Expansion expansion(document, budget);
  Json& json = document.json;
  for (size_t m = 0; m < member(json, "meshes").size(); m++)
    for (size_t p = 0; p < json["meshes"][m]["primitives"].size(); p++) {
      Json& primitive = json["meshes"][m]["primitives"][p];
      if (!extension(primitive, extension_name).is_object()) continue;
      const std::string name = element_name("meshes", m) + "." + element_name("primitives", p) + "." + extension_name;
      LW_CHECK(expansion.expand(primitive, name));
    }
  forget_extension(json, extension_name);
  return {};
}

}  // namespace lightwell
