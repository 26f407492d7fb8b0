// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/ply.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "lightwell/scene/finish_mesh.h"
#include "lightwell/scene/ply_values.h"
#include "lightwell/scene/polygon.h"
#include "lightwell/scene/scene_builder.h"
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

/// The vertices of a file and its faces, not yet cut into triangles.
struct Polygons {
  Mesh mesh;  ///< without faces
  bool has_vertices = false;
  std::vector<uint32_t> corners;  ///< of all faces, one after another
  std::vector<size_t> ends;       ///< where each face's corners end
};

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
bool append_vertex(const Row& row, const VertexLayout& layout, Mesh& mesh) {
  if (!std::all_of(row.begin(), row.end(), [](double v) { return std::abs(v) <= farthest_position; })) return false;
  const auto triple = [&](Role first) { return Vec3d{{row[first], row[first + 1], row[first + 2]}}.cast<float>(); };
  mesh.positions.push_back(triple(px));
  if (layout.has_normal()) mesh.normals.push_back(triple(nx));
  if (layout.has_color()) {
    const double opacity = layout.present[alpha] ? std::clamp(row[alpha], 0.0, 1.0) : 1;
    mesh.colors.push_back({{linear_channel(row[red]), linear_channel(row[green]), linear_channel(row[blue]),
                            static_cast<float>(opacity)}});
  }
  // Texture coordinates of PLY begin at the bottom, glTF's at the top.
  if (layout.has_texcoord()) mesh.texcoords[0].push_back(Vec<double, 2>{{row[tex_s], 1 - row[tex_t]}}.cast<float>());
  return true;
}

Result<void> read_vertices(const PlyElement& element, PlyValues& values, Polygons& polygons) {
  const VertexLayout layout(element);
  if (polygons.has_vertices) return fail("header", "has vertices twice");
  if (!layout.has_position()) return fail("header", "vertices without x, y and z");
  if (element.count >= UINT32_MAX) return fail(ErrorKind::limit, "header", "has too many vertices");
  polygons.has_vertices = true;
  polygons.mesh.positions.reserve(element.count);
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
    if (!append_vertex(row, layout, polygons.mesh))
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

Result<void> read_polygon(const PlyProperty& list, PlyValues& values, const std::string& where, Polygons& polygons) {
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
Result<void> read_strips(const PlyProperty& list, PlyValues& values, const std::string& where, Polygons& polygons) {
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

Result<void> read_faces(const PlyElement& element, PlyValues& values, Polygons& polygons) {
  const bool strips = element.name == "tristrips";
  if (!std::any_of(element.properties.begin(), element.properties.end(), is_corner_list))
    return fail("header", "faces without vertex_indices");
  for (uint64_t i = 0; i < element.count; i++) {
    const std::string where = (strips ? "strip " : "face ") + std::to_string(i);
    for (const PlyProperty& property : element.properties) {
      if (is_corner_list(property)) {
        LW_CHECK((strips ? read_strips : read_polygon)(property, values, where, polygons));
      } else {
        values.skip(property);
      }
    }
    if (!values.ok()) return fail(where, "the file ends too early or holds no number");
  }
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

/// Cuts all faces into triangles.
Result<Mesh> triangulated(Polygons polygons, Report& report) {
  Mesh mesh = std::move(polygons.mesh);
  std::vector<Vec3f> points;
  std::vector<Face> triangles;
  size_t begin = 0, too_small = 0;
  for (size_t face = 0; face < polygons.ends.size(); face++) {
    const auto corners = std::span(polygons.corners).subspan(begin, polygons.ends[face] - begin);
    begin = polygons.ends[face];
    points.clear();
    triangles.clear();
    for (const uint32_t corner : corners) {
      if (corner >= mesh.positions.size())
        return fail("face " + std::to_string(face),
                    "refers to vertex " + std::to_string(corner) + " of " + std::to_string(mesh.positions.size()));
      points.push_back(mesh.positions[corner]);
    }
    triangulate(points, triangles);
    if (triangles.empty()) too_small++;
    for (const Face& t : triangles) mesh.faces.push_back({corners[t[0]], corners[t[1]], corners[t[2]]});
  }
  if (too_small > 0) report.warn(std::to_string(too_small) + " faces of fewer than three corners are left out");
  return mesh;
}

/// Warns of properties that are not read, so that a scan without its texture is explained.
void warn_of_unread(const PlyHeader& header, Report& report) {
  std::string names;
  for (const PlyElement& element : header.elements) {
    const bool faces = element.name == "face" || element.name == "tristrips";
    for (const PlyProperty& property : element.properties) {
      if (element.name == "vertex" ? role_of(property).has_value() : faces && is_corner_list(property)) continue;
      if (names.size() < 400)
        names += (names.empty() ? "" : ", ") + element.name.substr(0, 40) + "." + property.name.substr(0, 40);
    }
  }
  if (!names.empty()) report.warn("properties left out, not supported: " + names);
}

}  // namespace

bool is_ply(Bytes bytes) {
  return bytes.size() >= 4 && std::string_view(reinterpret_cast<const char*>(bytes.data()), 3) == "ply" &&
         (bytes[3] == '\n' || bytes[3] == '\r' || bytes[3] == ' ');
}

Result<Mesh> read_ply(Bytes file, Report& report) {
  LW_TRY(header, read_ply_header(file));
  warn_of_unread(header, report);
  PlyValues values(file.subspan(header.size), header.format);
  Polygons polygons;
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex") {
      LW_CHECK(read_vertices(element, values, polygons));
    } else if (element.name == "face" || element.name == "tristrips") {
      LW_CHECK(read_faces(element, values, polygons));
    } else {
      LW_CHECK(skip_element(element, values));
    }
  }
  LW_TRY(mesh, triangulated(std::move(polygons), report));
  if (mesh.faces.empty()) return fail("", "has no triangles");
  const size_t unused = drop_unused_vertices(mesh);
  if (unused > 0) report.warn(std::to_string(unused) + " vertices of no face are left out");
  complete_normals(mesh);
  return std::move(mesh);
}

Result<Document> ply_document(Bytes file, Report& report) {
  LW_TRY(mesh, read_ply(file, report));
  SceneBuilder scene;
  Lambertian material{.name = "surface", .double_sided = true};
  if (!mesh.colors.empty()) material.color = Vec3f::filled(1);
  scene.object("mesh", {{mesh, scene.material(material)}});
  return scene.release();
}

}  // namespace lightwell
