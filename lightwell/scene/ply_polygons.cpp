// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/ply_polygons.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "lightwell/scene/finish_mesh.h"
#include "lightwell/scene/ply_values.h"
#include "lightwell/texture/transfer.h"

namespace lightwell {
namespace {

/// The meaning of a vertex property, in the order of a row of numbers.
enum Role { px, py, pz, nx, ny, nz, red, green, blue, alpha, tex_s, tex_t, role_count };

using Row = std::array<double, role_count>;

std::optional<Role> role_of(const PlyProperty& property) {
  constexpr std::pair<std::string_view, Role> names[] = {{"x", px},
                                                         {"y", py},
                                                         {"z", pz},
                                                         {"nx", nx},
                                                         {"ny", ny},
                                                         {"nz", nz},
                                                         {"red", red},
                                                         {"green", green},
                                                         {"blue", blue},
                                                         {"alpha", alpha},
                                                         {"r", red},
                                                         {"g", green},
                                                         {"b", blue},
                                                         {"a", alpha},
                                                         {"diffuse_red", red},
                                                         {"diffuse_green", green},
                                                         {"diffuse_blue", blue},
                                                         {"s", tex_s},
                                                         {"t", tex_t},
                                                         {"u", tex_s},
                                                         {"v", tex_t},
                                                         {"texture_u", tex_s},
                                                         {"texture_v", tex_t},
                                                         {"texture_s", tex_s},
                                                         {"texture_t", tex_t}};
  for (const auto& [name, role] : names) {
    if (!property.is_list && property.name == name) return role;
  }
  return std::nullopt;
}

/// Colours are fractions of the largest number of their type; floats go from 0 to 1.
double color_scale(PlyType type) {
  switch (type) {
    case PlyType::int8: return 1.0 / INT8_MAX;
    case PlyType::uint8: return 1.0 / UINT8_MAX;
    case PlyType::int16: return 1.0 / INT16_MAX;
    case PlyType::uint16: return 1.0 / UINT16_MAX;
    case PlyType::int32: return 1.0 / INT32_MAX;
    case PlyType::uint32: return 1.0 / UINT32_MAX;
    case PlyType::float32:
    case PlyType::float64: return 1;
  }
  return 1;
}

/// The attributes that the vertices' properties form.
struct VertexLayout {
  std::vector<std::optional<Role>> roles;  ///< of each property
  std::vector<double> scales;
  std::array<bool, role_count> present{};

  explicit VertexLayout(const PlyElement& element) {
    for (const PlyProperty& property : element.properties) {
      const auto role = role_of(property);
      roles.push_back(role);
      scales.push_back(role && *role >= red && *role <= alpha ? color_scale(property.type) : 1);
      if (role) present[*role] = true;
    }
  }
  bool has(std::initializer_list<Role> needed) const {
    return std::all_of(needed.begin(), needed.end(), [&](Role role) { return present[role]; });
  }
  bool has_position() const { return has({px, py, pz}); }
  bool has_normal() const { return has({nx, ny, nz}); }
  bool has_color() const { return has({red, green, blue}); }
  bool has_texcoord() const { return has({tex_s, tex_t}); }
};

float linear_channel(double encoded) { return srgb_to_linear(static_cast<float>(std::clamp(encoded, 0.0, 1.0))); }

/// Appends a vertex. False when a number is not finite or too large.
bool append_vertex(const Row& row, const VertexLayout& layout, PlyPolygons& polygons) {
  if (!std::all_of(row.begin(), row.end(), [](double v) { return std::abs(v) <= farthest_position; })) return false;
  Mesh& mesh = polygons.attributes;
  const auto triple = [&](Role first) { return Vec3d{{row[first], row[first + 1], row[first + 2]}}; };
  polygons.positions.push_back(triple(px));
  if (layout.has_normal()) mesh.normals.push_back(triple(nx).cast<float>());
  if (layout.has_color()) {
    const double opacity = layout.present[alpha] ? std::clamp(row[alpha], 0.0, 1.0) : 1;
    mesh.colors.push_back({{linear_channel(row[red]), linear_channel(row[green]), linear_channel(row[blue]),
                            static_cast<float>(opacity)}});
  }
  // Texture coordinates of PLY begin at the bottom, glTF's at the top.
  if (layout.has_texcoord()) mesh.texcoords[0].push_back(Vec<double, 2>{{row[tex_s], 1 - row[tex_t]}}.cast<float>());
  return true;
}

Result<void> read_vertices(const PlyElement& element, PlyValues& values, PlyPolygons& polygons) {
  const VertexLayout layout(element);
  if (!polygons.positions.empty()) return fail("header", "has vertices twice");
  if (!layout.has_position()) return fail("header", "vertices without x, y and z");
  if (element.count >= UINT32_MAX) return fail(ErrorKind::limit, "header", "has too many vertices");
  polygons.positions.reserve(element.count);
  for (uint64_t i = 0; i < element.count; i++) {
    Row row{};
    for (size_t p = 0; p < element.properties.size(); p++) {
      if (layout.roles[p]) {
        row[*layout.roles[p]] = values.number(element.properties[p].type) * layout.scales[p];
      } else {
        values.skip(element.properties[p]);
      }
    }
    if (!values.ok()) return fail("vertex " + std::to_string(i), "the file ends too early or holds no number");
    if (!append_vertex(row, layout, polygons))
      return fail("vertex " + std::to_string(i), "a number that is not finite, or beyond 1e9");
  }
  return {};
}

bool is_corner_list(const PlyProperty& property) {
  return property.is_list && (property.name == "vertex_indices" || property.name == "vertex_index");
}

Result<void> check_corner(double index, const std::string& where) {
  if (index >= 0 && index < UINT32_MAX && index == std::floor(index)) return {};
  return fail(where, "refers to no vertex");
}

Result<void> read_polygon(const PlyProperty& list, PlyValues& values, const std::string& where, PlyPolygons& polygons) {
  const size_t count = values.list_length(list);
  for (size_t i = 0; i < count && values.ok(); i++) {
    const double index = values.number(list.type);
    LW_CHECK(check_corner(index, where));
    polygons.corners.push_back(static_cast<uint32_t>(index));
  }
  polygons.ends.push_back(polygons.corners.size());
  return {};
}

/// A list of strips with -1 between them; every other triangle of a strip turns round.
Result<void> read_strips(const PlyProperty& list, PlyValues& values, const std::string& where, PlyPolygons& polygons) {
  const size_t count = values.list_length(list);
  std::vector<uint32_t> strip;
  for (size_t i = 0; i < count && values.ok(); i++) {
    const double index = values.number(list.type);
    if (index == -1) {
      strip.clear();
      continue;
    }
    LW_CHECK(check_corner(index, where));
    strip.push_back(static_cast<uint32_t>(index));
    const size_t n = strip.size();
    if (n < 3) continue;
    const uint32_t a = strip[n - 3], b = strip[n - 2], c = strip[n - 1];
    if (a == b || b == c || c == a) continue;  // a strip turns corners by triangles without area
    const bool turned = n % 2 == 0;
    for (const uint32_t corner : {turned ? b : a, turned ? a : b, c}) polygons.corners.push_back(corner);
    polygons.ends.push_back(polygons.corners.size());
  }
  return {};
}

bool is_texcoord_list(const PlyProperty& property) { return property.is_list && property.name == "texcoord"; }

bool is_texture_number(const PlyProperty& property) { return !property.is_list && property.name == "texnumber"; }

/// What a face says of its texture.
struct FaceTexture {
  std::vector<Vec2f> texcoords;  ///< of its corners
  double number = 0;
};

void read_texcoords(const PlyProperty& list, PlyValues& values, std::vector<Vec2f>& texcoords) {
  const size_t count = values.list_length(list);
  for (size_t i = 0; i < count && values.ok(); i++) {
    const double value = values.number(list.type);
    const float kept = std::abs(value) <= farthest_position ? static_cast<float>(value) : 0;
    if (i % 2 == 0)
      texcoords.push_back({{kept, 1}});
    else
      texcoords.back()[1] = 1 - kept;
  }
}

/// Notes the texture of the face that was read last. One without a coordinate for every corner has none.
void append_texture(const FaceTexture& texture, bool by_corner, size_t textures, PlyPolygons& polygons) {
  const size_t corners = polygons.corners.size() - (polygons.ends.size() > 1 ? polygons.ends.end()[-2] : 0);
  const bool complete = !by_corner || texture.texcoords.size() == corners;
  const bool known = texture.number >= 0 && texture.number < static_cast<double>(textures);
  polygons.textures.push_back(known && complete ? static_cast<int>(texture.number) : -1);
  if (!by_corner) return;
  for (size_t i = 0; i < corners; i++) polygons.corner_texcoords.push_back(complete ? texture.texcoords[i] : Vec2f{});
}

Result<void> read_faces(const PlyElement& element, size_t textures, PlyValues& values, PlyPolygons& polygons) {
  const auto& properties = element.properties;
  if (!std::any_of(properties.begin(), properties.end(), is_corner_list))
    return fail("header", "faces without vertex_indices");
  const bool by_corner = textures > 0 && std::any_of(properties.begin(), properties.end(), is_texcoord_list);
  if (by_corner) {  // what came before has no coordinates of its own
    polygons.corner_texcoords.resize(polygons.corners.size());
    polygons.textures.assign(polygons.ends.size(), -1);
  }
  for (uint64_t i = 0; i < element.count; i++) {
    const std::string where = "face " + std::to_string(i);
    FaceTexture texture;
    bool has_corners = false;
    for (const PlyProperty& property : properties) {
      if (is_corner_list(property) && !has_corners) {
        LW_CHECK(read_polygon(property, values, where, polygons));
        has_corners = true;
      } else if (by_corner && is_texcoord_list(property)) {
        read_texcoords(property, values, texture.texcoords);
      } else if (is_texture_number(property)) {
        texture.number = values.number(property.type);
      } else {
        values.skip(property);
      }
    }
    if (!values.ok()) return fail(where, "the file ends too early or holds no number");
    append_texture(texture, by_corner, textures, polygons);
  }
  return {};
}

Result<void> read_tristrips(const PlyElement& element, size_t textures, PlyValues& values, PlyPolygons& polygons) {
  if (!std::any_of(element.properties.begin(), element.properties.end(), is_corner_list))
    return fail("header", "strips without vertex_indices");
  for (uint64_t i = 0; i < element.count; i++) {
    const std::string where = "strip " + std::to_string(i);
    for (const PlyProperty& property : element.properties) {
      if (is_corner_list(property)) {
        LW_CHECK(read_strips(property, values, where, polygons));
      } else {
        values.skip(property);
      }
    }
    if (!values.ok()) return fail(where, "the file ends too early or holds no number");
  }
  polygons.textures.resize(polygons.ends.size(), polygons.corner_texcoords.empty() && textures > 0 ? 0 : -1);
  return {};
}

Result<void> skip_element(const PlyElement& element, PlyValues& values) {
  if (element.properties.empty()) return {};
  for (uint64_t i = 0; i < element.count; i++) {
    for (const PlyProperty& property : element.properties) values.skip(property);
    if (!values.ok()) return fail(element.name + " " + std::to_string(i), "the file ends too early or holds no number");
  }
  return {};
}

}  // namespace

bool is_read(const PlyElement& element, const PlyProperty& property, bool textured) {
  if (element.name == "vertex") return role_of(property).has_value();
  if (element.name == "tristrips") return is_corner_list(property);
  return element.name == "face" &&
         (is_corner_list(property) || (textured && (is_texcoord_list(property) || is_texture_number(property))));
}

Result<PlyPolygons> read_ply_polygons(const PlyHeader& header, Bytes data) {
  PlyValues values(data, header.format);
  PlyPolygons polygons;
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex") {
      LW_CHECK(read_vertices(element, values, polygons));
    } else if (element.name == "face") {
      LW_CHECK(read_faces(element, header.textures.size(), values, polygons));
    } else if (element.name == "tristrips") {
      LW_CHECK(read_tristrips(element, header.textures.size(), values, polygons));
    } else {
      LW_CHECK(skip_element(element, values));
    }
  }
  if (!polygons.corner_texcoords.empty()) polygons.corner_texcoords.resize(polygons.corners.size());
  const auto wrong = std::find_if(polygons.corners.begin(), polygons.corners.end(),
                                  [&](uint32_t corner) { return corner >= polygons.positions.size(); });
  if (wrong == polygons.corners.end()) return polygons;
  const auto at = static_cast<size_t>(wrong - polygons.corners.begin());
  const auto face = std::upper_bound(polygons.ends.begin(), polygons.ends.end(), at) - polygons.ends.begin();
  return fail("face " + std::to_string(face),
              "refers to vertex " + std::to_string(*wrong) + " of " + std::to_string(polygons.positions.size()));
}

}  // namespace lightwell
