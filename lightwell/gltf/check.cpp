// SPDX-License-Identifier: Apache-2.0
#include "lightwell/gltf/check.h"

#include <algorithm>
#include <array>
#include <map>

#include "lightwell/gltf/accessor.h"
#include "lightwell/gltf/references.h"

namespace lightwell {
namespace {

constexpr std::array arrays = std::to_array<const char*>(
    {"accessors", "animations", "buffers", "bufferViews", "cameras", "extensionsUsed", "extensionsRequired", "images",
     "materials", "meshes", "nodes", "samplers", "scenes", "skins", "textures"});

using Checker = Result<void> (*)(const Json& json, const Json& item, const std::string& name, Report& report);

Result<void> check_arrays(const Json& json) {
  for (const char* name : arrays) {
    const Json& array = member(json, name);
    if (!array.is_array() && !array.is_null()) return fail(name, "is not an array");
    for (size_t i = 0; i < array.size(); i++)
      if (!array[i].is_object() && !std::string_view(name).starts_with("extensions"))
        return fail(element_name(name, i), "is not an object");
  }
  return {};
}

Result<void> check_references(const Json& json) {
  std::map<std::string_view, size_t> sizes;
  Result<void> result;
  for_each_reference(json, [&](const Json& value, std::string_view array, const ReferencePlace& place) {
    if (!result) return;
    if (!sizes.contains(array)) {
      const Json& target = referenced_array(json, array);
      sizes[array] = target.is_array() ? target.size() : 0;
    }
    const int64_t index = whole_number(value);
    if (index < 0)
      result = fail(place.text(), "is not an index");
    else if (static_cast<size_t>(index) >= sizes[array])
      result =
          fail(place.text(), "there is no " + element_name(std::string(array).c_str(), static_cast<size_t>(index)));
  });
  return result;
}

/// Reads a whole number of at least `least`. A missing member reads as `fallback`, and fails when that is less.
Result<uint64_t> size_member(const Json& object, const char* key, int64_t least, int64_t fallback,
                             const std::string& name) {
  const Json& value = member(object, key);
  const int64_t size = value.is_null() ? fallback : whole_number(value);
  if (size < least) return fail(name, std::string(key) + (value.is_null() ? " is missing" : " is not a valid size"));
  return static_cast<uint64_t>(size);
}

Result<void> check_array(const Json& object, const char* key, const std::string& name) {
  const Json& value = member(object, key);
  if (!value.is_null() && !value.is_array()) return fail(name, std::string(key) + " is not an array");
  return {};
}

Result<void> check_buffer(const Json&, const Json& buffer, const std::string& name, Report&) {
  LW_CHECK(size_member(buffer, "byteLength", 1, -1, name));
  return {};
}

Result<void> check_buffer_view(const Json& json, const Json& view, const std::string& name, Report&) {
  const int buffer = index_of(view, "buffer");
  if (buffer < 0) return fail(name, "has no buffer");
  LW_TRY(offset, size_member(view, "byteOffset", 0, 0, name));
  LW_TRY(length, size_member(view, "byteLength", 1, -1, name));
  LW_TRY(stride, size_member(view, "byteStride", 0, 0, name));
  if (view.contains("byteStride") && (stride < 4 || stride > 252 || stride % 4 != 0))
    return fail(name, "byteStride is not a multiple of 4 from 4 to 252");
  const double held = number(json["buffers"][static_cast<size_t>(buffer)], "byteLength", 0);
  if (static_cast<double>(offset) + static_cast<double>(length) > held)
    return fail(name, "reaches outside " + element_name("buffers", static_cast<size_t>(buffer)));
  return {};
}

/// Checks that `count` elements from `offset` on lie in the buffer view `index`.
Result<void> check_span(const Json& json, int index, uint64_t offset, uint64_t count, const ElementType& type,
                        const std::string& name) {
  const Json& view = json["bufferViews"][static_cast<size_t>(index)];
  const double stride = number(view, "byteStride", static_cast<double>(type.size()));
  if (stride < static_cast<double>(type.size()))
    return fail(name, "its elements are larger than the stride of its buffer view");
  const double last = static_cast<double>(offset) + stride * static_cast<double>(count - 1);
  if (last + static_cast<double>(type.extent()) > number(view, "byteLength", 0))
    return fail(name, "reaches outside " + element_name("bufferViews", static_cast<size_t>(index)));
  return {};
}

Result<void> check_sparse(const Json& json, const Json& accessor, uint64_t count, const std::string& name) {
  const Json& sparse = accessor["sparse"];
  const Json &indices = member(sparse, "indices"), &values = member(sparse, "values");
  LW_TRY(changed, size_member(sparse, "count", 1, -1, name + ".sparse"));
  if (changed > count) return fail(name + ".sparse", "has more elements than the accessor");
  const auto component = static_cast<Component>(std::max(0, index_of(indices, "componentType")));
  if (component != Component::u8 && component != Component::u16 && component != Component::u32)
    return fail(name + ".sparse.indices", "componentType is not an unsigned integer");
  for (const Json* part : {&indices, &values}) {
    const std::string place = name + (part == &indices ? ".sparse.indices" : ".sparse.values");
    if (index_of(*part, "bufferView") < 0) return fail(place, "has no bufferView");
    const ElementType type = part == &indices ? ElementType{component, 1} : element_type(accessor);
    LW_TRY(offset, size_member(*part, "byteOffset", 0, 0, place));
    if (json["bufferViews"][static_cast<size_t>(index_of(*part, "bufferView"))].contains("byteStride"))
      return fail(place, "its buffer view has a byteStride");
    LW_CHECK(check_span(json, index_of(*part, "bufferView"), offset, changed, type, place));
  }
  return {};
}

Result<void> check_accessor(const Json& json, const Json& accessor, const std::string& name, Report& report) {
  const ElementType type = element_type(accessor);
  const size_t component = size_of(type.component);
  if (component == 0) return fail(name, "componentType is none of glTF's");
  if (type.rows == 0) return fail(name, "type is none of glTF's");
  LW_TRY(count, size_member(accessor, "count", 1, -1, name));
  LW_TRY(offset, size_member(accessor, "byteOffset", 0, 0, name));
  if (const int index = index_of(accessor, "bufferView"); index >= 0) {
    LW_CHECK(check_span(json, index, offset, count, type, name));
    const double start = number(json["bufferViews"][static_cast<size_t>(index)], "byteOffset", 0);
    if ((static_cast<uint64_t>(start) + offset) % component != 0)
      report.warn("accessors: some do not begin at a multiple of their component's size, as glTF asks for");
  }
  if (accessor.contains("sparse")) LW_CHECK(check_sparse(json, accessor, count, name));
  return {};
}

Result<void> check_primitive(const Json& json, const Json& primitive, const std::string& name) {
  const Json& attributes = member(primitive, "attributes");
  if (!attributes.is_object() || attributes.empty()) return fail(name, "has no attributes");
  if (primitive.contains("mode") && (index_of(primitive, "mode") < 0 || index_of(primitive, "mode") > 6))
    return fail(name, "mode is not a number from 0 to 6");
  double count = -1;
  for (const auto& [semantic, accessor] : attributes.items()) {
    const double own = number(json["accessors"][static_cast<size_t>(whole_number(accessor))], "count", 0);
    if (count >= 0 && own != count)
      return fail(name, "attribute " + semantic.substr(0, 40) + " has another count than the others");
    count = own;
  }
  return check_array(primitive, "targets", name);
}

Result<void> check_mesh(const Json& json, const Json& mesh, const std::string& name, Report&) {
  const Json& primitives = member(mesh, "primitives");
  if (!primitives.is_array() || primitives.empty()) return fail(name, "has no primitives");
  for (size_t i = 0; i < primitives.size(); i++)
    LW_CHECK(check_primitive(json, primitives[i], name + "." + element_name("primitives", i)));
  return {};
}

Result<void> check_node(const Json&, const Json& node, const std::string& name, Report&) {
  LW_CHECK(check_array(node, "children", name));
  const Json& instances = member(extension(node, "EXT_mesh_gpu_instancing"), "attributes");
  if (!instances.is_null() && !instances.is_object())
    return fail(name + ".EXT_mesh_gpu_instancing", "attributes is not an object");
  constexpr std::pair<const char*, size_t> vectors[] = {
      {"matrix", 16}, {"translation", 3}, {"rotation", 4}, {"scale", 3}};
  for (const auto& [key, size] : vectors) {
    const Json& array = member(node, key);
    if (array.is_null()) continue;
    bool right = array.is_array() && array.size() == size;
    for (size_t i = 0; right && i < size; i++) right = array[i].is_number();
    if (!right) return fail(name, std::string(key) + " is not an array of " + std::to_string(size) + " numbers");
  }
  return {};
}

Result<void> check_material(const Json&, const Json& material, const std::string& name, Report&) {
  if (const Json& mode = member(material, "alphaMode"); !mode.is_null() && !mode.is_string())
    return fail(name, "alphaMode is not a text");
  return {};
}

Result<void> check_scene(const Json&, const Json& scene, const std::string& name, Report&) {
  return check_array(scene, "nodes", name);
}

Result<void> check_animation(const Json&, const Json& animation, const std::string& name, Report&) {
  LW_CHECK(check_array(animation, "samplers", name));
  return check_array(animation, "channels", name);
}

Result<void> check_skin(const Json&, const Json& skin, const std::string& name, Report&) {
  return check_array(skin, "joints", name);
}

/// Checks the lists that extensions add to the document.
Result<void> check_extension_lists(const Json& json) {
  constexpr std::pair<const char*, const char*> lists[] = {{"KHR_lights_punctual", "lights"},
                                                           {"KHR_materials_variants", "variants"}};
  for (const auto& [name, key] : lists) {
    const Json& list = member(extension(json, name), key);
    const bool right =
        list.is_array() && std::all_of(list.begin(), list.end(), [](const Json& item) { return item.is_object(); });
    if (!list.is_null() && !right) return fail(name, std::string(key) + " is not an array of objects");
  }
  return {};
}

Result<void> check_each(const Json& json, const char* array, Checker check, Report& report) {
  const Json& items = member(json, array);
  for (size_t i = 0; i < items.size(); i++) LW_CHECK(check(json, items[i], element_name(array, i), report));
  return {};
}

/// The parent of each node, -1 for roots; fails when a node has two.
Result<std::vector<int>> parents_of(const Json& nodes) {
  std::vector<int> parents(nodes.size(), -1);
  for (size_t i = 0; i < nodes.size(); i++)
    for (const Json& child : member(nodes[i], "children")) {
      int& parent = parents[static_cast<size_t>(whole_number(child))];
      if (parent >= 0)
        return fail(element_name("nodes", static_cast<size_t>(whole_number(child))), "has more than one parent");
      parent = static_cast<int>(i);
    }
  return parents;
}

/// Fails when the nodes have a cycle: its nodes are not reached from any root.
Result<void> check_cycles(const Json& nodes, const std::vector<int>& parents) {
  std::vector<bool> reached(nodes.size(), false);
  std::vector<size_t> open;
  for (size_t i = 0; i < nodes.size(); i++)
    if (parents[i] < 0) open.push_back(i);
  while (!open.empty()) {
    const size_t node = open.back();
    open.pop_back();
    reached[node] = true;
    for (const Json& child : member(nodes[node], "children")) open.push_back(static_cast<size_t>(whole_number(child)));
  }
  for (size_t i = 0; i < nodes.size(); i++)
    if (!reached[i]) return fail(element_name("nodes", i), "is its own ancestor");
  return {};
}

Result<void> check_forest(const Json& json) {
  const Json& nodes = member(json, "nodes");
  LW_TRY(parents, parents_of(nodes));
  LW_CHECK(check_cycles(nodes, parents));
  const Json& scenes = member(json, "scenes");
  std::vector<size_t> listed_in(nodes.size(), scenes.size());
  for (size_t i = 0; i < scenes.size(); i++) {
    for (const Json& value : member(scenes[i], "nodes")) {
      const auto node = static_cast<size_t>(whole_number(value));
      if (parents[node] >= 0) return fail(element_name("scenes", i), element_name("nodes", node) + " is no root");
      if (listed_in[node] == i)
        return fail(element_name("scenes", i), element_name("nodes", node) + " is listed twice");
      listed_in[node] = i;
    }
  }
  return {};
}

/// True when every member named `extensions` in a part of the document, except in extras, is an object.
bool has_sound_extensions(const Json& part) {
  if (part.is_array()) return std::all_of(part.begin(), part.end(), has_sound_extensions);
  if (!part.is_object()) return true;
  for (const auto& [key, value] : part.items())
    if (key != "extras" && (!has_sound_extensions(value) || (key == "extensions" && !value.is_object()))) return false;
  return true;
}

/// Checks that all `extensions` are objects, since later code edits them.
Result<void> check_extensions(const Json& json) {
  for (const auto& [key, value] : json.items()) {
    if (key == "extras") continue;
    if (!value.is_array() && (!has_sound_extensions(value) || (key == "extensions" && !value.is_object())))
      return fail(key, "is, or has in it, extensions that are no object");
    for (size_t i = 0; value.is_array() && i < value.size(); i++)
      if (!has_sound_extensions(value[i]))
        return fail(element_name(key.c_str(), i), "it, or something in it, has extensions that are no object");
  }
  return {};
}

bool is_version_2(const std::string& version) { return version.starts_with("2.") && version.size() >= 3; }

}  // namespace

Result<void> check_version(const Json& json) {
  if (!json.is_object()) return fail("JSON", "is not an object");
  const Json& asset = member(json, "asset");
  const std::string version = text(asset, "version"), least = text(asset, "minVersion");
  if (version.empty()) return fail("asset", "version is missing");
  if (!is_version_2(version))
    return fail(ErrorKind::unsupported, "asset", "version " + version.substr(0, 20) + " is not supported, only 2.0");
  if (!least.empty() && least != "2.0")
    return fail(ErrorKind::unsupported, "asset",
                "asks for glTF " + least.substr(0, 20) + " at least, 2.0 is supported");
  return {};
}

Result<void> check_document(const Json& json, Report& report) {
  LW_CHECK(check_arrays(json));
  LW_CHECK(check_extensions(json));
  LW_CHECK(check_references(json));
  LW_CHECK(check_each(json, "buffers", check_buffer, report));
  LW_CHECK(check_each(json, "bufferViews", check_buffer_view, report));
  LW_CHECK(check_each(json, "accessors", check_accessor, report));
  LW_CHECK(check_each(json, "meshes", check_mesh, report));
  LW_CHECK(check_each(json, "materials", check_material, report));
  LW_CHECK(check_each(json, "nodes", check_node, report));
  LW_CHECK(check_each(json, "scenes", check_scene, report));
  LW_CHECK(check_each(json, "animations", check_animation, report));
  LW_CHECK(check_each(json, "skins", check_skin, report));
  LW_CHECK(check_extension_lists(json));
  return check_forest(json);
}

}  // namespace lightwell
