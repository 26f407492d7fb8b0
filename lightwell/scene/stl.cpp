// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/stl.h"

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "lightwell/scene/creased_mesh.h"
#include "lightwell/scene/finish_mesh.h"
#include "lightwell/scene/place.h"
#include "lightwell/scene/scene_builder.h"
#include "lightwell/texture/transfer.h"

namespace lightwell {
namespace {

constexpr size_t header_size = 80, facet_size = 50;

/// What a file holds: three corners a facet, in double precision, since texts may lie far from the origin.
struct Facets {
  std::vector<Vec3d> corners;
  std::vector<Vec4f> colors;  ///< linear, of each facet; empty where there are none
};

std::string_view text_of(Bytes bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

/// Some programs begin binary files with "solid", too; the letters of a text would be a number of facets beyond any
/// file.
bool is_binary(Bytes file) {
  ByteReader reader(file);
  reader.take(header_size);
  const uint64_t facets = reader.u32();
  return reader.ok() && facets > 0 && reader.remaining() >= facets * facet_size;
}

bool in_range(const Vec3d& p) { return max_component(max(p, -p)) <= farthest_position && is_finite(p); }

/// The colour of a facet in its last two bytes. VisCAM has blue lowest and a bit that says that there is a colour;
/// Magics, whose header says COLOR=, has red lowest and a bit that says that there is none.
std::optional<Vec4f> color_of(uint16_t word, bool magics, const Vec4f& of_whole) {
  const bool marked = word >> 15 & 1;
  if (marked == magics) return magics ? std::optional(of_whole) : std::nullopt;
  Vec4f color = Vec4f::filled(1);
  for (int i = 0; i < 3; i++) color[magics ? i : 2 - i] = srgb_to_linear(static_cast<float>(word >> (5 * i) & 31) / 31);
  return color;
}

Result<Facets> read_binary(Bytes file) {
  ByteReader reader(file);
  const std::string_view header = text_of(reader.take(header_size));
  const size_t mark = header.find("COLOR=");
  const bool magics = mark != header.npos && mark + 10 <= header.size();
  Vec4f of_whole = Vec4f::filled(1);
  for (int i = 0; magics && i < 3; i++)
    of_whole[i] = srgb_to_linear(static_cast<uint8_t>(header[mark + 6 + static_cast<size_t>(i)]));
  const float grey = srgb_to_linear(0.8f);
  const Vec4f uncolored{{grey, grey, grey, 1}};
  const uint32_t count = reader.u32();
  Facets facets;
  facets.corners.reserve(size_t(3) * count);
  bool colored = magics;
  for (uint32_t i = 0; i < count; i++) {
    reader.take(12);  // the normal, which many files have wrong
    for (int corner = 0; corner < 3; corner++) {
      Vec3d p;
      for (double& x : p.e) x = reader.f32();
      if (!in_range(p)) return fail("facet " + std::to_string(i), "a number that is not finite, or beyond 1e9");
      facets.corners.push_back(p);
    }
    const auto color = color_of(reader.u16(), magics, of_whole);
    colored |= color.has_value();
    facets.colors.push_back(color.value_or(uncolored));
  }
  if (!colored) facets.colors.clear();
  return facets;
}

/// Takes the first word off a text.
std::string_view take_word(std::string_view& text, size_t& line) {
  size_t start = 0;
  while (start < text.size() && static_cast<unsigned char>(text[start]) <= ' ') line += text[start++] == '\n';
  size_t end = start;
  while (end < text.size() && static_cast<unsigned char>(text[end]) > ' ') end++;
  const std::string_view word = text.substr(start, end - start);
  text.remove_prefix(end);
  return word;
}

Result<Facets> read_text(std::string_view text) {
  Facets facets;
  size_t line = 1;
  for (std::string_view word = take_word(text, line); !word.empty(); word = take_word(text, line)) {
    if (word != "vertex" && word != "VERTEX") continue;
    Vec3d p;
    for (double& x : p.e) {
      std::string_view number = take_word(text, line);
      if (number.starts_with('+')) number.remove_prefix(1);
      const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), x);
      if (error != std::errc() || end != number.data() + number.size())
        return fail("line " + std::to_string(line), "a vertex without three numbers");
    }
    if (!in_range(p)) return fail("line " + std::to_string(line), "a number that is not finite, or beyond 1e9");
    facets.corners.push_back(p);
  }
  if (facets.corners.size() % 3 != 0) return fail("", "ends within a facet");
  return facets;
}

}  // namespace

bool is_stl(Bytes file) {
  const std::string_view text = text_of(file);
  const size_t start = std::min(text.find_first_not_of(" \t\r\n"), text.size());
  ByteReader reader(file);
  reader.take(header_size);
  const uint64_t facets = reader.u32();
  const bool fits = reader.ok() && facets > 0 && reader.remaining() == facets * facet_size;
  return fits || text.substr(start).starts_with("solid");
}

Result<Document> stl_document(Bytes file, Report& report) {
  auto facets = is_binary(file) ? read_binary(file) : read_text(text_of(file));
  if (!facets) return fail(facets.error());
  if (facets->corners.empty()) return fail("", "has no facets");
  const Vec3d origin = origin_amid(facets->corners);
  std::vector<Vec3f> corners;
  for (const Vec3d& p : facets->corners) corners.push_back((p - origin).cast<float>());
  const Mesh mesh = creased_mesh(corners, facets->colors);
  if (mesh.faces.empty()) return fail("", "all facets are without area");
  if (mesh.faces.size() * 3 < corners.size())
    report.warn(std::to_string(corners.size() / 3 - mesh.faces.size()) + " facets without area are left out");
  SceneBuilder scene;
  Lambertian material{.name = "surface", .double_sided = true};
  if (!mesh.colors.empty()) material.color = Vec3f::filled(1);
  scene.object("mesh", {{mesh, scene.material(material)}}, origin);
  return scene.release();
}

}  // namespace lightwell
