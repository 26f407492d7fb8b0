// SPDX-License-Identifier: Apache-2.0
#include "lightwell/cli/arguments.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "lightwell/base/file.h"
#include "lightwell/scene/physical_sky.h"
#include "lightwell/texture/image_file.h"
#include "lightwell/texture/radiance_hdr.h"

namespace lightwell {

namespace {

constexpr NumberRange unit_range = {1e-9, 1e9};

void add_grid_option(CLI::App& command, std::optional<int>& nodes) {
  const auto take = [&nodes](const std::string& text) -> Result<void> {
    nodes.reset();
    if (text == "auto") return {};
    const Result<int64_t> chosen = parse_whole(text, {2, 256});
    if (!chosen) return fail(text, "is neither auto nor a whole number from 2 to 256");
    nodes = static_cast<int>(*chosen);
    return {};
  };
  add_text(command, "--grid", "auto|N", take,
           "auto: cells of the light grid are finer where light changes; N: nodes on its longest axis, 2 to 256, all "
           "cells alike")
      ->default_str("auto");
}

CLI::Option* add_environment_option(CLI::App& command, std::string& environment) {
  const auto take = [&environment](const std::string& text) -> Result<void> {
    std::error_code unknown;
    environment = text;
    if (parse_color(text) || std::filesystem::exists(text, unknown)) return {};
    const std::string color = "R,G,B (three numbers that are not negative, such as 1,1,1)";
    if (text.find(',') == std::string::npos) return fail(text, "no such file, and it is not " + color);
    return fail(text, "is neither " + color + " nor the name of a file");
  };
  return add_text(command, "--environment", "R,G,B|FILE", take,
                  "Light from all around: radiance, or a Radiance .hdr file");
}

void add_image_limit_option(CLI::App& command, ImageLimit& limit) {
  constexpr int shift = 20;
  const auto take = [&limit](const std::string& text) -> Result<void> {
    LW_TRY(million, parse_whole(text, {1, static_cast<double>(highest_image_limit.pixels >> shift)}));
    limit.pixels = static_cast<uint64_t>(million) << shift;
    return {};
  };
  add_text(command, "--max-image-megapixels", "N", take, "Millions of pixels that an image may have, 1 to 512")
      ->default_str(std::to_string(limit.pixels >> shift));
}

/// Adds --up, --front, --rotate and --unit.
void add_orientation_options(CLI::App& command, Orientation& orientation) {
  const std::vector<std::pair<std::string, AxisDirection>> directions = {
      {"x", {0, false}}, {"-x", {0, true}}, {"y", {1, false}}, {"-y", {1, true}}, {"z", {2, false}}, {"-z", {2, true}}};
  add_choice<AxisDirection>(command, "--up", orientation.up, directions, "Where the file has up");
  std::vector<std::pair<std::string, std::optional<AxisDirection>>> fronts(directions.begin(), directions.end());
  add_choice<std::optional<AxisDirection>>(
      command, "--front", orientation.front, fronts,
      "Where the front of the file's object faces, which is seen first (default: z, of files with z up -y)");
  const auto take_angles = [&orientation](const std::string& text) -> Result<void> {
    std::istringstream stream(text);
    std::vector<std::string> words;
    for (std::string word; std::getline(stream, word, ',');) words.push_back(word);
    if (words.size() != 3 || text.back() == ',')
      return fail(text, "is not X,Y,Z (three angles in degrees, such as 0,90,0)");
    Vec3d angles{};
    for (int axis = 0; axis < 3; axis++) {
      LW_TRY(angle, parse_number(words[static_cast<size_t>(axis)], {-360, 360}));
      angles[axis] = angle;
    }
    orientation.rotate = angles;
    return {};
  };
  add_text(command, "--rotate", "X,Y,Z", take_angles,
           "Degrees by which the file is turned about its x axis, then y, then z, before --up and --front");
  add_number(command, "--unit", orientation.unit, unit_range, "Length of the file's unit in metres")->default_str("1");
}

}  // namespace

void add_scene_options(CLI::App& command, SceneOptions& options, const std::string& help) {
  command.add_option("scene", options.path, help)->required()->type_name("");
  add_grid_option(command, options.nodes);
  add_count(command, "--photons", options.photons, "Photons of --method tracks and faces: 5000, 200k, 8M, 1G",
            "a count, such as 5000, 200k, 8M or 1G")
      ->default_str("8M");
  add_row_choice(command, "--method", options.method, estimators());
  add_choice<GroupedBy>(command, "--groups", options.groups,
                        {{"none", GroupedBy::nothing},
                         {"extras", GroupedBy::extras},
                         {"collection", GroupedBy::collection},
                         {"name", GroupedBy::name}},
                        "Lamps that are switched and dimmed together, with their bounced light: by lightGroup in the "
                        "extras of their nodes, by the node above them, or by their own names less a number");
  CLI::Option* environment = add_environment_option(command, options.environment);
  add_optional_number(command, "--sky", options.sky, {least_turbidity, most_turbidity}, usual_turbidity,
                      "Light from the clear sky around the scene's sun, more or less hazy: turbidity, 1 to 10")
      ->excludes(environment);
  add_orientation_options(command, options.import.orientation);
  command
      .add_option("--scene", options.import.scene,
                  "Name or number of the file's scene that is shown (default: its own choice)")
      ->type_name("NAME");
  add_choice<LampUnits>(command, "--lamp-units", options.import.lamp_units,
                        {{"auto", LampUnits::automatic},
                         {"radiometric", LampUnits::radiometric},
                         {"photometric", LampUnits::photometric}},
                        "What lamps of KHR_lights_punctual are in: watts, as emission is, or lumens; auto: lumens in "
                        "files of Blender");
  add_image_limit_option(command, options.import.images);
  add_whole(command, "--seed", options.import.seed, seed_range, "Seed of everything random");
  add_whole(command, "--threads", options.threads, {0, 1024}, "Threads, 0 for all processors");
  add_count(command, "--memory-limit", options.memory_limit,
            "Bytes of memory, such as 500M or 8G: what needs more is refused (default: what the machine has)",
            "a count, such as 500M or 8G");
}

void add_level_option(CLI::App& command, MeshLevel& level, const std::string& help) {
  add_number(command, "--level", level.share, {0, 1}, help)->default_str("1");
}

void add_fill_option(CLI::App& command, Fill& fill, const std::string& help) {
  add_choice<Fill>(command, "--fill", fill,
                   {{"push-pull", Fill::push_pull}, {"push-pull-smooth", Fill::push_pull_smooth}, {"none", Fill::none}},
                   help);
}

void add_light_level_options(CLI::App& command, LightLevel& level) {
  add_number(command, "--light-level", level.share, {0, 1}, "Of a pack: share of the light grid's nodes, 0 to 1")
      ->default_str("1");
  add_fill_option(command, level.fill, "How the other nodes are filled");
  add_choice<LightLookup>(command, "--lookup", level.lookup,
                          {{"trilinear", LightLookup::trilinear}, {"tricubic", LightLookup::tricubic}},
                          "How the light between nodes is found: tricubic has no creases, but leaks more");
}

Result<Vec3f> parse_color(const std::string& text) {
  const char* at = text.c_str();
  Vec3f color;
  for (int i = 0; i < 3; i++) {
    char* end = nullptr;
    color[i] = std::strtof(at, &end);
    const char expected = i < 2 ? ',' : '\0';
    if (end == at || *end != expected || !std::isfinite(color[i]) || color[i] < 0) return fail(text, "is not R,G,B");
    at = end + 1;
  }
  return color;
}

Result<Environment> read_environment(const std::string& argument, ImageLimit limit) {
  Environment environment;
  if (auto color = parse_color(argument)) {
    environment.radiance = *color;
    return environment;
  }
  auto bytes = read_file(argument, true);
  if (!bytes) return fail(bytes.error());
  auto map = read_radiance_hdr(*bytes, limit);
  if (!map) return fail(in_file(naming_image_option(map.error()), argument));
  environment.radiance = Vec3f::filled(1);
  environment.map = std::make_shared<RadianceImage>(std::move(*map));
  return environment;
}

}  // namespace lightwell
