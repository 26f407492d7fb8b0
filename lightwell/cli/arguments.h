// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "lightwell/base/vector.h"
#include "lightwell/cli/command.h"
#include "lightwell/scene/scene.h"

namespace lightwell {

/// Reads a whole number that may end in k, M or G ("8M" is 8 000 000), or an exponent ("1e6").
Result<uint64_t> parse_count(const std::string& text);

/// Adds an option whose value is a count as parse_count reads it.
CLI::Option* add_count(CLI::App& command, const std::string& name, uint64_t& value, const std::string& help);

/// Reads "R,G,B", three numbers that are not negative.
Result<Vec3f> parse_color(const std::string& text);

/// Reads "WxH" in pixels, each 1 to 16384.
Result<Vec<int, 2>> parse_size(const std::string& text);

/// --up, --unit and --seed of the commands that read scenes.
void add_import_options(CLI::App& command, ImportOptions& options);

/// --environment and --threads of the commands that trace light.
void add_environment_option(CLI::App& command, std::string& environment);
void add_threads_option(CLI::App& command, int& threads);

/// --environment: "R,G,B", or the name of a Radiance .hdr file.
Result<Environment> read_environment(const std::string& argument);

}  // namespace lightwell
