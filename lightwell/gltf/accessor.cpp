// SPDX-License-Identifier: Apache-2.0
#include "lightwell/gltf/accessor.h"

#include <cstring>
#include <limits>

#include "lightwell/base/assert.h"

namespace lightwell {
namespace {

template <typename T>
T load(const uint8_t* from) {
  T value;
  std::memcpy(&value, from, sizeof(T));
  return value;
}

/// A component as a float, by the equations of glTF 2.0, section 3.11 (and KHR_mesh_quantization).
template <typename T, bool normalized>
float to_float(const uint8_t* from) {
  const auto value = static_cast<float>(load<T>(from));
  if constexpr (!normalized) return value;
  return std::max(value / static_cast<float>(std::numeric_limits<T>::max()), -1.0f);
}

template <typename T, bool normalized, int N>
void convert(const AccessorData& data, const std::vector<uint32_t>* only, std::vector<Vec<float, N>>& values) {
  const int rows = std::min(data.type.rows, N);
  for (size_t i = 0; i < values.size(); i++) {
    const uint8_t* element = data.bytes.data() + data.stride * (only ? (*only)[i] : i);
    for (int k = 0; k < rows; k++) values[i][k] = to_float<T, normalized>(element + sizeof(T) * static_cast<size_t>(k));
  }
}

template <typename T>
std::vector<uint32_t> widen(const AccessorData& data) {
  std::vector<uint32_t> values(data.count);
  for (size_t i = 0; i < values.size(); i++) values[i] = load<T>(data.bytes.data() + data.stride * i);
  return values;
}

}  // namespace

size_t size_of(Component component) {
  switch (component) {
    case Component::i8:
    case Component::u8: return 1;
    case Component::i16:
    case Component::u16: return 2;
    case Component::u32:
    case Component::f32: return 4;
  }
  return 0;
}

size_t ElementType::size() const {
  const size_t column = size_of(component) * static_cast<size_t>(rows);
  return columns == 1 ? column : (column + 3) / 4 * 4 * static_cast<size_t>(columns);
}

size_t ElementType::extent() const {
  const size_t column = size_of(component) * static_cast<size_t>(rows);
  return size() - size() / static_cast<size_t>(columns) + column;
}

ElementType element_type(const Json& accessor) {
  ElementType type;
  type.component = static_cast<Component>(std::max(0, index_of(accessor, "componentType")));
  type.normalized = boolean(accessor, "normalized", false);
  const std::string name = text(accessor, "type");
  if (name == "SCALAR") type.rows = 1;
  for (int n = 2; n <= 4; n++) {
    if (name == "VEC" + std::to_string(n)) type.rows = n;
    if (name == "MAT" + std::to_string(n)) type.rows = type.columns = n;
  }
  return type;
}

Result<AccessorData> locate_base(const Document& document, const Json& accessor, const std::string& name) {
  const Json& view =
      element(member(document.json, "bufferViews"), static_cast<size_t>(index_of(accessor, "bufferView")));
  const int buffer = index_of(view, "buffer");
  if (buffer < 0 || static_cast<size_t>(buffer) >= document.buffers.size()) return fail(name, "holds no data");

  AccessorData data;
  data.type = element_type(accessor);
  data.count = static_cast<size_t>(std::max<int64_t>(0, whole_number(member(accessor, "count"))));
  data.stride = static_cast<size_t>(number(view, "byteStride", static_cast<double>(data.type.size())));
  const Bytes bytes = document.buffers[static_cast<size_t>(buffer)];
  const double begin = number(view, "byteOffset", 0) + number(accessor, "byteOffset", 0);
  const double end = begin + static_cast<double>(data.stride) * (static_cast<double>(data.count) - 1) +
                     static_cast<double>(data.type.extent());
  if (data.count == 0 || data.type.size() == 0 || !(begin >= 0) || !(end <= static_cast<double>(bytes.size())))
    return fail(name, "reaches outside its buffer");
  data.bytes = bytes.subspan(static_cast<size_t>(begin));
  return data;
}

Result<AccessorData> locate(const Document& document, int accessor) {
  const std::string name = element_name("accessors", static_cast<size_t>(std::max(0, accessor)));
  const Json& json = element(member(document.json, "accessors"), static_cast<size_t>(accessor));
  if (json.contains("sparse")) return fail(name, "is sparse");
  return locate_base(document, json, name);
}

Result<Bytes> locate_range(const Document& document, const Json& range, const std::string& name) {
  const int buffer = index_of(range, "buffer");
  if (buffer < 0 || static_cast<size_t>(buffer) >= document.buffers.size()) return fail(name, "has no buffer");
  const Bytes bytes = document.buffers[static_cast<size_t>(buffer)];
  const double offset = number(range, "byteOffset", 0), length = number(range, "byteLength", 0);
  if (!(offset >= 0) || !(length >= 1) || !(offset + length <= static_cast<double>(bytes.size())))
    return fail(name, "reaches outside " + element_name("buffers", static_cast<size_t>(buffer)));
  return bytes.subspan(static_cast<size_t>(offset), static_cast<size_t>(length));
}

template <int N>
std::vector<Vec<float, N>> read_vectors(const AccessorData& data, const std::vector<uint32_t>* only, float filler) {
  std::vector<Vec<float, N>> values(only ? only->size() : data.count, Vec<float, N>::filled(filler));
  const bool n = data.type.normalized;
  switch (data.type.component) {
    case Component::i8:
      n ? convert<int8_t, true>(data, only, values) : convert<int8_t, false>(data, only, values);
      break;
    case Component::u8:
      n ? convert<uint8_t, true>(data, only, values) : convert<uint8_t, false>(data, only, values);
      break;
    case Component::i16:
      n ? convert<int16_t, true>(data, only, values) : convert<int16_t, false>(data, only, values);
      break;
    case Component::u16:
      n ? convert<uint16_t, true>(data, only, values) : convert<uint16_t, false>(data, only, values);
      break;
    case Component::u32: convert<uint32_t, false>(data, only, values); break;
    case Component::f32: convert<float, false>(data, only, values); break;
  }
  return values;
}

template std::vector<Vec2f> read_vectors<2>(const AccessorData&, const std::vector<uint32_t>*, float);
template std::vector<Vec3f> read_vectors<3>(const AccessorData&, const std::vector<uint32_t>*, float);
template std::vector<Vec4f> read_vectors<4>(const AccessorData&, const std::vector<uint32_t>*, float);

std::vector<uint32_t> widen_indices(const AccessorData& data) {
  if (data.type.rows != 1) return {};
  switch (data.type.component) {
    case Component::u8: return widen<uint8_t>(data);
    case Component::u16: return widen<uint16_t>(data);
    case Component::u32: return widen<uint32_t>(data);
    default: return {};
  }
}

Result<std::vector<uint32_t>> read_indices(const Document& document, int accessor) {
  LW_TRY(data, locate(document, accessor));
  std::vector<uint32_t> indices = widen_indices(data);
  if (indices.empty())
    return fail(element_name("accessors", static_cast<size_t>(accessor)), "holds no indices (unsigned scalars)");
  return indices;
}

void update_bounds(Document& document, int accessor) {
  auto data = locate(document, accessor);
  if (!data || data->type.columns != 1) return;
  data->type.normalized = false;  // the bounds are those of the stored numbers
  Vec4f lo = Vec4f::filled(std::numeric_limits<float>::max()), hi = -lo;
  for (const Vec4f& value : read_vectors<4>(*data)) {
    lo = min(lo, value);
    hi = max(hi, value);
  }
  Json& json = document.json["accessors"][static_cast<size_t>(accessor)];
  json["min"] = std::vector<float>(lo.e.begin(), lo.e.begin() + data->type.rows);
  json["max"] = std::vector<float>(hi.e.begin(), hi.e.begin() + data->type.rows);
}

int append_buffer_view(Document& document, std::vector<uint8_t> bytes, size_t stride, int target) {
  Json view = {{"buffer", document.buffers.size()}, {"byteLength", bytes.size()}};
  if (stride > 0) view["byteStride"] = stride;
  if (target > 0) view["target"] = target;
  document.json["buffers"].push_back({{"byteLength", bytes.size()}});
  document.buffers.push_back(std::move(bytes));
  Json& views = document.json["bufferViews"];
  views.push_back(std::move(view));
  return static_cast<int>(views.size()) - 1;
}

}  // namespace lightwell
