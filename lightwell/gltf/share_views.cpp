// SPDX-License-Identifier: Apache-2.0
#include <map>

#include "lightwell/gltf/accessor.h"
#include "lightwell/gltf/references.h"

namespace lightwell {
namespace {

/// The use of an accessor. The numbers are glTF's targets of buffer views.
enum class Role { unused = 0, other = 1, vertices = 34962, indices = 34963 };

/// The properties shared by all arrays of a view: role and bytes from one element to the next.
using ViewKind = std::pair<Role, size_t>;

struct Uses {
  std::vector<Role> accessors;  ///< `other` when there are several roles, or none in a mesh
  std::vector<int> views;       ///< number of references to each
};

Uses uses_of(const Json& json) {
  Uses uses{std::vector<Role>(member(json, "accessors").size(), Role::unused),
            std::vector<int>(member(json, "bufferViews").size())};
  for_each_reference(json, "bufferViews", [&](const Json& value, std::string_view, const ReferencePlace&) {
    const auto index = static_cast<size_t>(whole_number(value));
    if (index < uses.views.size()) uses.views[index]++;
  });
  for_each_reference(json, "accessors", [&](const Json& value, std::string_view, const ReferencePlace& place) {
    const auto index = static_cast<size_t>(whole_number(value));
    if (index >= uses.accessors.size()) return;
    const bool of_mesh = place.pattern().starts_with("meshes[");
    const Role role = !of_mesh ? Role::other : place.pattern().ends_with(".indices") ? Role::indices : Role::vertices;
    Role& known = uses.accessors[index];
    known = known == Role::unused || known == role ? role : Role::other;
  });
  // Views referenced only by unused accessors do not keep other accessors from moving.
  for (size_t i = 0; i < uses.accessors.size(); i++) {
    const int view = index_of(json["accessors"][i], "bufferView");
    if (uses.accessors[i] == Role::unused && view >= 0 && static_cast<size_t>(view) < uses.views.size())
      uses.views[static_cast<size_t>(view)]--;
  }
  return uses;
}

/// Whether an accessor's elements can move into a shared view: they have a view of their own without gaps, and vertices
/// take a multiple of four bytes, as glTF requires of strides.
bool movable(const Document& document, const Uses& uses, size_t accessor) {
  const Role role = uses.accessors[accessor];
  const auto data = locate(document, static_cast<int>(accessor));
  if ((role != Role::vertices && role != Role::indices) || !data || data->type.columns != 1) return false;
  const auto view = static_cast<size_t>(index_of(document.json["accessors"][accessor], "bufferView"));
  return uses.views[view] == 1 && data->stride == data->type.size() && (role == Role::indices || data->stride % 4 == 0);
}

}  // namespace

void share_buffer_views(Document& document) {
  const Uses uses = uses_of(document.json);
  std::map<ViewKind, std::vector<size_t>> kinds;
  for (size_t i = 0; i < uses.accessors.size(); i++)
    if (movable(document, uses, i)) {
      const size_t stride = element_type(document.json["accessors"][i]).size();
      kinds[{uses.accessors[i], stride}].push_back(i);
    }

  for (const auto& [kind, members] : kinds) {
    const auto [role, stride] = kind;
    std::vector<uint8_t> shared;
    const size_t view = document.json["bufferViews"].size();
    for (const size_t index : members) {
      const AccessorData data = locate(document, static_cast<int>(index)).value();
      const Bytes elements = data.bytes.first(data.count * stride);
      Json& accessor = document.json["accessors"][index];
      accessor["bufferView"] = view;
      accessor.erase("byteOffset");
      if (!shared.empty()) accessor["byteOffset"] = shared.size();
      shared.insert(shared.end(), elements.begin(), elements.end());
    }
    append_buffer_view(document, std::move(shared), role == Role::vertices ? stride : 0, static_cast<int>(role));
  }
}

}  // namespace lightwell
