// SPDX-License-Identifier: Apache-2.0
#include "lightwell/base/file.h"
#include "lightwell/cli/arguments.h"
#include "lightwell/cli/input_file.h"
#include "lightwell/cli/light_source.h"
#include "lightwell/cli/pack_name.h"
#include "lightwell/packing/light_volume.h"
#include "lightwell/packing/unpack.h"
#include "lightwell/scene/import_gltf.h"
#include "lightwell/scene/write_ply.h"

namespace lightwell {
namespace {

struct Options {
  std::string pack;
  std::string output;  // of the geometry; empty: none
  MeshLevel level;
  std::string light;  // the output of the light; empty: none
  int nodes = 0;      // of the light, on the longest axis; 0: those of the pack
};

// All instances as one mesh in scene space.
Mesh merge(const Scene& scene) {
  Mesh merged;
  bool normals = true;
  for (const Instance& instance : scene.instances)
    normals = normals && !scene.primitives[static_cast<size_t>(instance.primitive)].mesh.normals.empty();
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.primitives[static_cast<size_t>(instance.primitive)].mesh;
    const auto first = static_cast<uint32_t>(merged.positions.size());
    for (const Vec3f& p : mesh.positions) merged.positions.push_back(instance.to_scene.point(p));
    if (normals)
      for (const Vec3f& n : mesh.normals) merged.normals.push_back(instance.to_scene.normal(n));
    const bool mirrored = instance.to_scene.determinant() < 0;
    for (const Face& f : mesh.faces)
      merged.faces.push_back({first + f[0], first + f[mirrored ? 2 : 1], first + f[mirrored ? 1 : 2]});
  }
  return merged;
}

using Figures = nlohmann::ordered_json;

Result<void> write_geometry(const Options& options, const OpenedPack& pack, Report& report, Figures& figures) {
  LW_TRY(document, unpack_document(pack, options.level, report));
  LW_CHECK(unpack_parts(pack, document));
  LW_TRY(scene, scene_from_document(document, "", report, pack.identity().origin, highest_image_limit));
  size_t vertices = 0, faces = 0;
  for (const Primitive& primitive : scene.primitives) {
    vertices += primitive.mesh.positions.size();
    faces += primitive.mesh.faces.size();
  }
  figures["vertices"] = vertices;
  figures["faces"] = faces;
  if (options.output.ends_with(".ply")) return write_file(options.output, write_ply(merge(scene), scene.origin));
  LW_TRY(glb, write_glb(std::move(document), report));
  return write_file(options.output, glb);
}

template <typename T>
Figures by_axis(const Vec<T, 3>& numbers) {
  return {{"x", numbers[0]}, {"y", numbers[1]}, {"z", numbers[2]}};
}

// The grid of highest priority says where the nodes are, and how many, unless --grid does.
GridShape shape_of(const LightField& field, int nodes) {
  const GridShape& shape = field.layers().front().grid.shape;
  return nodes > 0 ? GridShape::over({shape.lo, shape.hi()}, nodes) : shape;
}

Result<void> write_light(const Options& options, const OpenedPack& pack, Figures& figures) {
  LW_TRY(field, light_of_pack(pack, LightLevel{}));
  const LightVolume volume = sample_volume(field, shape_of(field, options.nodes), pack.identity().origin);
  figures["nodes"] = by_axis(volume.shape.nodes);
  figures["center"] = by_axis(volume.center());
  figures["size"] = by_axis(volume.size());
  if (options.light.ends_with(".ktx2")) return write_file(options.light, bevy_irradiance_volume(volume));
  return write_file(options.light, as_bytes(three_light_probe_grid(volume)));
}

Result<Figures> write(const Options& options, Report& report) {
  for (const std::string& output : {options.output, options.light})
    if (!output.empty()) LW_CHECK(check_output(output, {options.pack}));
  LW_CHECK(refuse_builtin_scene(options.pack));
  LW_TRY(pack, with_input(options.pack, OpenedPack::open_file));
  Figures figures;
  if (!options.output.empty()) LW_CHECK(write_geometry(options, pack, report, figures));
  if (!options.light.empty()) LW_CHECK(write_light(options, pack, figures));
  return figures;
}

}  // namespace

CLI::App* add_export(CLI::App& program, Console& console, std::function<int()>& chosen) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add_subcommand("export", "Writes the geometry of a pack at a level, or its light, as ordinary files");
  command->add_option("pack", options->pack, "A pack; - is stdin")->required()->type_name("");
  add_output(*command, options->output, {".glb", ".ply"}, "The geometry: FILE.glb, FILE.ply, or - for a GLB on stdout");
  add_level_option(*command, options->level, "The coarsest level with at least this share of the final faces, 0 to 1");
  add_number(*command, "--error", options->level.error, {0, 1e9},
             "Largest error in a mesh's own units, instead of a share");
  add_output(*command, options->light, {".json", ".ktx2"},
             "The light at regular nodes: FILE.json, a LightProbeGrid of three.js, or FILE.ktx2, an irradiance volume "
             "of Bevy; - is JSON on stdout",
             "--light");
  add_whole(*command, "--grid", options->nodes, {2, 256},
            "Of --light: nodes on the longest axis (default: those of the pack, whose finer cells are then left out)")
      ->default_str("");
  command->footer(
      "Examples:\n  lightwell export room.lw.glb --level 0.1 -o coarse.glb\n"
      "  lightwell export room.lw.glb --light room.ktx2 --grid 32");
  command->callback([=, &console, &chosen] {
    if (options->output.empty() && options->light.empty())
      throw CLI::ValidationError("-o FILE or --light FILE", "one of them is needed");
    if (command->count("--error") > 0 && command->count("--level") == 0) options->level.share = 0;
    chosen = [=, &console] {
      Report report;
      auto figures = write(*options, report);
      console.warn(report);
      if (!figures) return console.fail(in_file(figures.error(), options->pack));
      if (options->output != "-" && options->light != "-") console.print(*figures);
      return 0;
    };
  });
  return command;
}

}  // namespace lightwell
