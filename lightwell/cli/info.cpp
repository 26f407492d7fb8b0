// SPDX-License-Identifier: Apache-2.0
#include "lightwell/asset/light_asset.h"
#include "lightwell/asset/mesh_asset.h"
#include "lightwell/cli/command.h"
#include "lightwell/cli/info_text.h"
#include "lightwell/cli/input_file.h"
#include "lightwell/cli/pack_name.h"
#include "lightwell/packing/lamps_extension.h"
#include "lightwell/packing/opened_pack.h"
#include "lightwell/packing/unpack.h"

namespace lightwell {
namespace {

using Figures = nlohmann::ordered_json;

Figures stream_figures(const PackReader& pack, size_t stream, bool blocks) {
  const StreamEntry& entry = pack.directory().streams[stream];
  Figures figures{
      {"kind", to_text(entry.kind)}, {"codec", entry.codec}, {"blocks", entry.blocks}, {"bytes", entry.length}};
  if (blocks)
    for (const BlockRow& row : pack.rows(stream))
      figures["rows"].push_back({{"bytes", row.length}, {"adds", row.adds}, {"error", row.error}});
  return figures;
}

Result<Figures> mesh_figures(const PackReader& pack, size_t stream) {
  LW_TRY(mesh, open_asset_as<MeshAsset>(pack, stream));
  const MeshLayout& layout = mesh->layout();
  const StreamEntry& entry = pack.directory().streams[stream];
  return Figures{{"vertices", layout.vertices},
                 {"faces", layout.faces},
                 {"bits_per_vertex", 8.0 * entry.length / std::max(1u, layout.vertices - layout.base_vertices)}};
}

Result<Figures> grid_figures(const OpenedPack& pack, const GridDescription& grid) {
  LW_TRY(light, open_asset_as<LightAsset>(pack.reader(), grid.stream));
  const Json said = to_json(std::span(&grid, 1))["grids"][0];
  const std::vector<StreamEntry>& streams = pack.reader().directory().streams;
  double bytes = streams[grid.stream].length;
  for (const BricksDescription& bricks : grid.bricks) bytes += streams[bricks.stream].length;
  BrickTree tree(light->shape().cells());
  for (const Brick& brick : light->bricks()) tree.add(brick);
  const size_t nodes = light->shape().count() + BrickNodes(tree).nodes().size();
  Figures figures{{"nodes", said["nodes"]},
                  {"cell", said["cell"]},
                  {"levels", tree.levels()},
                  {"bricks", light->bricks().size()},
                  {"all_nodes", nodes},
                  {"codec", grid.codec},
                  {"bytes_per_node", bytes / static_cast<double>(nodes)},
                  {"estimate", said["estimate"]},
                  {"contains", said["contains"]}};
  if (said.contains("group")) figures["group"] = said["group"];
  return figures;
}

Result<Figures> describe(const std::string& path, bool blocks) {
  LW_CHECK(refuse_builtin_scene(path));
  LW_TRY(pack, with_input(path, OpenedPack::open_file));
  const Directory& directory = pack.reader().directory();
  const Json& json = pack.json();
  const Json& scenes = member(json, "scenes");
  Figures figures{{"scene", text(element(scenes, static_cast<size_t>(std::max(0, index_of(json, "scene")))), "name")},
                  {"id", to_text(directory.id)},
                  {"origin", pack.identity().origin.e},
                  {"streams", Figures::array()},
                  {"meshes", Figures::array()},
                  {"grids", Figures::array()},
                  {"lamps", Figures::array()}};
  for (size_t i = 0; i < directory.streams.size(); i++) {
    figures["streams"].push_back(stream_figures(pack.reader(), i, blocks));
    if (directory.streams[i].kind != StreamKind::mesh) continue;
    LW_TRY(mesh, mesh_figures(pack.reader(), i));
    figures["meshes"].push_back(std::move(mesh));
  }
  for (const GridDescription& grid : pack.grids()) {
    LW_TRY(of_grid, grid_figures(pack, grid));
    figures["grids"].push_back(std::move(of_grid));
  }
  figures["lamps"] = to_json(pack.lamps())["lamps"];
  return figures;
}

}  // namespace

CLI::App* add_info(CLI::App& program, Console& console, std::function<int()>& chosen) {
  struct Options {
    std::string pack;
    bool blocks = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("info", "Tells what is in a pack");
  command->add_option("pack", options->pack, "A pack; - is stdin")->required()->type_name("");
  command->add_flag("--blocks", options->blocks,
                    "Every block, too: what it adds (vertices, nodes or bytes), and the error after it");
  command->footer("Example:\n  lightwell info room.lw.glb");
  command->callback([=, &console, &chosen] {
    chosen = [=, &console] {
      auto figures = describe(options->pack, options->blocks);
      if (!figures) return console.fail(in_file(figures.error(), options->pack));
      if (console.json)
        console.print(*figures);
      else
        std::fputs(info_text(*figures).c_str(), stdout);
      return 0;
    };
  });
  return command;
}

}  // namespace lightwell
