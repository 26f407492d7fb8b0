// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/ply.h"

#include <algorithm>
#include <bit>
#include <map>
#include <string_view>
#include <unordered_map>

#include "lightwell/base/random.h"
#include "lightwell/scene/finish_mesh.h"
#include "lightwell/scene/place.h"
#include "lightwell/scene/ply_polygons.h"
#include "lightwell/scene/polygon.h"
#include "lightwell/scene/scene_builder.h"

namespace lightwell {
namespace {

/// Calls visit(polygon, a, b, c) for every triangle of the polygons, a to c being numbers of corners. Returns how many
/// polygons are too small to have one.
template <typename Visit>
size_t for_each_triangle(const PlyPolygons& polygons, const std::vector<Vec3f>& positions, const Visit& visit) {
  std::vector<Vec3f> points;
  std::vector<Face> triangles;
  size_t begin = 0, too_small = 0;
  for (size_t polygon = 0; polygon < polygons.ends.size(); polygon++) {
    const size_t end = polygons.ends[polygon];
    points.clear();
    triangles.clear();
    for (size_t i = begin; i < end; i++) points.push_back(positions[polygons.corners[i]]);
    triangulate(points, triangles);
    if (triangles.empty()) too_small++;
    for (const Face& t : triangles) visit(polygon, begin + t[0], begin + t[1], begin + t[2]);
    begin = end;
  }
  return too_small;
}

/// The vertices counted from `origin` and all faces as triangles, with normals.
Result<Mesh> whole_mesh(const PlyPolygons& polygons, const Vec3d& origin, Report& report) {
  Mesh mesh = polygons.attributes;
  mesh.positions.reserve(polygons.positions.size());
  for (const Vec3d& position : polygons.positions) mesh.positions.push_back((position - origin).cast<float>());
  const auto& corners = polygons.corners;
  const size_t too_small = for_each_triangle(polygons, mesh.positions, [&](size_t, size_t a, size_t b, size_t c) {
    mesh.faces.push_back({corners[a], corners[b], corners[c]});
  });
  if (too_small > 0) report.warn(std::to_string(too_small) + " faces of fewer than three corners are left out");
  if (mesh.faces.empty()) return fail("", "has no triangles");
  complete_normals(mesh);
  return mesh;
}

struct CornerHash {
  size_t operator()(const std::array<uint32_t, 3>& corner) const {
    uint64_t hash = 0;
    for (const uint32_t word : corner) hash = hash64(hash + word);
    return hash;
  }
};

/// A part of a mesh that grows by corners; equal corners share a vertex.
class TexturedPart {
 public:
  uint32_t vertex(const Mesh& whole, uint32_t index, const Vec2f& texcoord) {
    const std::array<uint32_t, 3> corner = {index, std::bit_cast<uint32_t>(texcoord[0]),
                                            std::bit_cast<uint32_t>(texcoord[1])};
    const auto [place, is_new] = vertices_.try_emplace(corner, static_cast<uint32_t>(mesh.positions.size()));
    if (is_new) {
      mesh.positions.push_back(whole.positions[index]);
      mesh.normals.push_back(whole.normals[index]);
      if (!whole.colors.empty()) mesh.colors.push_back(whole.colors[index]);
      mesh.texcoords[0].push_back(texcoord);
    }
    return place->second;
  }

  Mesh mesh;

 private:
  std::unordered_map<std::array<uint32_t, 3>, uint32_t, CornerHash> vertices_;
};

/// Divides a mesh by the textures of its faces.
std::map<int, TexturedPart> divide(const PlyPolygons& polygons, const Mesh& whole) {
  std::map<int, TexturedPart> parts;
  const auto texcoord = [&](size_t corner) {
    return polygons.corner_texcoords.empty() ? whole.texcoords[0][polygons.corners[corner]]
                                             : polygons.corner_texcoords[corner];
  };
  for_each_triangle(polygons, whole.positions, [&](size_t polygon, size_t a, size_t b, size_t c) {
    TexturedPart& part = parts[polygons.textures[polygon]];
    Face face{};
    for (size_t i = 0; const size_t corner : {a, b, c})
      face[i++] = part.vertex(whole, polygons.corners[corner], texcoord(corner));
    part.mesh.faces.push_back(face);
  });
  return parts;
}

/// Fails for files that hold points instead of a surface.
Result<void> check_faces(const PlyHeader& header) {
  bool splats = false;
  for (const PlyElement& element : header.elements) {
    if ((element.name == "face" || element.name == "tristrips") && element.count > 0) return {};
    for (const PlyProperty& property : element.properties)
      splats |= element.name == "vertex" && (property.name == "f_dc_0" || property.name == "scale_0");
  }
  return fail(ErrorKind::unsupported, "",
              splats ? "holds Gaussian splats, which are no surface: light can be baked for meshes only"
                     : "is a point cloud, it has no faces: make a mesh of it first, as by MeshLab's Poisson surface");
}

/// Warns of properties that are not read.
void warn_of_unread(const PlyHeader& header, Report& report) {
  std::string names;
  for (const PlyElement& element : header.elements)
    for (const PlyProperty& property : element.properties)
      if (!is_read(element, property, !header.textures.empty()) && names.size() < 400)
        names += (names.empty() ? "" : ", ") + element.name.substr(0, 40) + "." + property.name.substr(0, 40);
  if (!names.empty()) report.warn("properties left out, not supported: " + names);
}

/// Warns of textures that no face shows.
void warn_of_unused(const PlyContent& content, Report& report) {
  for (size_t i = 0; i < content.textures.size(); i++) {
    const bool used = std::any_of(content.parts.begin(), content.parts.end(),
                                  [&](const PlyPart& part) { return part.texture == static_cast<int>(i); });
    if (!used)
      report.warn("texture " + content.textures[i].substr(0, 80) + ": no face has texture coordinates in it; left out");
  }
}

/// A texture's name as MeshLab means it: "<this>" stands for the name of the PLY file.
std::string texture_file(std::string name, const std::string& stem) {
  constexpr std::string_view placeholder = "<this>";
  if (const size_t at = name.find(placeholder); at != name.npos) name.replace(at, placeholder.size(), stem);
  return name;
}

}  // namespace

bool is_ply(Bytes bytes) {
  return bytes.size() >= 4 && std::string_view(reinterpret_cast<const char*>(bytes.data()), 3) == "ply" &&
         (bytes[3] == '\n' || bytes[3] == '\r' || bytes[3] == ' ');
}

Result<PlyContent> read_ply(Bytes file, Report& report) {
  LW_TRY(header, read_ply_header(file));
  LW_CHECK(check_faces(header));
  warn_of_unread(header, report);
  LW_TRY(polygons, read_ply_polygons(header, file.subspan(header.size)));
  PlyContent content;
  content.origin = origin_amid(polygons.positions);
  content.textures = header.textures;
  LW_TRY(whole, whole_mesh(polygons, content.origin, report));
  const bool textured = !content.textures.empty() && !(polygons.corner_texcoords.empty() && whole.texcoords[0].empty());
  if (textured) {
    for (auto& [texture, part] : divide(polygons, whole)) content.parts.push_back({std::move(part.mesh), texture});
  } else {
    const size_t unused = drop_unused_vertices(whole);
    if (unused > 0) report.warn(std::to_string(unused) + " vertices of no face are left out");
    content.parts.push_back({std::move(whole), -1});
  }
  warn_of_unused(content, report);
  return content;
}

Result<Document> ply_document(Bytes file, const std::filesystem::path& folder, const std::string& stem,
                              Report& report) {
  LW_TRY(content, read_ply(file, report));
  SceneBuilder scene;
  std::vector<SceneBuilder::Part> parts;
  for (PlyPart& part : content.parts) {
    const bool textured = part.texture >= 0;
    if (textured) part.mesh.colors.clear();  // a scan's colours are those of its texture, more coarsely
    Lambertian material{.name = "surface", .double_sided = true};
    if (textured || !part.mesh.colors.empty()) material.color = Vec3f::filled(1);
    Json json = lambertian_json(material);
    if (textured) {
      const std::string& name = content.textures[static_cast<size_t>(part.texture)];
      json["pbrMetallicRoughness"]["baseColorTexture"] = scene.texture(as_uri(texture_file(name, stem)));
    }
    parts.push_back({part.mesh, scene.material(std::move(json))});
  }
  scene.object("mesh", parts, content.origin);
  Document document = scene.release();
  document.folder = folder;
  return document;
}

}  // namespace lightwell
