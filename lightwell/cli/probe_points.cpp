// SPDX-License-Identifier: Apache-2.0
#include "lightwell/cli/probe_points.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string_view>

#include "lightwell/base/file.h"

namespace lightwell {
namespace {

constexpr double most = std::numeric_limits<float>::max();  // of a number

constexpr std::array<std::string_view, 6> wanted = {"x", "y", "z", "nx", "ny", "nz"};

std::string_view trimmed(std::string_view text) {
  const size_t first = text.find_first_not_of(" \t\r\"");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\"") - first + 1);
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (size_t at = 0; at <= text.size();) {
    const size_t end = std::min(text.find(separator, at), text.size());
    parts.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return parts;
}

// The column of each wanted number.
Result<std::array<size_t, 6>> find_columns(std::string_view header) {
  const std::vector<std::string_view> names = split(header, ',');
  std::array<size_t, 6> columns{};
  for (size_t i = 0; i < wanted.size(); i++) {
    const auto found = std::find_if(names.begin(), names.end(), [&](auto name) { return trimmed(name) == wanted[i]; });
    if (found == names.end()) return fail("line 1", "names no column " + std::string(wanted[i]));
    columns[i] = static_cast<size_t>(found - names.begin());
  }
  return columns;
}

Result<ListedPoint> read_point(std::string_view line, const std::array<size_t, 6>& columns) {
  const std::vector<std::string_view> fields = split(line, ',');
  std::array<double, 6> numbers{};
  for (size_t i = 0; i < numbers.size(); i++) {
    if (columns[i] >= fields.size()) return fail("", "has too few columns");
    const std::string field(trimmed(fields[columns[i]]));
    char* end = nullptr;
    numbers[i] = std::strtod(field.c_str(), &end);
    if (field.empty() || *end != 0 || !(std::abs(numbers[i]) <= most))
      return fail("", "'" + field + "' is not a number");
  }
  const Vec3d normal = normalized(Vec3d{{numbers[3], numbers[4], numbers[5]}});
  ListedPoint point{{{numbers[0], numbers[1], numbers[2]}}, normal.cast<float>()};
  if (!(length(point.normal) > 0)) return fail("", "its normal has no direction");
  // From farther away the squares of distances leave the range of floats.
  if (!(length(point.position) <= 1e12)) return fail("", "lies farther than 1e12 m away");
  return point;
}

}  // namespace

Result<std::vector<ListedPoint>> read_probe_points(const std::string& path) {
  LW_TRY(bytes, read_file(path));
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const std::vector<std::string_view> lines = split(text, '\n');
  auto columns = find_columns(lines.front());
  if (!columns) return fail(in_file(columns.error(), path));
  std::vector<ListedPoint> points;
  for (size_t i = 1; i < lines.size(); i++) {
    if (trimmed(lines[i]).empty()) continue;
    auto point = read_point(lines[i], *columns);
    if (!point) return fail(in_file(in_element(point.error(), "line " + std::to_string(i + 1)), path));
    points.push_back(*point);
  }
  return points;
}

std::vector<ProbePoint> counted_from(const Vec3d& origin, const std::vector<ListedPoint>& points) {
  std::vector<ProbePoint> counted;
  for (const ListedPoint& point : points) counted.push_back({(point.position - origin).cast<float>(), point.normal});
  return counted;
}

std::string probe_csv(const std::vector<ListedPoint>& points, const std::vector<ProbeValue>& values) {
  std::string csv = "x,y,z,nx,ny,nz,r,g,b,stderr\n";
  char line[256];
  for (size_t i = 0; i < points.size(); i++) {
    const Vec3d& p = points[i].position;
    const Vec3f &n = points[i].normal, &e = values[i].irradiance;
    std::snprintf(line, sizeof line, "%.12g,%.12g,%.12g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n", p[0], p[1], p[2], n[0],
                  n[1], n[2], e[0], e[1], e[2], values[i].standard_error);
    csv += line;
  }
  return csv;
}

}  // namespace lightwell
