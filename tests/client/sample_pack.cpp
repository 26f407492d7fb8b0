// SPDX-License-Identifier: Apache-2.0
#include "tests/client/sample_pack.h"

#include <cmath>
#include <iomanip>
#include <limits>
#include <numbers>
#include <sstream>

#include "lightwell/base/file_blocks.h"
#include "lightwell/base/progress.h"
#include "lightwell/light/stream.h"
#include "lightwell/mesh/base_places.h"
#include "lightwell/mesh/progressive.h"
#include "lightwell/mesh/stream.h"
#include "lightwell/pack/writer.h"
#include "lightwell/texture/image_file.h"
#include "lightwell/texture/stream.h"

namespace lightwell {
namespace {

constexpr float room = 1;        // half its side, metres
constexpr float wall_error = 1;  // of the coarse texture: any number that falls to 0

/// A sphere of rings and sectors whose radius varies; its poles are single vertices, its seam is doubled for the
/// texture.
Mesh bumpy_sphere(uint32_t triangles) {
  const uint32_t rings = std::max(4u, static_cast<uint32_t>(std::sqrt(triangles / 4.0))), sectors = 2 * rings;
  Mesh mesh;
  for (uint32_t i = 0; i <= rings; i++)
    for (uint32_t j = 0; j <= sectors; j++) {
      const float v = static_cast<float>(i) / static_cast<float>(rings),
                  u = static_cast<float>(j % sectors) / static_cast<float>(sectors);
      const float theta = v * std::numbers::pi_v<float>, phi = 2 * u * std::numbers::pi_v<float>;
      const Vec3f direction{{std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)}};
      const float radius = 0.5f + 0.04f * std::sin(12 * theta) * std::sin(theta) * std::sin(8 * phi);
      mesh.positions.push_back(direction * radius);
      mesh.texcoords[0].push_back({{static_cast<float>(j) / static_cast<float>(sectors), v}});
    }
  for (uint32_t i = 0; i < rings; i++)
    for (uint32_t j = 0; j < sectors; j++) {
      const uint32_t a = i * (sectors + 1) + j, b = a + sectors + 1;
      if (i > 0) mesh.faces.push_back({a, a + 1, b});
      if (i + 1 < rings) mesh.faces.push_back({a + 1, b + 1, b});
    }
  mesh.normals = smooth_normals(mesh);
  return mesh;
}

/// The room's inner walls but the front one, left red and right green.
Mesh walls() {
  Mesh mesh;
  const auto wall = [&](Vec3f normal, Vec3f up, Vec4f color) {
    const Vec3f side = cross(up, normal);
    const uint32_t first = static_cast<uint32_t>(mesh.positions.size());
    for (const auto& [s, t] : {std::pair{-1.0f, -1.0f}, {1.0f, -1.0f}, {1.0f, 1.0f}, {-1.0f, 1.0f}}) {
      mesh.positions.push_back((side * s + up * t - normal) * room);
      mesh.normals.push_back(normal);
      mesh.colors.push_back(color);
    }
    mesh.faces.push_back({first, first + 1, first + 2});
    mesh.faces.push_back({first, first + 2, first + 3});
  };
  const Vec4f white{{0.7f, 0.7f, 0.7f, 1}}, red{{0.6f, 0.05f, 0.05f, 1}}, green{{0.1f, 0.5f, 0.1f, 1}};
  const Vec3f x{{1, 0, 0}}, y{{0, 1, 0}}, z{{0, 0, 1}};
  wall(x, y, red);
  wall(-x, y, green);
  wall(y, z, white);
  wall(-y, z, white);
  wall(z, y, white);
  return mesh;
}

/// Light that falls off from the coloured walls and from above.
LightGrid formula_light(int nodes) {
  LightGrid grid;
  const Vec3f corner = Vec3f::filled(room);
  grid.shape = GridShape::over({-corner, corner}, nodes);
  grid.valid.assign(grid.shape.count(), 1);
  const Vec3f red{{0.6f, 0.05f, 0.05f}}, green{{0.1f, 0.5f, 0.1f}}, white{{0.7f, 0.7f, 0.7f}};
  for (size_t i = 0; i < grid.shape.count(); i++) {
    const Vec3f p = grid.shape.position(grid.shape.node(i));
    const Vec3f from_right = green * (1.2f + p[0]), from_left = red * (1.2f - p[0]);
    const Vec3f all = (from_left + from_right) * 0.2f + white * 0.3f;
    Moments moments;
    moments.m = {from_right + all, from_left + all, white * (1.2f + p[1]) + all, all, all, all, Vec3f{},
                 Vec3f{},          Vec3f{}};
    grid.moments.push_back(moments);
  }
  return grid;
}

std::vector<uint8_t> checked_image(int side) {
  Image image{side, side, 3, {}};
  for (int y = 0; y < side; y++)
    for (int x = 0; x < side; x++)
      for (int channel = 0; channel < 3; channel++)
        image.pixels.push_back(static_cast<uint8_t>(((x * 16 / side + y * 16 / side) % 2 ? 220 : 120) +
                                                    (x * 7 + y * 13 + channel * 5) % 30));
  return write_png(image);
}

/// The BIN chunk in the making, and the JSON of what lies in it.
class Opening {
 public:
  template <typename T>
  uint32_t add(const std::vector<T>& values, const std::string& accessor) {
    const uint32_t place = add_bytes({reinterpret_cast<const uint8_t*>(values.data()), values.size() * sizeof(T)});
    accessors_.push_back("{\"bufferView\":" + std::to_string(views_.size() - 1) + "," + accessor + "}");
    return place;
  }
  uint32_t add_bytes(Bytes bytes) {
    const uint32_t place = static_cast<uint32_t>(bin_.size());
    views_.push_back("{\"buffer\":0,\"byteOffset\":" + std::to_string(place) +
                     ",\"byteLength\":" + std::to_string(bytes.size()) + "}");
    bin_.append(bytes);
    bin_.align(4);
    return place;
  }
  size_t views() const { return views_.size(); }
  size_t accessors() const { return accessors_.size(); }
  std::vector<uint8_t> bin() const { return bin_.bytes(); }

  static std::string list(const std::vector<std::string>& items) {
    std::string text = "[";
    for (const std::string& item : items) text += (text.size() > 1 ? "," : "") + item;
    return text + "]";
  }
  std::string json() const {
    return "\"buffers\":[{\"byteLength\":" + std::to_string(bin_.size()) + "}],\"bufferViews\":" + list(views_) +
           ",\"accessors\":" + list(accessors_);
  }

 private:
  ByteWriter bin_;
  std::vector<std::string> views_, accessors_;
};

std::string triple(const Vec3f& v) {
  std::ostringstream text;
  text << std::setprecision(std::numeric_limits<float>::max_digits10) << "[" << v[0] << "," << v[1] << "," << v[2]
       << "]";
  return text.str();
}

std::string accessor(int component, size_t count, const std::string& type, const std::string& more = "") {
  return "\"componentType\":" + std::to_string(component) + ",\"count\":" + std::to_string(count) + ",\"type\":\"" +
         type + "\"" + more;
}

/// Puts a mesh's coarsest level into the opening and makes its stream; gives the JSON of its primitive.
std::string add_mesh(const Mesh& mesh, bool textured, size_t stream_number, Opening& opening, PackStream& stream) {
  Progress silent;
  const ProgressiveMesh progressive = build_progressive(mesh, {}, silent).value();
  EncodedMesh encoded = encode(progressive);
  const Mesh& base = encoded.base;
  const size_t count = base.positions.size();
  const Box3f bounds = base.bounds();
  BasePlaces places;
  std::vector<std::string> attributes;
  const auto attribute = [&](const std::string& name) {
    attributes.push_back("\"" + name + "\":" + std::to_string(opening.accessors()));
  };
  attribute("POSITION");
  places.positions = opening.add(
      base.positions, accessor(5126, count, "VEC3", ",\"min\":" + triple(bounds.lo) + ",\"max\":" + triple(bounds.hi)));
  if (!base.normals.empty()) {
    attribute("NORMAL");
    places.normals = opening.add(base.normals, accessor(5126, count, "VEC3"));
  }
  if (!base.texcoords[0].empty()) {
    attribute("TEXCOORD_0");
    places.texcoords[0] = opening.add(base.texcoords[0], accessor(5126, count, "VEC2"));
  }
  if (!base.colors.empty()) {
    std::vector<Color16> colors;
    for (const Vec4f& color : base.colors) colors.push_back(color_value(color_code(color)));
    attribute("COLOR_0");
    places.colors = opening.add(colors, accessor(5123, count, "VEC4", ",\"normalized\":true"));
  }
  std::string names = Opening::list(attributes);
  names.front() = '{';
  names.back() = '}';
  const std::string indices = std::to_string(opening.accessors());
  places.indices = opening.add(base.faces, accessor(5125, base.faces.size() * 3, "SCALAR"));

  ByteWriter parameters;
  encoded.layout.write(parameters);
  places.write(parameters);
  stream = {StreamKind::mesh, mesh_codec_splits, encoded.layout.base_error, parameters.release(), {}};
  for (MeshBlock& block : encoded.blocks)
    stream.blocks.push_back({std::move(block.payload), block.vertices, block.error});
  const Box3f all = mesh.bounds();
  return "{\"attributes\":" + names + ",\"indices\":" + indices + ",\"material\":" + (textured ? "0" : "1") +
         ",\"extensions\":{\"LIGHTWELL_progressive_mesh\":{\"stream\":" + std::to_string(stream_number) +
         ",\"vertices\":" + std::to_string(encoded.layout.vertices) +
         ",\"faces\":" + std::to_string(encoded.layout.faces) + ",\"bounds\":{\"min\":" + triple(all.lo) +
         ",\"max\":" + triple(all.hi) + "},\"error\":" + std::to_string(encoded.layout.base_error) + "}}}";
}

PackStream light_stream(const LightGrid& grid) {
  LightStream light = encode_light(grid).value();
  ByteWriter parameters;
  light.layout.write(parameters);
  PackStream stream{StreamKind::light, light_codec_slices, 1, parameters.release(), {}};
  for (LightBundle& bundle : light.bundles)
    stream.blocks.push_back({std::move(bundle.payload), bundle.nodes, bundle.error});
  return stream;
}

PackStream texture_stream(const std::vector<uint8_t>& image, const Image& size) {
  const TextureParameters parameters{static_cast<uint32_t>(image.size()), ImageFormat::png,
                                     static_cast<uint32_t>(size.width), static_cast<uint32_t>(size.height)};
  PackStream stream{StreamKind::texture, texture_codec_file, wall_error, encode_texture_parameters(parameters), {}};
  const std::vector<Bytes> blocks = file_blocks(image);
  for (size_t i = 0; i < blocks.size(); i++)
    stream.blocks.push_back({{blocks[i].begin(), blocks[i].end()},
                             static_cast<uint32_t>(blocks[i].size()),
                             i + 1 < blocks.size() ? wall_error : 0});
  return stream;
}

}  // namespace

SampleScene sample_scene(uint32_t triangles, int nodes) {
  return {{bumpy_sphere(triangles), walls()}, formula_light(nodes), checked_image(256), checked_image(16)};
}

std::vector<uint8_t> sample_pack(const SampleScene& scene, uint32_t salt) {
  Opening opening;
  std::vector<PackStream> streams = {light_stream(scene.grid)};
  std::vector<std::string> meshes, nodes, roots;
  for (const Mesh& mesh : scene.meshes) {
    PackStream stream;
    const std::string primitive = add_mesh(mesh, meshes.empty(), streams.size(), opening, stream);
    nodes.push_back("{\"mesh\":" + std::to_string(meshes.size()) + "}");
    roots.push_back(std::to_string(meshes.size()));
    meshes.push_back("{\"primitives\":[" + primitive + "]}");
    streams.push_back(std::move(stream));
  }
  const size_t texture = streams.size();
  streams.push_back(texture_stream(scene.image, read_png(scene.image).value()));
  const size_t image_view = opening.views();
  opening.add_bytes(scene.small_image);
  ByteWriter salted;
  salted.u32(salt);
  opening.add_bytes(salted.bytes());

  const GridShape& shape = scene.grid.shape;
  const Vec3f counts = shape.nodes.cast<float>();
  const PackWriter writer = PackWriter::create(opening.bin(), std::move(streams)).value();
  return writer
      .finish("{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":" + Opening::list(roots) +
              "}],\"nodes\":" + Opening::list(nodes) + ",\"meshes\":" + Opening::list(meshes) + "," + opening.json() +
              ",\"images\":[{\"bufferView\":" + std::to_string(image_view) + ",\"mimeType\":\"image/png\"}]" +
              ",\"textures\":[{\"source\":0,\"extensions\":{\"LIGHTWELL_progressive_texture\":{\"stream\":" +
              std::to_string(texture) + ",\"width\":256,\"height\":256,\"mimeType\":\"image/png\"}}}]" +
              ",\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0},\"metallicFactor\":0}}," +
              "{\"pbrMetallicRoughness\":{\"metallicFactor\":0}}],\"extensionsUsed\":[\"LIGHTWELL_streams\","
              "\"LIGHTWELL_progressive_mesh\"," +
              "\"LIGHTWELL_progressive_texture\",\"LIGHTWELL_light_grids\"],\"extensions\":{\"LIGHTWELL_streams\":" +
              "{\"version\":0,\"id\":\"" + to_text(writer.plan().id) +
              "\",\"exposure\":0},\"LIGHTWELL_light_grids\":{\"grids\":[{\"stream\":0,\"min\":" + triple(shape.lo) +
              ",\"cell\":" + triple(shape.cell) + ",\"nodes\":" + triple(counts) + ",\"codec\":0,\"normalOffset\":" +
              std::to_string(scene.grid.normal_offset) + ",\"contains\":[\"indirect\"]}]}}}")
      .value();
}

}  // namespace lightwell
