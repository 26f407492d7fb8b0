// SPDX-License-Identifier: Apache-2.0
#include "lightwell/cli/info_text.h"

#include <map>

#include "lightwell/cli/number_text.h"

namespace lightwell {
namespace {

using Figures = nlohmann::ordered_json;

// "1 x 1 x 1"
std::string joined(const Figures& list, const std::string& between) {
  std::string text;
  for (const Figures& item : list)
    text += (text.empty() ? "" : between) + (item.is_number() ? short_number(item) : item.get<std::string>());
  return text;
}

std::string mesh_text(const Figures& mesh) {
  return counted(mesh["faces"].get<uint64_t>(), "face") + ", " + grouped(mesh["vertices"]) + " vertices, " +
         short_number(mesh["bits_per_vertex"]) + " bits a vertex";
}

std::string grid_text(const Figures& grid) {
  std::string text = joined(grid["nodes"], " x ") + " nodes, cells of " + joined(grid["cell"], " x ") + " m, ";
  if (grid["bricks"] > 0)
    text += counted(grid["bricks"], "brick") + " of " + counted(grid["levels"], "level") + ", " +
            grouped(grid["all_nodes"]) + " nodes in all, ";
  text += short_number(grid["bytes_per_node"]) + " bytes a node, light: " + joined(grid["contains"], ", ");
  if (grid.contains("group")) text += ", group " + grid["group"].get<std::string>();
  const char* before = ", estimated error ";
  for (const auto& [kind, where] : {std::pair{"surface", "on surfaces"}, {"free", "in free space"}}) {
    const double error = grid["estimate"][kind].get<double>();
    if (error <= 0) continue;  // there were no points of the kind
    text += before + short_number(100 * error) + " % " + where;
    before = ", ";
  }
  return text;
}

// The unit of a member of a lamp (docs/format.md).
std::string unit_of(const std::string& member, const std::string& kind) {
  static const std::map<std::string, std::string> units = {{"center", " m"},
                                                           {"u", " m"},
                                                           {"v", " m"},
                                                           {"radius", " m"},
                                                           {"range", " m"},
                                                           {"innerConeAngle", " rad"},
                                                           {"outerConeAngle", " rad"},
                                                           {"radiance", " W/m2/sr"}};
  if (member == "intensity") return kind == "sun" ? " W/m2" : " W/sr";
  const auto found = units.find(member);
  return found == units.end() ? "" : found->second;
}

std::string lamp_text(const Figures& lamp) {
  const std::string kind = lamp.value("kind", "");
  std::string text = kind;
  for (const auto& [member, value] : lamp.items()) {
    if (member == "kind") continue;
    text.append(", ").append(member).append(" ");
    text += value.is_array() ? joined(value, " ") : value.is_string() ? value.get<std::string>() : value.dump();
    text += unit_of(member, kind);
  }
  return text;
}

std::string stream_text(const Figures& stream) {
  std::string text = stream["kind"].get<std::string>() + ", codec " + stream["codec"].dump() + ", " +
                     counted(stream["blocks"], "block") + ", " + size_text(stream["bytes"]);
  if (!stream.contains("rows")) return text;
  for (size_t i = 0; const Figures& row : stream["rows"])
    text += "\n  block " + std::to_string(i++) + ": " + size_text(row["bytes"]) + ", adds " + grouped(row["adds"]) +
            ", error " + short_number(row["error"]);
  return text;
}

// One numbered line for each item of a list.
std::string lines(const Figures& list, const std::string& name, std::string (*text)(const Figures&)) {
  std::string all;
  for (size_t i = 0; const Figures& item : list) all += name + " " + std::to_string(i++) + ": " + text(item) + "\n";
  return all;
}

}  // namespace

std::string info_text(const Figures& figures) {
  const std::string scene = figures["scene"].get<std::string>();
  const bool moved = figures["origin"] != Figures{0.0, 0.0, 0.0};
  return "scene: " + (scene.empty() ? "(no name)" : scene) + "\n" + "id: " + figures["id"].get<std::string>() + "\n" +
         (moved ? "origin: " + joined(figures["origin"], " ") + " m\n" : "") +
         lines(figures["meshes"], "mesh", mesh_text) + lines(figures["grids"], "grid", grid_text) +
         lines(figures["lamps"], "lamp", lamp_text) + lines(figures["streams"], "stream", stream_text);
}

}  // namespace lightwell
