// SPDX-License-Identifier: Apache-2.0
#include <map>

#include "lightwell/gltf/accessor.h"
#include "lightwell/gltf/references.h"

namespace lightwell {
namespace {

constexpr int array_buffer = 34962;

/// What the arrays of one view have in common: glTF's target, and bytes from an element to the next.
struct ViewKind {
  int target = 0;
  size_t stride = 0;

  auto operator<=>(const ViewKind&) const = default;
};

std::vector<int> references_to_views(const Json& json) {
  std::vector<int> references(member(json, "bufferViews").size());
  for_each_reference(json, [&](const Json& value, std::string_view to, const std::string&) {
    const int64_t index = whole_number(value);
    if (to == "bufferViews" && index >= 0 && static_cast<size_t>(index) < references.size())
      references[static_cast<size_t>(index)]++;
  });
  return references;
}

/// The kind of view that could hold an accessor's elements; target 0 when they have to stay where they are. A stride
/// is a multiple of four, as glTF asks of vertices.
ViewKind kind_of(const Document& document, int accessor, const std::vector<int>& references) {
  const Json& json = document.json["accessors"][static_cast<size_t>(accessor)];
  const int index = index_of(json, "bufferView");
  if (index < 0 || references[static_cast<size_t>(index)] != 1 || !locate(document, accessor)) return {};
  const Json& view = document.json["bufferViews"][static_cast<size_t>(index)];
  const ViewKind kind{index_of(view, "target"), element_type(json).size()};
  const bool aligned = kind.target != array_buffer || kind.stride % 4 == 0;
  return aligned && kind.target > 0 && !view.contains("byteStride") ? kind : ViewKind{};
}

}  // namespace

void share_buffer_views(Document& document) {
  drop_unused(document);
  const std::vector<int> references = references_to_views(document.json);
  std::map<ViewKind, std::vector<size_t>> accessors;
  for (size_t i = 0; i < member(document.json, "accessors").size(); i++)
    if (const ViewKind kind = kind_of(document, static_cast<int>(i), references); kind.target > 0)
      accessors[kind].push_back(i);

  for (const auto& [kind, members] : accessors) {
    std::vector<uint8_t> shared;
    const size_t view = document.json["bufferViews"].size();
    for (const size_t index : members) {
      const AccessorData data = locate(document, static_cast<int>(index)).value();
      const Bytes elements = data.bytes.first(data.count * kind.stride);
      Json& accessor = document.json["accessors"][index];
      accessor["bufferView"] = view;
      accessor.erase("byteOffset");
      if (!shared.empty()) accessor["byteOffset"] = shared.size();
      shared.insert(shared.end(), elements.begin(), elements.end());
    }
    append_buffer_view(document, std::move(shared), kind.target == array_buffer ? kind.stride : 0, kind.target);
  }
  drop_unused(document);
}

}  // namespace lightwell
