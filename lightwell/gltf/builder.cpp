// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "lightwell/gltf/accessor.h"
#include "lightwell/gltf/document.h"

namespace lightwell {
namespace {

constexpr int array_buffer = 34962;
constexpr int element_array_buffer = 34963;

template <typename T>
Bytes bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const uint8_t*>(values.data()), values.size() * sizeof(T)};
}

Json array_of(const Vec3f& v) { return {shortest(v[0]), shortest(v[1]), shortest(v[2])}; }

}  // namespace

int DocumentBuilder::add(const char* array, Json element) {
  Json& elements = document_.json[array];
  elements.push_back(std::move(element));
  return static_cast<int>(elements.size()) - 1;
}

int DocumentBuilder::buffer_view(Bytes bytes, int target) {
  if (document_.buffers.empty()) {
    document_.buffers.emplace_back();
    add("buffers", Json::object());
  }
  const size_t index = document_.buffers.size() - 1;
  std::vector<uint8_t>& buffer = document_.buffers[index];
  buffer.resize((buffer.size() + 3) / 4 * 4);
  Json view = {{"buffer", index}, {"byteOffset", buffer.size()}, {"byteLength", bytes.size()}};
  if (target != 0) view["target"] = target;
  buffer.insert(buffer.end(), bytes.begin(), bytes.end());
  document_.json["buffers"][index]["byteLength"] = buffer.size();
  return add("bufferViews", std::move(view));
}

int DocumentBuilder::accessor(Bytes bytes, int component_type, const char* type, size_t count, int target) {
  const int view = buffer_view(bytes, target);
  return add("accessors", {{"bufferView", view}, {"componentType", component_type}, {"count", count}, {"type", type}});
}

int DocumentBuilder::accessor(const std::vector<Vec3f>& values, bool with_bounds) {
  const int index = accessor(bytes_of(values), static_cast<int>(Component::f32), "VEC3", values.size(), array_buffer);
  if (!with_bounds || values.empty()) return index;
  Box3f box;
  for (const Vec3f& value : values) box.extend(value);
  document_.json["accessors"].back()["min"] = array_of(box.lo);
  document_.json["accessors"].back()["max"] = array_of(box.hi);
  return index;
}

int DocumentBuilder::accessor(const std::vector<Vec2f>& values) {
  return accessor(bytes_of(values), static_cast<int>(Component::f32), "VEC2", values.size(), array_buffer);
}

int DocumentBuilder::colors(const std::vector<Vec4f>& values) {
  std::vector<std::array<uint16_t, 4>> numbers(values.size());
  for (size_t i = 0; i < values.size(); i++)
    for (int k = 0; k < 4; k++)
      numbers[i][static_cast<size_t>(k)] =
          static_cast<uint16_t>(std::lround(std::clamp(values[i][k], 0.0f, 1.0f) * 65535));
  const int index = accessor(bytes_of(numbers), static_cast<int>(Component::u16), "VEC4", values.size(), array_buffer);
  document_.json["accessors"].back()["normalized"] = true;
  return index;
}

int DocumentBuilder::indices(const std::vector<Face>& faces, size_t vertices) {
  const size_t count = faces.size() * 3;
  if (vertices > 65535)  // the largest index of a type restarts a strip, so it is never used
    return accessor(bytes_of(faces), static_cast<int>(Component::u32), "SCALAR", count, element_array_buffer);
  std::vector<uint16_t> narrow;
  narrow.reserve(count);
  for (const Face& face : faces)
    for (const uint32_t corner : face) narrow.push_back(static_cast<uint16_t>(corner));
  return accessor(bytes_of(narrow), static_cast<int>(Component::u16), "SCALAR", count, element_array_buffer);
}

Json DocumentBuilder::vertices(const Mesh& mesh) {
  Json attributes = {{"POSITION", accessor(mesh.positions, true)}};
  if (!mesh.normals.empty()) attributes["NORMAL"] = accessor(mesh.normals, false);
  if (!mesh.texcoords[0].empty()) attributes["TEXCOORD_0"] = accessor(mesh.texcoords[0]);
  if (!mesh.texcoords[1].empty()) attributes["TEXCOORD_1"] = accessor(mesh.texcoords[1]);
  if (!mesh.colors.empty()) attributes["COLOR_0"] = colors(mesh.colors);
  return attributes;
}

Json DocumentBuilder::primitive(const Mesh& mesh) {
  Json primitive = {{"attributes", vertices(mesh)}};
  primitive["indices"] = indices(mesh.faces, mesh.positions.size());
  return primitive;
}

}  // namespace lightwell
