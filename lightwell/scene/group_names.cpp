// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/group_names.h"

namespace lightwell {
namespace {

/// "Lamp.001", "Lamp 2" and "Lamp_3" are all "Lamp".
std::string without_number(const std::string& name) {
  const size_t end = name.find_last_not_of("0123456789");
  if (end == std::string::npos || end + 1 == name.size()) return name;
  const size_t last = name.find_last_not_of(" ._-", end);
  return last == std::string::npos ? name : name.substr(0, last + 1);
}

/// The node above each node; -1 for a root.
std::vector<int> parents_of(const Json& nodes) {
  std::vector<int> parents(nodes.size(), -1);
  for (size_t node = 0; node < nodes.size(); node++)
    for (const Json& child : member(nodes[node], "children"))
      if (const int64_t number = whole_number(child); number >= 0 && static_cast<size_t>(number) < parents.size())
        parents[static_cast<size_t>(number)] = static_cast<int>(node);
  return parents;
}

}  // namespace

std::vector<std::string> group_names(const Scene& scene, GroupedBy by) {
  const Json& nodes = member(scene.document.json, "nodes");
  const std::vector<int> parents = parents_of(nodes);
  const auto name = [&](int node) { return node < 0 ? std::string() : text(nodes[static_cast<size_t>(node)], "name"); };
  const auto in_extras = [&](int node) {
    std::string group;
    for (; node >= 0 && group.empty(); node = parents[static_cast<size_t>(node)])
      group = text(member(nodes[static_cast<size_t>(node)], "extras"), "lightGroup");
    return group;
  };
  std::vector<std::string> names;
  for (int node = 0; node < static_cast<int>(nodes.size()); node++) switch (by) {
      case GroupedBy::nothing: names.emplace_back(); break;
      case GroupedBy::extras: names.push_back(in_extras(node)); break;
      case GroupedBy::collection: names.push_back(name(parents[static_cast<size_t>(node)])); break;
      case GroupedBy::name: names.push_back(without_number(name(node))); break;
    }
  return names;
}

}  // namespace lightwell
