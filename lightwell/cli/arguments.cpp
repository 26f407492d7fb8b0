// SPDX-License-Identifier: Apache-2.0
#include "lightwell/cli/arguments.h"

#include <cmath>
#include <cstdlib>

#include "lightwell/base/file.h"
#include "lightwell/texture/radiance_hdr.h"

namespace lightwell {
namespace {

// A finite number at the start of text; moves text past it.
bool read_number(const char*& text, double& value) {
  char* end = nullptr;
  value = std::strtod(text, &end);
  if (end == text || !std::isfinite(value)) return false;
  text = end;
  return true;
}

}  // namespace

Result<uint64_t> parse_count(const std::string& text) {
  const char* at = text.c_str();
  double value = 0;
  if (!read_number(at, value) || value < 0) return fail(text, "is not a count");
  switch (*at) {
    case 'k': value *= 1e3, at++; break;
    case 'M': value *= 1e6, at++; break;
    case 'G': value *= 1e9, at++; break;
    default: break;
  }
  if (*at != 0 || value > 1e15 || value != std::floor(value)) return fail(text, "is not a count");
  return static_cast<uint64_t>(value);
}

CLI::Option* add_count(CLI::App& command, const std::string& name, uint64_t& value, const std::string& help) {
  return command
      .add_option_function<std::string>(
          name,
          [&value, name](const std::string& text) {
            auto count = parse_count(text);
            if (!count) throw CLI::ValidationError(name, count.error().message());
            if (*count == 0) throw CLI::ValidationError(name, "must be at least 1");
            value = *count;
          },
          help)
      ->type_name("COUNT");
}

Result<Vec3f> parse_color(const std::string& text) {
  const char* at = text.c_str();
  Vec3f color;
  for (int i = 0; i < 3; i++) {
    double value = 0;
    if (!read_number(at, value) || value < 0) return fail(text, "is not R,G,B");
    color[i] = static_cast<float>(value);
    if (i < 2 && *at++ != ',') return fail(text, "is not R,G,B");
  }
  if (*at != 0 || !is_finite(color)) return fail(text, "is not R,G,B");
  return color;
}

Result<Vec<int, 2>> parse_size(const std::string& text) {
  Vec<int, 2> size;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%dx%d%c", &size[0], &size[1], &rest) != 2) return fail(text, "is not WxH");
  for (int pixels : size.e)
    if (pixels < 1 || pixels > 16384) return fail(text, "each side is 1 to 16384 pixels");
  return size;
}

void add_import_options(CLI::App& command, ImportOptions& options) {
  command
      .add_option_function<std::string>(
          "--up", [&options](const std::string& axis) { options.up = axis[0]; }, "The file's axis that points up")
      ->check(CLI::IsMember({"y", "z"}))
      ->default_str("y");
  command.add_option("--unit", options.unit, "Length of the file's unit in metres")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  command.add_option("--seed", options.seed, "Seed of everything random")->capture_default_str();
}

void add_environment_option(CLI::App& command, std::string& environment) {
  command.add_option("--environment", environment, "Light from all around: R,G,B, or a Radiance .hdr file");
}

void add_threads_option(CLI::App& command, int& threads) {
  command.add_option("--threads", threads, "Threads, 0 for all processors")
      ->capture_default_str()
      ->check(CLI::Range(0, 1024));
}

Result<Environment> read_environment(const std::string& argument) {
  Environment environment;
  if (auto color = parse_color(argument)) {
    environment.radiance = *color;
    return environment;
  }
  auto bytes = read_file(argument, true);
  if (!bytes) return fail(bytes.error());
  auto map = read_radiance_hdr(*bytes);
  if (!map) return fail(in_file(map.error(), argument));
  environment.radiance = Vec3f::filled(1);
  environment.map = std::make_shared<RadianceImage>(std::move(*map));
  return environment;
}

}  // namespace lightwell
