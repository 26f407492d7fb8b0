// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstring>
#include <set>

#include "lightwell/gltf/accessor.h"
#include "lightwell/gltf/expand.h"

namespace lightwell {
namespace {

/// The accessors that hold vertices, indices or instances.
std::set<int> drawn_accessors(const Json& json) {
  std::set<int> drawn;
  for (const Json& mesh : member(json, "meshes"))
    for (const Json& primitive : member(mesh, "primitives")) {
      for (const Json& accessor : member(primitive, "attributes"))
        drawn.insert(static_cast<int>(whole_number(accessor)));
      drawn.insert(index_of(primitive, "indices"));
    }
  for (const Json& node : member(json, "nodes"))
    for (const Json& accessor : member(extension(node, "EXT_mesh_gpu_instancing"), "attributes"))
      drawn.insert(static_cast<int>(whole_number(accessor)));
  drawn.erase(-1);
  return drawn;
}

/// The accessor's elements without its sparse values, `stride` bytes apart; zeros when it has no buffer view.
Result<std::vector<uint8_t>> dense_elements(const Document& document, const Json& accessor, size_t count, size_t stride,
                                            const std::string& name) {
  std::vector<uint8_t> bytes(count * stride);
  if (!accessor.contains("bufferView")) return bytes;
  LW_TRY(base, locate_base(document, accessor, name));
  for (size_t i = 0; i < count; i++) std::memcpy(&bytes[i * stride], &base.bytes[i * base.stride], base.type.extent());
  return bytes;
}

/// The indices or values of accessor.sparse, in the form of an accessor.
Json part_accessor(const Json& part, const char* type, const Json& count) {
  return {{"bufferView", part["bufferView"]},
          {"byteOffset", number(part, "byteOffset", 0)},
          {"componentType", part["componentType"]},
          {"type", type},
          {"count", count}};
}

/// Writes the sparse values into `elements`.
Result<void> apply_sparse(const Document& document, const Json& accessor, std::vector<uint8_t>& elements, size_t stride,
                          const std::string& name) {
  const Json& sparse = accessor["sparse"];
  Json values_part = sparse["values"];
  values_part["componentType"] = accessor["componentType"];
  const Json index_json = part_accessor(sparse["indices"], "SCALAR", sparse["count"]);
  const Json value_json = part_accessor(values_part, text(accessor, "type").c_str(), sparse["count"]);
  LW_TRY(indices, locate_base(document, index_json, name + ".sparse.indices"));
  LW_TRY(values, locate_base(document, value_json, name + ".sparse.values"));
  const std::vector<uint32_t> targets = widen_indices(indices);
  for (size_t i = 0; i < targets.size(); i++) {
    if (targets[i] >= elements.size() / stride)
      return fail(name + ".sparse.indices", "an index is outside the accessor");
    std::memcpy(&elements[targets[i] * stride], &values.bytes[i * values.stride], values.type.extent());
  }
  return {};
}

Result<void> expand_accessor(Document& document, size_t index, Budget& budget) {
  const Json accessor = document.json["accessors"][index];
  if (accessor.contains("bufferView") && !accessor.contains("sparse")) return {};
  const std::string name = element_name("accessors", index);
  const ElementType type = element_type(accessor);
  const bool is_attribute = type.rows > 1;  // attributes begin at multiples of four bytes, indices are packed
  const size_t stride = is_attribute ? (type.size() + 3) / 4 * 4 : type.size();
  const double count = number(accessor, "count", 0);
  LW_CHECK(budget.take(count * static_cast<double>(stride), name));
  LW_TRY(elements, dense_elements(document, accessor, static_cast<size_t>(count), stride, name));
  if (accessor.contains("sparse")) LW_CHECK(apply_sparse(document, accessor, elements, stride, name));

  const int view = append_buffer_view(document, std::move(elements), is_attribute ? stride : 0, 0);
  Json& expanded = document.json["accessors"][index];
  expanded.erase("sparse");
  expanded.erase("byteOffset");
  expanded["bufferView"] = view;
  return {};
}

}  // namespace

Result<std::vector<Vec3f>> read_sparse_vectors(const Document& document, int accessor, size_t count) {
  const Json& json = element(member(document.json, "accessors"), static_cast<size_t>(accessor));
  const std::string name = element_name("accessors", static_cast<size_t>(std::max(0, accessor)));
  AccessorData data;
  data.type = element_type(json);
  data.stride = data.type.size();
  data.count = count;
  if (number(json, "count", 0) != static_cast<double>(count)) return fail(name, "has another count than POSITION");
  if (data.type.rows != 3 || data.type.columns != 1) return fail(name, "is of a type that it cannot have");
  LW_TRY(elements, dense_elements(document, json, data.count, data.stride, name));
  if (json.contains("sparse")) LW_CHECK(apply_sparse(document, json, elements, data.stride, name));
  data.bytes = elements;
  return read_vectors<3>(data);
}

Result<int> append_prefix(Document& document, int accessor, size_t count) {
  Json prefix = element(member(document.json, "accessors"), static_cast<size_t>(accessor));
  const std::string name = element_name("accessors", static_cast<size_t>(std::max(0, accessor)));
  if (!(number(prefix, "count", 0) >= static_cast<double>(count))) return fail(name, "has too few elements");
  prefix["count"] = count;
  if (prefix.contains("sparse")) {
    Json& sparse = prefix["sparse"];
    const Json indices = part_accessor(sparse["indices"], "SCALAR", sparse["count"]);
    LW_TRY(data, locate_base(document, indices, name + ".sparse.indices"));
    const std::vector<uint32_t> places = widen_indices(data);
    sparse["count"] = std::ranges::lower_bound(places, count) - places.begin();
    if (sparse["count"] == 0) prefix.erase("sparse");
  }
  Json& accessors = document.json["accessors"];
  accessors.push_back(prefix);
  const auto index = static_cast<int>(accessors.size()) - 1;
  if (prefix.contains("min")) {
    LW_TRY(values, read_sparse_vectors(document, index, count));
    Box3f box;
    for (const Vec3f& value : values) box.extend(value);
    for (const auto& [key, corner] : {std::pair("min", box.lo), std::pair("max", box.hi)})
      document.json["accessors"].back()[key] = {shortest(corner[0]), shortest(corner[1]), shortest(corner[2])};
  }
  return index;
}

Result<void> expand_sparse(Document& document, Budget& budget) {
  for (const int accessor : drawn_accessors(document.json))
    LW_CHECK(expand_accessor(document, static_cast<size_t>(accessor), budget));
  if (!document.json.contains("accessors")) return {};
  for (Json& accessor : document.json["accessors"])
    if (!accessor.contains("bufferView")) accessor.erase("byteOffset");
  return {};
}

}  // namespace lightwell
