// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>

#include "lightwell/base/assert.h"
#include "lightwell/trace/world.h"
#include "tests/trace/luminaires.h"

namespace lightwell {

/// A Lambertian material.
inline Material lambertian(const Vec3f& albedo, const Vec3f& emission = {}) {
  Material material;
  material.base_color = {{albedo[0], albedo[1], albedo[2], 1}};
  material.emission = emission;
  material.metallic = 0;
  material.specular = 0;
  return material;
}

inline Material lambertian(float albedo, float emission = 0) {
  return lambertian(Vec3f::filled(albedo), Vec3f::filled(emission));
}

/// The parallelogram of a corner and two sides; its front is where u x v points.
inline Mesh quad(const Vec3f& corner, const Vec3f& u, const Vec3f& v) {
  Mesh mesh;
  mesh.positions = {corner, corner + u, corner + u + v, corner + v};
  mesh.faces = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

inline void append(Mesh& mesh, const Mesh& other) {
  const uint32_t first = static_cast<uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
  for (const Face& f : other.faces) mesh.faces.push_back({f[0] + first, f[1] + first, f[2] + first});
}

inline Mesh turned(Mesh mesh) {
  for (Face& f : mesh.faces) std::swap(f[1], f[2]);
  return mesh;
}

/// A box seen from inside.
inline Mesh room(const Vec3f& lo, const Vec3f& hi) {
  const Vec3f s = hi - lo;
  const Vec3f x{{s[0], 0, 0}}, y{{0, s[1], 0}}, z{{0, 0, s[2]}};
  Mesh mesh;
  for (const Mesh& side :
       {quad(lo, z, x), quad(lo, x, y), quad(lo, y, z), quad(hi, -x, -z), quad(hi, -y, -x), quad(hi, -z, -y)}) {
    append(mesh, side);
  }
  return mesh;
}

/// A box seen from outside.
inline Mesh block(const Vec3f& lo, const Vec3f& hi) { return turned(room(lo, hi)); }

/// A sphere seen from inside: an octahedron whose faces are split `splits` times.
inline Mesh sphere(float radius, int splits) {
  Mesh mesh;
  mesh.positions = {{{1, 0, 0}}, {{-1, 0, 0}}, {{0, 1, 0}}, {{0, -1, 0}}, {{0, 0, 1}}, {{0, 0, -1}}};
  mesh.faces = {{0, 4, 2}, {4, 1, 2}, {1, 5, 2}, {5, 0, 2}, {4, 0, 3}, {1, 4, 3}, {5, 1, 3}, {0, 5, 3}};
  for (int i = 0; i < splits; i++) {
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    const auto middle = [&](uint32_t a, uint32_t b) {
      const auto [found, added] = middles.try_emplace(std::minmax(a, b), static_cast<uint32_t>(mesh.positions.size()));
      if (added) mesh.positions.push_back(normalized(mesh.positions[a] + mesh.positions[b]));
      return found->second;
    };
    std::vector<Face> faces;
    for (const Face& f : mesh.faces) {
      const uint32_t a = middle(f[0], f[1]), b = middle(f[1], f[2]), c = middle(f[2], f[0]);
      faces.insert(faces.end(), {{f[0], a, c}, {a, f[1], b}, {c, b, f[2]}, {a, b, c}});
    }
    mesh.faces = std::move(faces);
  }
  for (Vec3f& p : mesh.positions) p *= radius;
  return mesh;
}

/// Adds a mesh with its material as a primitive placed once.
inline void add(Scene& scene, const Mesh& mesh, const Material& material, const Transform& to_scene = {}) {
  scene.primitives.push_back({});
  scene.primitives.back().mesh = mesh;
  scene.primitives.back().material = static_cast<int>(scene.materials.size());
  scene.materials.push_back(material);
  scene.instances.push_back({static_cast<int>(scene.primitives.size()) - 1, to_scene, -1});
}

inline Scene scene_of(const Mesh& mesh, const Material& material) {
  Scene scene;
  add(scene, mesh, material);
  return scene;
}

inline Lamp point_lamp(const Vec3f& position, const Vec3f& intensity, float range = 0) {
  Lamp lamp;
  lamp.position = position;
  lamp.intensity = intensity;
  lamp.range = range;
  return lamp;
}

/// A spot that shines downwards.
inline Lamp spot_lamp(const Vec3f& position, float intensity, float inner_cone, float outer_cone) {
  Lamp lamp = point_lamp(position, Vec3f::filled(intensity));
  lamp.kind = Lamp::Kind::spot;
  lamp.direction = {{0, -1, 0}};
  lamp.inner_cone = inner_cone;
  lamp.outer_cone = outer_cone;
  return lamp;
}

inline Lamp sun_lamp(const Vec3f& direction, float irradiance) {
  Lamp lamp = point_lamp({}, Vec3f::filled(irradiance));
  lamp.kind = Lamp::Kind::sun;
  lamp.direction = direction;
  return lamp;
}

/// The surfaces of a scene made ready, which must be possible.
inline std::unique_ptr<const TraceScene> traced(const Scene& scene) {
  auto result = TraceScene::build(scene);
  LW_ASSERT(result.has_value());
  return std::move(*result);
}

/// A scene made ready with its lights, which must be possible.
inline std::unique_ptr<const World> world_of(const Scene& scene) {
  auto result = World::build(scene);
  LW_ASSERT(result.has_value());
  return std::move(*result);
}

}  // namespace lightwell
