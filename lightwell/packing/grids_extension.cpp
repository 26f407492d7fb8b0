// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/grids_extension.h"

#include <algorithm>

#include "lightwell/packing/member_reader.h"

namespace lightwell {
namespace {

Json contents_json(const GridContents& contents) {
  Json json = Json::array();
  if (contents.indirect) json.push_back("indirect");
  if (contents.environment) json.push_back("environment");
  if (contents.lamps) json.push_back("lamps");
  return json;
}

Json grid_json(const GridDescription& grid) {
  Json json{{"stream", grid.stream},
            {"min", to_json(grid.shape.lo)},
            {"cell", to_json(grid.shape.cell)},
            {"nodes", to_json(grid.shape.nodes)},
            {"codec", grid.codec},
            {"normalOffset", to_json(grid.normal_offset)},
            {"estimatedError", to_json(grid.estimated_error)},
            {"estimate", {{"surface", to_json(grid.estimate.surface)}, {"free", to_json(grid.estimate.free)}}},
            {"priority", grid.priority},
            {"contains", contents_json(grid.contains)}};
  if (!grid.contains.group.empty()) json["group"] = grid.contains.group;
  for (const BricksDescription& bricks : grid.bricks)
    json["bricks"].push_back({{"stream", bricks.stream}, {"min", to_json(bricks.lo)}, {"max", to_json(bricks.hi)}});
  return json;
}

GridContents read_contents(MemberReader& reader) {
  GridContents contents{.indirect = false};
  for (const Json& what : reader.array("contains"))
    if (what == "indirect")
      contents.indirect = true;
    else if (what == "environment")
      contents.environment = true;
    else if (what == "lamps")
      contents.lamps = true;
    else
      reader.refuse("contains", "names an unknown light");
  if (reader.has("group")) contents.group = reader.string("group");
  return contents;
}

Result<std::vector<BricksDescription>> read_bricks(const Json& list, const std::string& name) {
  std::vector<BricksDescription> bricks;
  for (size_t i = 0; i < list.size(); i++) {
    MemberReader reader(list[i], name + ".bricks[" + std::to_string(i) + "]");
    LW_TRY(read, reader.finish(BricksDescription{reader.whole("stream"), reader.vector("min"), reader.vector("max")}));
    bricks.push_back(read);
  }
  return bricks;
}

Result<GridDescription> read_grid(const Json& json, const std::string& name) {
  MemberReader reader(json, name);
  GridDescription grid;
  grid.stream = reader.whole("stream");
  grid.shape = {reader.vector("min"), reader.vector("cell"), reader.whole_vector("nodes")};
  grid.codec = reader.whole("codec");
  grid.normal_offset = reader.real("normalOffset");
  grid.estimated_error = reader.real("estimatedError");
  MemberReader estimate(reader.object("estimate"), name + ".estimate");
  grid.estimate = {.surface = estimate.real("surface"), .free = estimate.real("free")};
  LW_CHECK(estimate.finish(true));
  grid.priority = static_cast<int>(reader.whole("priority"));
  grid.contains = read_contents(reader);
  if (reader.has("bricks")) {
    LW_TRY(bricks, read_bricks(reader.array("bricks"), name));
    grid.bricks = std::move(bricks);
  }
  return reader.finish(grid);
}

}  // namespace

BricksDescription describe_bricks(const GridShape& shape, const BrickRegion& region, uint32_t stream) {
  return {stream, shape.position(region.lo), shape.position(region.hi)};
}

Json to_json(std::span<const GridDescription> grids) {
  Json list = Json::array();
  for (const GridDescription& grid : grids) list.push_back(grid_json(grid));
  return {{"grids", std::move(list)}};
}

Result<std::vector<GridDescription>> read_grids(const Json& json) {
  MemberReader reader(extension(json, grids_extension), grids_extension);
  const Json& list = reader.array("grids");
  LW_CHECK(reader.finish(true));
  std::vector<GridDescription> grids;
  for (size_t i = 0; i < list.size(); i++) {
    LW_TRY(grid, read_grid(list[i], reader.name_of("grids", i)));
    grids.push_back(grid);
  }
  return grids;
}

GridContents contents_of(std::span<const GridDescription> grids) {
  GridContents all{.indirect = false};
  for (const GridDescription& grid : grids) {
    all.indirect |= grid.contains.indirect;
    all.environment |= grid.contains.environment;
    all.lamps |= grid.contains.lamps;
  }
  return all;
}

}  // namespace lightwell
