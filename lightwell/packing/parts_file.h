// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "lightwell/asset/parts_asset.h"
#include "lightwell/gltf/json.h"

namespace lightwell {

/// The LIGHTWELL_parts extension (docs/format.md): which stream tells of the parts that the pack's last mesh was merged
/// from, and what of the opening is the file's own.
inline constexpr const char* parts_extension = "LIGHTWELL_parts";

struct PartsDescription {
  uint32_t stream = 0;
  uint32_t nodes = 0;      ///< of the opening that are the file's; the next one shows the merged mesh
  uint32_t meshes = 0;     ///< likewise
  uint32_t materials = 0;  ///< of the opening, all of them the file's

  bool operator==(const PartsDescription&) const = default;
};

Json to_json(const PartsDescription& description);

/// Reads it from a pack's JSON, where that has it. Fails where it is invalid, or nodes and meshes are not so many.
Result<std::optional<PartsDescription>> read_parts_description(const Json& json);

/// What the stream says: the nodes, meshes and materials of the file that the opening does not have, which are numbered
/// behind its own.
struct PartsFile {
  /// A primitive of a node's mesh.
  struct Part {
    uint32_t node = 0;
    uint32_t primitive = 0;
  };
  /// A primitive of the merged mesh.
  struct Merged {
    std::vector<Part> parts;
    std::vector<uint32_t> table;  ///< part_table() of its final level
  };

  Json nodes = Json::array();
  Json meshes = Json::array();     ///< their primitives without arrays
  Json materials = Json::array();  ///< for which others stand that differ in name and extras alone
  Json roots = Json::array();      ///< [node, parent]: of nodes that an own node holds, or (-1) the scene
  Json shown = Json::array();      ///< [node, mesh]: meshes that own nodes show
  std::vector<Merged> merged;
};

/// The stream's gzip file, and its sizes. What repeats itself more than a reader takes is not compressed.
std::vector<uint8_t> write_parts_file(const PartsFile& file, PartsParameters& parameters);

/// Reads it. Fails where it is damaged, or larger than `inflated`, or not as the format says; what its nodes and meshes
/// hold is not checked.
Result<PartsFile> read_parts_file(Bytes bytes, uint32_t inflated);

}  // namespace lightwell
