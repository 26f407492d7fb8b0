// SPDX-License-Identifier: Apache-2.0
#include "lightwell/base/file.h"
#include "lightwell/cli/arguments.h"
#include "lightwell/cli/pack_name.h"
#include "lightwell/packing/unpack.h"
#include "lightwell/scene/import_gltf.h"
#include "lightwell/scene/write_ply.h"

namespace lightwell {
namespace {

struct Options {
  std::string pack;
  std::string output;
  MeshLevel level;
};

struct Outcome {
  size_t vertices = 0, faces = 0;
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

Result<Outcome> write(const Options& options, Report& report) {
  LW_CHECK(check_output(options.output, {options.pack}));
  LW_CHECK(refuse_builtin_scene(options.pack));
  LW_TRY(pack, OpenedPack::open_file(options.pack));
  LW_TRY(document, unpack_document(pack, options.level, report));
  LW_TRY(scene, scene_from_document(document, "", report, pack.identity().origin, highest_image_limit));
  Outcome outcome;
  for (const Primitive& primitive : scene.primitives) {
    outcome.vertices += primitive.mesh.positions.size();
    outcome.faces += primitive.mesh.faces.size();
  }
  if (options.output.ends_with(".ply")) {
    LW_CHECK(write_file(options.output, write_ply(merge(scene), scene.origin)));
    return outcome;
  }
  LW_TRY(glb, write_glb(std::move(document), report));
  LW_CHECK(write_file(options.output, glb));
  return outcome;
}

}  // namespace

CLI::App* add_export(CLI::App& program, Console& console, std::function<int()>& chosen) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("export", "Writes the geometry of a pack at a level as an ordinary file");
  command->add_option("pack", options->pack, "A pack")->required()->type_name("");
  add_output(*command, options->output, {".glb", ".ply"}, "FILE.glb, FILE.ply, or - for a GLB on stdout")->required();
  add_level_option(*command, options->level, "The coarsest level with at least this share of the final faces, 0 to 1");
  add_number(*command, "--error", options->level.error, {0, 1e9},
             "Largest error in a mesh's own units, instead of a share");
  command->footer("Example:\n  lightwell export room.lw.glb --level 0.1 -o coarse.glb");
  command->callback([=, &console, &chosen] {
    if (command->count("--error") > 0 && command->count("--level") == 0) options->level.share = 0;
    chosen = [=, &console] {
      Report report;
      auto outcome = write(*options, report);
      console.warn(report);
      if (!outcome) return console.fail(in_file(outcome.error(), options->pack));
      if (options->output != "-") console.print({{"vertices", outcome->vertices}, {"faces", outcome->faces}});
      return 0;
    };
  });
  return command;
}

}  // namespace lightwell
