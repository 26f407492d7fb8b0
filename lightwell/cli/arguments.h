// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "lightwell/bake/light_bake.h"
#include "lightwell/cli/command.h"
#include "lightwell/cli/option_kinds.h"
#include "lightwell/packing/unpack.h"
#include "lightwell/scene/scene.h"

namespace lightwell {

/// The options of the commands that trace light through a scene.
struct SceneOptions {
  std::string path;          ///< a scene file, a pack, or the name of a built-in scene
  std::string environment;   ///< "R,G,B", or the name of a Radiance .hdr file; empty: the scene's own
  std::optional<float> sky;  ///< its turbidity: light by the physical sky of the scene's sun
  ImportOptions import;
  std::optional<int> nodes;  ///< of a regular grid; without, the grid is adaptive if the method can fill it
  uint64_t photons = 8'000'000;
  const EstimatorKind* method = &estimators().front();
  GroupedBy groups = GroupedBy::nothing;  ///< of light
  int threads = 0;                        ///< 0: all processors
  uint64_t memory_limit = 0;              ///< bytes; 0: what the machine has
  static constexpr int regular = 32;      ///< nodes of a regular grid where nothing is said

  /// The options for baking its light grid; `contained` as in EstimatorOptions.
  LightBakeOptions light(const LuminaireSet& contained) const {
    return {.nodes = nodes.value_or(method->node_by_node ? 0 : regular),
            .method = method,
            .estimator = {.photons = photons, .seed = import.seed, .contained = contained, .threads = threads}};
  }
};

/// Adds the scene and --grid, --photons, --method, --groups, --environment, --sky, --up, --unit, --lamp-units,
/// --max-image-megapixels, --seed, --threads and --memory-limit. `help` says what the scene may be.
void add_scene_options(CLI::App& command, SceneOptions& options, const std::string& help);

/// Adds --level, the share of a pack's faces, or --fill, how missing nodes of its light grid are filled.
void add_level_option(CLI::App& command, MeshLevel& level, const std::string& help);
void add_fill_option(CLI::App& command, Fill& fill, const std::string& help);
/// Adds --light-level, the share of a pack's light, --fill and --lookup.
void add_light_level_options(CLI::App& command, LightLevel& level);

/// Reads "R,G,B", three numbers that are not negative.
Result<Vec3f> parse_color(const std::string& text);

/// Reads the value of --environment: "R,G,B", or the name of a Radiance .hdr file.
Result<Environment> read_environment(const std::string& argument, ImageLimit limit);

}  // namespace lightwell
