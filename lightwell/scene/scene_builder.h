// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "lightwell/gltf/document.h"

namespace lightwell {

/// A glTF material that reflects the same radiance into all directions: metallic 0, roughness 1, no specular
/// reflection.
struct Lambertian {
  std::string name;
  Vec3f color = Vec3f::filled(0.8f);  ///< reflectance, linear, in [0, 1]
  Vec3f emission{};                   ///< radiance of the front, W/m2/sr
  bool double_sided = false;
};

Json lambertian_json(const Lambertian& material);

/// A relative path as a URI: everything but letters, digits and a few signs becomes %XX, a backslash a slash.
std::string as_uri(const std::string& path);

/// Where an image lies on a surface: texture coordinates, v up as most formats have it, times `scale` plus `offset`.
struct TexturePlacement {
  Vec2f offset{}, scale = Vec2f::filled(1);
  bool clamped = false;  ///< beyond the image its border goes on; otherwise it repeats
};

/// Builds a glTF document from meshes and materials, one node an object.
class SceneBuilder {
 public:
  struct Part {
    const Mesh& mesh;
    int material;
  };

  SceneBuilder() = default;
  SceneBuilder(const SceneBuilder&) = delete;
  SceneBuilder& operator=(const SceneBuilder&) = delete;

  int material(const Lambertian& material) { return this->material(lambertian_json(material)); }
  /// A material as glTF has it; its extensions are added to the document's list.
  int material(Json material);
  /// An image by its URI, relative to the document's folder, as a material refers to it; one image for all uses of the
  /// URI.
  Json texture(const std::string& uri, const TexturePlacement& placement = {});
  /// The same of a PNG file.
  Json texture(const std::vector<uint8_t>& png, const TexturePlacement& placement = {});
  /// A node with a mesh of these parts, whose positions are counted from `origin`.
  void object(const std::string& name, const std::vector<Part>& parts, const Vec3d& origin = {});
  /// The same in two steps, for a mesh whose parts are not all at hand at one time.
  Json primitive(const Part& part);
  void object_of(const std::string& name, Json primitives, const Vec3d& origin);
  /// A perspective camera at `eye` that looks towards `target`, y up; yfov in radians, the picture's size in pixels.
  void camera(const std::string& name, const Vec3d& eye, const Vec3d& target, double yfov, int width, int height);
  Document release() { return std::move(document_); }

 private:
  void use_extension(const std::string& name);
  Json texture_of(int image, const TexturePlacement& placement);
  void show();  // makes a scene, if there is none yet
  void node(Json node);

  Document document_;
  DocumentBuilder builder_{document_};
  std::map<std::string, int> images_;             // by URI
  std::map<std::pair<int, bool>, int> textures_;  // by image, and whether it is clamped
};

}  // namespace lightwell
