// SPDX-License-Identifier: Apache-2.0
#include "lightwell/base/file.h"
#include "lightwell/cli/command.h"
#include "lightwell/cli/option_kinds.h"
#include "lightwell/scene/builtin.h"
#include "lightwell/scene/import_gltf.h"

namespace lightwell {
namespace {

struct Options {
  std::string name;
  std::string output;
  uint64_t seed = 1;
};

size_t count_triangles(const Scene& scene) {
  size_t triangles = 0;
  for (const Instance& instance : scene.instances)
    triangles += scene.primitives[static_cast<size_t>(instance.primitive)].mesh.faces.size();
  return triangles;
}

size_t count_lights(const Scene& scene) {
  size_t lights = scene.lamps.size();
  for (const Instance& instance : scene.instances)
    lights += max_component(scene.material_of(scene.primitives[static_cast<size_t>(instance.primitive)]).emission) > 0;
  return lights;
}

int list(const Options& options, const Console& console) {
  nlohmann::ordered_json scenes = nlohmann::ordered_json::array();
  for (const BuiltinScene& builtin : builtin_scenes()) {
    Report report;
    auto scene = scene_from_document(builtin.make(options.seed), std::string(builtin.name), report);
    if (!scene) return console.fail(in_file(scene.error(), std::string(builtin.name)));
    if (console.json)
      scenes.push_back(
          {{"name", builtin.name}, {"triangles", count_triangles(*scene)}, {"lights", count_lights(*scene)}});
    else
      std::printf("%-10s %8zu triangles  %s\n", std::string(builtin.name).c_str(), count_triangles(*scene),
                  std::string(builtin.description).c_str());
  }
  if (console.json) console.print({{"scenes", scenes}});
  return 0;
}

int write(const Options& options, const Console& console) {
  const BuiltinScene* builtin = find_builtin_scene(options.name);
  if (builtin == nullptr)
    return console.fail({options.name, "", "is no built-in scene; `lightwell scenes` lists them"});
  if (auto writable = check_writable(options.output); !writable) return console.fail(writable.error());
  Report report;
  auto glb = write_glb(builtin->make(options.seed), report);
  if (!glb) return console.fail(in_file(glb.error(), options.name));
  console.warn(report);
  auto written = write_file(options.output, *glb);
  return written ? 0 : console.fail(written.error());
}

}  // namespace

CLI::App* add_scenes(CLI::App& program, Console& console, std::function<int()>& chosen) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("scenes", "Lists the built-in scenes, or writes one as glTF");
  command->add_option("name", options->name, "The scene to write")->type_name("");
  add_output(*command, options->output, {".glb"}, "The file to write, FILE.glb; - is stdout");
  add_whole(*command, "--seed", options->seed, seed_range, "Seed of the scene's relief");
  command->footer("Examples:\n  lightwell scenes\n  lightwell scenes box-small -o box-small.glb");
  command->callback([=, &console, &chosen] {
    if (options->name.empty() != options->output.empty())
      throw CLI::ValidationError("scenes", "a scene's NAME and -o FILE.glb go together");
    chosen = [=, &console] { return options->name.empty() ? list(*options, console) : write(*options, console); };
  });
  return command;
}

}  // namespace lightwell
