// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/verify_primitive.h"

#include <algorithm>
#include <optional>

#include "lightwell/asset/mesh_asset.h"
#include "lightwell/gltf/accessor.h"
#include "lightwell/gltf/document.h"
#include "lightwell/packing/deformation.h"
#include "lightwell/packing/unpack.h"

namespace lightwell {
namespace {

// An array of the coarsest level, as described by the stream's parameters.
struct BaseArray {
  Component component = Component::f32;
  int rows = 3;
  bool normalized = false;
  uint32_t count = 0;
  uint32_t place = 0;  // byte offset in the BIN chunk
};

// Whether an accessor is exactly that array: of the same type, count and place, tightly packed and not sparse.
bool is_array(const Json& json, int accessor_index, const BaseArray& array) {
  const Json& accessor = element(member(json, "accessors"), static_cast<size_t>(accessor_index));
  const ElementType type = element_type(accessor);
  if (type.component != array.component || type.rows != array.rows || type.columns != 1 ||
      type.normalized != array.normalized)
    return false;
  if (whole_number(member(accessor, "count")) != array.count || !member(accessor, "sparse").is_null()) return false;
  const Json& view = element(member(json, "bufferViews"), static_cast<size_t>(index_of(accessor, "bufferView")));
  if (index_of(view, "buffer") != 0) return false;
  if (number(view, "byteStride", static_cast<double>(type.size())) != static_cast<double>(type.size())) return false;
  return number(view, "byteOffset", 0) + number(accessor, "byteOffset", 0) == array.place;
}

// The attributes that the coarsest level must have.
std::vector<std::pair<std::string, BaseArray>> attributes_of(const MeshLayout& layout, const BasePlaces& places) {
  const uint32_t count = layout.base_vertices;
  std::vector<std::pair<std::string, BaseArray>> attributes = {
      {"POSITION", {Component::f32, 3, false, count, places.positions}}};
  if (layout.has_normals) attributes.push_back({"NORMAL", {Component::f32, 3, false, count, places.normals}});
  for (size_t set = 0; set < 2; set++)
    if (layout.has_texcoords[set])
      attributes.push_back(
          {"TEXCOORD_" + std::to_string(set), {Component::f32, 2, false, count, places.texcoords[set]}});
  if (layout.has_colors) attributes.push_back({"COLOR_0", {Component::u16, 4, true, count, places.colors}});
  return attributes;
}

// The indices of a region of the coarsest level, which stand behind those of the regions before it.
BaseArray indices_of(const MeshLayout& layout, const BasePlaces& places, size_t region) {
  BaseArray indices{places.short_indices ? Component::u16 : Component::u32, 1, false, 3 * layout.base_faces,
                    places.indices};
  if (layout.regions.empty()) return indices;
  for (size_t i = 0; i < region; i++)
    indices.place += 3 * layout.regions[i].base_faces * (places.short_indices ? 2u : 4u);
  indices.count = 3 * layout.regions[region].base_faces;
  return indices;
}

Result<void> verify_arrays(const Json& json, const Json& primitive, const std::string& name, const MeshLayout& layout,
                           const BasePlaces& places, const BaseArray& indices, size_t bending) {
  const auto attributes = attributes_of(layout, places);
  const Json& said = member(primitive, "attributes");
  if (said.size() != attributes.size() + bending) return fail(name, "has other attributes than its stream");
  for (const auto& [semantic, array] : attributes)
    if (!is_array(json, index_of(said, semantic.c_str()), array))
      return fail(name, semantic + " is not the array that its stream refines");
  const Json& mode = member(primitive, "mode");
  const bool triangles = mode.is_null() || whole_number(mode) == static_cast<int>(PrimitiveMode::triangles);
  if (!triangles || !is_array(json, index_of(primitive, "indices"), indices))
    return fail(name, "its indices are not the array that its stream refines");
  return {};
}

// Whether the positions lie between `lo` and `hi`, up to `step`.
bool bound(const Vec3f& lo, const Vec3f& hi, const Box3f& positions, float step) {
  for (int i = 0; i < 3; i++)
    if (!(positions.lo[i] >= lo[i] - step && positions.hi[i] <= hi[i] + step)) return false;
  return true;
}

// Whether the POSITION accessor states the exact bounds, from which a loader takes the box of the mesh.
bool has_exact_bounds(const Json& json, const Json& primitive, const Box3f& positions) {
  const int index = index_of(member(primitive, "attributes"), "POSITION");
  const Json& accessor = element(member(json, "accessors"), static_cast<size_t>(index));
  const auto says = [&](const char* key, const Vec3f& bound) {
    const Json& said = member(accessor, key);
    if (!said.is_array() || said.size() != 3) return false;
    for (size_t i = 0; i < 3; i++)
      if (!said[i].is_number() || static_cast<float>(said[i].get<double>()) != bound[static_cast<int>(i)]) return false;
    return true;
  };
  return says("min", positions.lo) && says("max", positions.hi);
}

}  // namespace

Result<void> verify_primitive(const OpenedPack& pack, const RefinedPrimitive& refined) {
  const std::string name = element_name("meshes", refined.mesh) + "." + element_name("primitives", refined.primitive);
  const Json& json = pack.json();
  const Json& primitive =
      element(member(element(member(json, "meshes"), refined.mesh), "primitives"), refined.primitive);
  LW_TRY(mesh, open_asset_as<MeshAsset>(pack.reader(), refined.stream));
  const MeshLayout& layout = mesh->layout();
  const BasePlaces& places = mesh->places();
  if (refined.region >= layout.region_count()) return fail(name, "a region that its stream does not have");
  const uint32_t faces = layout.regions.empty() ? layout.faces : layout.regions[refined.region].faces;
  const bool is_first = refined.region == 0;
  if (refined.faces != faces ||
      (is_first && (refined.vertices != layout.vertices || refined.error != layout.base_error)))
    return fail(name + "." + mesh_extension, "differs from what its stream says");
  if (!extension(primitive, "KHR_draco_mesh_compression").is_null()) return fail(name, "is compressed");
  const DeformationAccessors deformation = refined.deformation.value_or(DeformationAccessors());
  if (refined.deformation && !layout.regions.empty()) return fail(name, "is a region and bends");
  LW_CHECK(verify_arrays(json, primitive, name, layout, places, indices_of(layout, places, refined.region),
                         deformation.attributes.size()));
  LW_CHECK(verify_deformation(json, primitive, deformation, layout.base_vertices, layout.vertices, name));
  Box3f positions;
  const MeshBuffers coarsest = mesh->buffers();
  for (const Vec3f& position : coarsest.positions.first(coarsest.vertices)) positions.extend(position);
  Box3f shown = positions;
  if (!layout.regions.empty()) {
    shown = {};
    for (const uint32_t corner : mesh->indices(refined.region)) shown.extend(coarsest.positions[corner]);
  }
  if (!has_exact_bounds(json, primitive, positions)) return fail(name, "its bounds are not those of its positions");
  // Rounding to the lattice may move positions out of the bounds of the input by a step; those of regions hold it.
  const bool is_shown = layout.regions.empty() || !mesh->indices(refined.region).empty();
  if (is_shown &&
      !bound(refined.bounds.lo, refined.bounds.hi, shown, layout.regions.empty() ? layout.positions.step() : 0))
    return fail(name + "." + mesh_extension, "its bounds do not hold its coarsest level");
  return {};
}

}  // namespace lightwell
