// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/import_obj.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <sstream>
#include <unordered_map>

#include "lightwell/base/random.h"
#include "lightwell/scene/finish_mesh.h"
#include "lightwell/scene/obj_materials.h"
#include "lightwell/scene/obj_text.h"
#include "lightwell/scene/polygon.h"
#include "lightwell/texture/transfer.h"

namespace lightwell {
namespace {

/// The library's result, with positions as vectors.
struct Obj {
  tinyobj::attrib_t attributes;
  std::vector<tinyobj::shape_t> shapes;
  std::vector<Vec3f> positions;
  bool has_colors = false;
};

Vec3f triple(const std::vector<float>& values, size_t index) {
  return {{values[3 * index], values[3 * index + 1], values[3 * index + 2]}};
}

bool in_range(const float* numbers, int count) {
  return std::all_of(numbers, numbers + count, [](float v) { return std::abs(v) <= farthest_position; });
}

/// The fault of an attribute that a corner refers to; none when the corner has no such attribute and needs none. The
/// library only makes negative indices absolute.
std::string fault_of(const std::vector<float>& values, int per_element, int index, bool required) {
  if (index == -1 && !required) return {};
  if (index < 0 || static_cast<size_t>(index) >= values.size() / static_cast<size_t>(per_element))
    return "a face refers to a vertex that is not there";
  if (!in_range(values.data() + static_cast<ptrdiff_t>(index) * per_element, per_element))
    return "vertex " + std::to_string(index + 1) + " has a number that is not finite, or beyond 1e9";
  return {};
}

Result<void> check_corners(const tinyobj::attrib_t& attributes, const tinyobj::shape_t& shape) {
  for (const tinyobj::index_t& corner : shape.mesh.indices) {
    for (const std::string& fault : {fault_of(attributes.vertices, 3, corner.vertex_index, true),
                                     fault_of(attributes.normals, 3, corner.normal_index, false),
                                     fault_of(attributes.texcoords, 2, corner.texcoord_index, false)}) {
      if (!fault.empty()) return fail(shape.name.substr(0, 60), fault);
    }
  }
  return {};
}

/// Passes on the library's first warnings, a line each.
void report_warnings(const std::string& warnings, Report& report) {
  constexpr int most = 20;
  std::istringstream lines(warnings);
  int count = 0;
  for (std::string line; std::getline(lines, line) && count < most;) {
    if (line.size() < 2) continue;
    report.warn(line.substr(line.starts_with('.'), 200));
    count++;
  }
}

Result<Obj> read_obj(const std::string& text, ObjMaterialReader& materials, Report& report) {
  Obj obj;
  std::istringstream stream(text);
  std::string warning, error;
  std::vector<tinyobj::material_t> none;  // the reader keeps the materials
  constexpr bool triangulate = false, color_everywhere = true;
  try {
    if (!tinyobj::LoadObj(&obj.attributes, &obj.shapes, &none, &warning, &error, &stream, &materials, triangulate,
                          color_everywhere))
      return fail("", error.substr(0, error.find('\n')));
  } catch (const std::exception& exception) {
    return fail("", exception.what());
  }
  report_warnings(warning, report);
  for (const tinyobj::shape_t& shape : obj.shapes) LW_CHECK(check_corners(obj.attributes, shape));
  for (size_t i = 0; i < obj.attributes.vertices.size() / 3; i++)
    obj.positions.push_back(triple(obj.attributes.vertices, i));
  // The library gives white to vertices without a colour.
  const auto is_one = [](float channel) { return channel == 1; };
  obj.has_colors = !std::all_of(obj.attributes.colors.begin(), obj.attributes.colors.end(), is_one);
  return obj;
}

/// A face of a shape.
struct Polygon {
  std::span<const tinyobj::index_t> corners;
  int material = 0;
};

std::vector<Polygon> polygons_of(const tinyobj::shape_t& shape) {
  std::vector<Polygon> polygons;
  polygons.reserve(shape.mesh.num_face_vertices.size());
  std::span<const tinyobj::index_t> rest = shape.mesh.indices;
  for (size_t face = 0; face < shape.mesh.num_face_vertices.size(); face++) {
    const size_t count = shape.mesh.num_face_vertices[face];
    polygons.push_back({rest.first(count), shape.mesh.material_ids[face]});
    rest = rest.subspan(count);
  }
  return polygons;
}

/// Calls visit(a, b, c) for every triangle of the polygons, a to c being its corners.
template <typename Visit>
void for_each_triangle(const Obj& obj, std::span<const Polygon> polygons, const Visit& visit) {
  std::vector<Vec3f> points;
  std::vector<Face> triangles;
  for (const Polygon& polygon : polygons) {
    points.clear();
    triangles.clear();
    for (const tinyobj::index_t& corner : polygon.corners)
      points.push_back(obj.positions[static_cast<size_t>(corner.vertex_index)]);
    triangulate(points, triangles);
    for (const Face& t : triangles) visit(polygon.corners[t[0]], polygon.corners[t[1]], polygon.corners[t[2]]);
  }
}

/// The smooth normal of every position over all shapes, so that no seam shows between groups and materials.
std::vector<Vec3f> normals_of_positions(const Obj& obj) {
  Mesh whole;
  whole.positions = obj.positions;
  for (const tinyobj::shape_t& shape : obj.shapes) {
    for_each_triangle(
        obj, polygons_of(shape), [&](const tinyobj::index_t& a, const tinyobj::index_t& b, const tinyobj::index_t& c) {
          whole.faces.push_back({static_cast<uint32_t>(a.vertex_index), static_cast<uint32_t>(b.vertex_index),
                                 static_cast<uint32_t>(c.vertex_index)});
        });
  }
  return smooth_normals(whole);
}

struct CornerHash {
  size_t operator()(const std::array<int, 3>& corner) const {
    uint64_t hash = 0;
    for (const int index : corner) hash = hash64(hash + static_cast<uint32_t>(index));
    return hash;
  }
};

/// A mesh that grows by corners; equal corners share a vertex.
class WeldedMesh {
 public:
  WeldedMesh(const Obj& obj, const std::vector<Vec3f>& smooth) : obj_(obj), smooth_(smooth) {}

  uint32_t vertex(const tinyobj::index_t& corner) {
    const auto [place, is_new] =
        vertices_.try_emplace({corner.vertex_index, corner.texcoord_index, corner.normal_index},
                              static_cast<uint32_t>(mesh.positions.size()));
    if (is_new) append(corner);
    return place->second;
  }

  Mesh mesh;
  bool has_texcoords = false;

 private:
  void append(const tinyobj::index_t& corner) {
    const auto v = static_cast<size_t>(corner.vertex_index);
    mesh.positions.push_back(obj_.positions[v]);
    const bool has_normal = corner.normal_index >= 0;
    mesh.normals.push_back(has_normal ? triple(obj_.attributes.normals, static_cast<size_t>(corner.normal_index))
                                      : smooth_[v]);
    Vec2f texcoord{};
    if (corner.texcoord_index >= 0) {
      const auto t = static_cast<size_t>(corner.texcoord_index);
      // Texture coordinates of OBJ begin at the bottom, glTF's at the top.
      texcoord = {{obj_.attributes.texcoords[2 * t], 1 - obj_.attributes.texcoords[2 * t + 1]}};
      has_texcoords = true;
    }
    mesh.texcoords[0].push_back(texcoord);
    if (obj_.has_colors) mesh.colors.push_back(linear_color(triple(obj_.attributes.colors, v)));
  }

  static Vec4f linear_color(const Vec3f& encoded) {
    Vec4f linear = Vec4f::filled(1);
    for (int c = 0; c < 3; c++) linear[c] = srgb_to_linear(std::clamp(encoded[c], 0.0f, 1.0f));
    return linear;
  }

  const Obj& obj_;
  const std::vector<Vec3f>& smooth_;
  std::unordered_map<std::array<int, 3>, uint32_t, CornerHash> vertices_;
};

/// The glTF materials that stand for the library's, each at most once with and once without textures.
class MaterialTable {
 public:
  MaterialTable(const ObjMaterialReader& reader, SceneBuilder& scene) : reader_(reader), scene_(scene) {}

  int material(int index, bool has_texcoords) {
    const auto [place, is_new] = made_.try_emplace({index, has_texcoords}, 0);
    if (is_new) place->second = make(index, has_texcoords);
    return place->second;
  }

 private:
  int make(int index, bool has_texcoords) {
    if (index < 0) return scene_.material(Lambertian{.name = "surface", .double_sided = true});
    return reader_.add_to(scene_, static_cast<size_t>(index), has_texcoords);
  }

  const ObjMaterialReader& reader_;
  SceneBuilder& scene_;
  std::map<std::pair<int, bool>, int> made_;
};

/// The polygons of a shape in parts of one material each.
std::vector<std::vector<Polygon>> parts_of(const tinyobj::shape_t& shape) {
  std::map<int, std::vector<Polygon>> by_material;
  for (const Polygon& polygon : polygons_of(shape)) by_material[polygon.material].push_back(polygon);
  std::vector<std::vector<Polygon>> parts;
  for (auto& [material, polygons] : by_material) parts.push_back(std::move(polygons));
  return parts;
}

/// Adds a shape as a node with a primitive for each material. They are made one after the other, since there may be
/// very many.
void add_shape(const Obj& obj, const std::string& name, std::span<const std::vector<Polygon>> parts,
               const std::vector<Vec3f>& smooth, MaterialTable& materials, const Vec3d& origin, SceneBuilder& scene) {
  Json primitives = Json::array();
  for (const std::vector<Polygon>& part : parts) {
    WeldedMesh welded(obj, smooth);
    for_each_triangle(obj, part, [&](const tinyobj::index_t& a, const tinyobj::index_t& b, const tinyobj::index_t& c) {
      welded.mesh.faces.push_back({welded.vertex(a), welded.vertex(b), welded.vertex(c)});
    });
    if (welded.mesh.faces.empty()) continue;
    if (!welded.has_texcoords) welded.mesh.texcoords[0].clear();
    complete_normals(welded.mesh);
    primitives.push_back(
        scene.primitive({welded.mesh, materials.material(part.front().material, welded.has_texcoords)}));
  }
  if (!primitives.empty()) scene.object_of(name, std::move(primitives), origin);
}

}  // namespace

Result<Document> obj_document(Bytes file, const std::filesystem::path& folder, Report& report, ImageLimit limit) {
  LW_TRY(text, checked_obj_text(file, report));
  const Vec3d origin = move_to_origin(text);
  ObjMaterialReader materials(folder, limit, report);
  LW_TRY(obj, read_obj(text, materials, report));
  const std::vector<Vec3f> smooth = normals_of_positions(obj);
  SceneBuilder scene;
  MaterialTable table(materials, scene);
  size_t faces = 0, parts = 0;
  for (const tinyobj::shape_t& shape : obj.shapes) {
    faces += shape.mesh.num_face_vertices.size();
    const std::vector<std::vector<Polygon>> own = parts_of(shape);
    parts += own.size();
    if (parts > most_obj_parts)
      return fail(
          ErrorKind::limit, "",
          "has more than " + std::to_string(most_obj_parts) + " parts, faces of one shape and one material each");
    add_shape(obj, shape.name, own, smooth, table, origin, scene);
  }
  if (faces == 0) return fail("", "has no faces");
  Document document = scene.release();
  document.folder = folder;
  return document;
}

}  // namespace lightwell
