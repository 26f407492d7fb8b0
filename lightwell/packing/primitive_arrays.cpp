// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/primitive_arrays.h"

namespace lightwell {

bool has_attribute(const Mesh& mesh, const std::string& name) {
  return name == "POSITION" || (name == "NORMAL" && !mesh.normals.empty()) ||
         (name == "TEXCOORD_0" && !mesh.texcoords[0].empty()) || (name == "TEXCOORD_1" && !mesh.texcoords[1].empty()) ||
         (name == "COLOR_0" && !mesh.colors.empty());
}

void take_arrays(Json& primitive, const std::function<bool(const std::string& name)>& has,
                 std::set<std::string>& lost) {
  constexpr size_t longest_name = 40;
  for (const auto& attribute : member(primitive, "attributes").items())
    if (!has(attribute.key())) lost.insert(attribute.key().substr(0, longest_name));
  for (const Json& target : member(primitive, "targets"))
    for (const auto& displacement : target.items())
      if (displacement.key() != "POSITION" && displacement.key() != "NORMAL")
        lost.insert(displacement.key().substr(0, longest_name));
  for (const char* name : {"mode", "attributes", "indices", "targets"}) primitive.erase(name);
}

}  // namespace lightwell
