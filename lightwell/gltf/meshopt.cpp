// SPDX-License-Identifier: Apache-2.0
#include <meshoptimizer.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <optional>

#include "lightwell/gltf/accessor.h"
#include "lightwell/gltf/expand.h"
#include "lightwell/gltf/extensions.h"
#include "lightwell/gltf/meshopt_vertices.h"

namespace lightwell {
namespace {

constexpr const char* names[] = {"EXT_meshopt_compression", "KHR_meshopt_compression"};

/// A compressed buffer view, as described by its extension.
struct Packed {
  Bytes bytes;
  size_t count = 0;
  size_t stride = 0;
  std::string mode;
  std::string filter;
};

/// The COLOR filter of KHR_meshopt_compression: converts Y, Co, Cg and alpha to normalised RGBA. The highest set bit of
/// alpha gives the number of bits in use.
template <typename Unsigned, typename Signed>
void decode_colors(uint8_t* bytes, size_t count) {
  constexpr auto largest = static_cast<float>(std::numeric_limits<Unsigned>::max());
  for (size_t i = 0; i < count; i++) {
    Unsigned c[4];
    std::memcpy(c, bytes + i * sizeof(c), sizeof(c));
    const int bits = c[3] == 0 ? 1 : static_cast<int>(std::bit_width(static_cast<unsigned>(c[3])));
    const int range = (1 << bits) - 1;
    const int y = c[0], co = static_cast<Signed>(c[1]), cg = static_cast<Signed>(c[2]);
    const int alpha = ((c[3] << 1) & range) | (c[3] & 1);  // drops the marker bit and repeats the lowest one
    const int rgba[4] = {y + co - cg, y + cg, y - co - cg, alpha};
    for (int k = 0; k < 4; k++) {
      const float value = std::floor(static_cast<float>(rgba[k]) * largest / static_cast<float>(range) + 0.5f);
      c[k] = static_cast<Unsigned>(std::clamp(value, 0.0f, largest));
    }
    std::memcpy(bytes + i * sizeof(c), c, sizeof(c));
  }
}

Result<void> apply_filter(const Packed& packed, std::vector<uint8_t>& bytes, const std::string& name) {
  const size_t count = packed.count, stride = packed.stride;
  const bool four = stride == 4, eight = stride == 8;
  if (packed.filter.empty() || packed.filter == "NONE") return {};
  if (packed.mode != "ATTRIBUTES") return fail(name, "a filter stands on indices");
  if (packed.filter == "OCTAHEDRAL" && (four || eight))
    meshopt_decodeFilterOct(bytes.data(), count, stride);
  else if (packed.filter == "QUATERNION" && eight)
    meshopt_decodeFilterQuat(bytes.data(), count, stride);
  else if (packed.filter == "EXPONENTIAL")
    meshopt_decodeFilterExp(bytes.data(), count, stride);
  else if (packed.filter == "COLOR" && four)
    decode_colors<uint8_t, int8_t>(bytes.data(), count);
  else if (packed.filter == "COLOR" && eight)
    decode_colors<uint16_t, int16_t>(bytes.data(), count);
  else
    return fail(name, "filter or its byteStride is none of the extension's");
  return {};
}

bool is_version_1(const Packed& packed) {
  return packed.mode == "ATTRIBUTES" && packed.bytes[0] == meshopt_vertices_v1;
}

/// The fewest bytes that can encode the elements: two header bits for every 16 values of a byte column, or one byte a
/// triangle or index. Files that claim more elements are refused before memory is allocated.
double least_bytes(const Packed& packed) {
  const auto count = static_cast<double>(packed.count);
  if (is_version_1(packed)) return least_bytes_v1(packed.count, packed.stride);
  if (packed.mode == "ATTRIBUTES") return count * static_cast<double>(packed.stride) / 64;
  return packed.mode == "TRIANGLES" ? count / 3 : count;
}

/// The decoded elements, before any filter; nullopt when the bytes are damaged.
std::optional<std::vector<uint8_t>> decode_mode(const Packed& packed) {
  if (is_version_1(packed)) return decode_meshopt_vertices_v1(packed.bytes, packed.count, packed.stride);
  const uint8_t* from = packed.bytes.data();
  const size_t size = packed.bytes.size();
  std::vector<uint8_t> bytes(packed.count * packed.stride);
  int status = -1;
  if (packed.mode == "ATTRIBUTES")
    status = meshopt_decodeVertexBuffer(bytes.data(), packed.count, packed.stride, from, size);
  else if (packed.mode == "TRIANGLES")
    status = meshopt_decodeIndexBuffer(bytes.data(), packed.count, packed.stride, from, size);
  else
    status = meshopt_decodeIndexSequence(bytes.data(), packed.count, packed.stride, from, size);
  if (status != 0) return std::nullopt;
  return bytes;
}

Result<std::vector<uint8_t>> decode(const Packed& packed, Budget& budget, const std::string& name) {
  const bool is_attributes = packed.mode == "ATTRIBUTES";
  if (!is_attributes && packed.mode != "TRIANGLES" && packed.mode != "INDICES")
    return fail(name, "mode is none of the extension's");
  const bool stride_fits = is_attributes ? packed.stride % 4 == 0 && packed.stride >= 4 && packed.stride <= 256
                                         : packed.stride == 2 || packed.stride == 4;
  if (!stride_fits || packed.count == 0) return fail(name, "byteStride or count is none that its mode allows");
  if (packed.mode == "TRIANGLES" && packed.count % 3 != 0) return fail(name, "count is not a multiple of 3");
  if (static_cast<double>(packed.bytes.size()) < least_bytes(packed)) return fail(name, "holds too few bytes");
  LW_CHECK(budget.take(static_cast<double>(packed.count) * static_cast<double>(packed.stride), name));
  auto bytes = decode_mode(packed);
  if (!bytes) return fail(name, "damaged meshopt data");
  LW_CHECK(apply_filter(packed, *bytes, name));
  return std::move(*bytes);
}

Result<void> expand_view(Document& document, size_t index, const char* extension_name, Budget& budget) {
  Json& view = document.json["bufferViews"][index];
  const Json& json = extension(view, extension_name);
  const std::string name = element_name("bufferViews", index) + "." + extension_name;
  LW_TRY(packed_bytes, locate_range(document, json, name));
  Packed packed{packed_bytes, 0, 0, text(json, "mode"), text(json, "filter")};
  packed.count = static_cast<size_t>(std::max<int64_t>(0, whole_number(member(json, "count"))));
  packed.stride = static_cast<size_t>(std::max<int64_t>(0, whole_number(member(json, "byteStride"))));
  LW_TRY(bytes, decode(packed, budget, name));
  const auto length = static_cast<size_t>(number(view, "byteLength", 0));
  if (bytes.size() < length) return fail(name, "holds less than the byteLength of its buffer view");
  bytes.resize(length);

  document.json["buffers"].push_back({{"byteLength", length}});
  view["buffer"] = document.buffers.size();
  document.buffers.push_back(std::move(bytes));
  view.erase("byteOffset");
  view["extensions"].erase(extension_name);
  if (view["extensions"].empty()) view.erase("extensions");
  return {};
}

}  // namespace

Result<void> expand_meshopt(Document& document, Budget& budget) {
  for (const char* name : names) {
    const size_t count = member(document.json, "bufferViews").size();
    for (size_t i = 0; i < count; i++)
      if (extension(document.json["bufferViews"][i], name).is_object())
        LW_CHECK(expand_view(document, i, name, budget));
    forget_extension(document.json, name);
  }
  return {};
}

}  // namespace lightwell
