// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "lightwell/base/transform.h"
#include "lightwell/gltf/document.h"
#include "lightwell/mesh/mesh.h"
#include "lightwell/scene/orientation.h"
#include "lightwell/texture/image.h"

namespace lightwell {

/// How a material reads an image, in texture coordinates with v downwards as in glTF.
struct TextureLookup {
  enum class Wrap { repeat, mirror, clamp };

  int image = -1;    ///< index into Scene::images; -1: no texture
  int texcoord = 0;  ///< which set of the mesh
  Wrap wrap_u = Wrap::repeat;
  Wrap wrap_v = Wrap::repeat;
  /// KHR_texture_transform as rows of a 2x3 matrix: u' = a u + b v + c.
  std::array<float, 3> row_u{1, 0, 0};
  std::array<float, 3> row_v{0, 1, 0};
};

/// The part of a glTF material that light transport uses. Colours are linear.
struct Material {
  enum class Alpha { opaque, mask, blend };

  std::string name;
  Vec4f base_color = Vec4f::filled(1);
  TextureLookup base_color_texture;  ///< sRGB
  Vec3f emission{};                  ///< radiance of the front, W/m2/sr: emissiveFactor * emissiveStrength
  TextureLookup emission_texture;    ///< sRGB
  float metallic = 1;
  float roughness = 1;
  TextureLookup metallic_roughness_texture;  ///< linear: green roughness, blue metallic
  float transmission = 0;                    ///< KHR_materials_transmission
  TextureLookup transmission_texture;        ///< linear: red
  float specular = 1;                        ///< KHR_materials_specular: of the dielectric's gloss
  TextureLookup specular_texture;            ///< linear: alpha
  Vec3f specular_color = Vec3f::filled(1);   ///< KHR_materials_specular: at normal incidence
  TextureLookup specular_color_texture;      ///< sRGB
  float ior = 1.5f;                          ///< KHR_materials_ior
  TextureLookup normal_texture;              ///< linear: a direction, x along u, y against v
  float normal_scale = 1;                    ///< of its x and y
  Alpha alpha = Alpha::opaque;
  float alpha_cutoff = 0.5f;
  bool double_sided = false;
  bool unlit = false;  ///< KHR_materials_unlit: shows its base colour; for the light around it, it is a diffuse one
};

/// One drawable piece of a mesh: a glTF primitive of triangles, shared by all its instances.
struct Primitive {
  Mesh mesh;             ///< in the space of its glTF mesh
  int material = -1;     ///< index into Scene::materials; -1: glTF's default material
  int source_mesh = -1;  ///< where it stands in Scene::document
  int source_primitive = -1;
  bool deforming = false;  ///< skinned or morphed: `mesh` is in its pose; a pack has it at rest, with what bends it
};

/// A primitive placed in the scene.
struct Instance {
  int primitive = 0;
  Transform to_scene;
  int node = -1;  ///< of Scene::document
};

/// A lamp without extent, after KHR_lights_punctual.
struct Lamp {
  enum class Kind { point, spot, sun };

  Kind kind = Kind::point;
  std::string name;
  Vec3f position{};             ///< metres; not for a sun
  Vec3f direction{{0, 0, -1}};  ///< unit, the way the light goes; not for a point
  Vec3f intensity{};            ///< color * intensity: W/sr, of a sun the irradiance facing it, W/m2
  float range = 0;              ///< metres; 0: unlimited
  float inner_cone = 0;         ///< radians from the axis, of a spot
  float outer_cone = 0.7853982f;
  int node = -1;  ///< of Scene::document
};

constexpr int largest_picture_side = 16384;  ///< pixels, of a picture that Lightwell makes

struct Camera {
  std::string name;
  Transform to_scene;  ///< looks along its -z, y up
  float yfov = 0.8f;   ///< radians
  float aspect = 0;    ///< width / height; 0: the picture's
  int width = 0;       ///< pixels, from extras, 0 when the file says nothing
  int height = 0;
};

/// The radiance that arrives from outside the scene, where a ray meets no surface.
struct Environment {
  Vec3f radiance{};                          ///< constant over all directions; scales the map when there is one
  std::shared_ptr<const RadianceImage> map;  ///< latitude-longitude: u = 0.5 + atan2(x, -z)/2pi, v = acos(y)/pi
};

/// A scene as the baker sees it: metres, y up, linear RGB. `document` is the glTF it came from (OBJ, PLY and the
/// built-in scenes are turned into one), so that names, extras and extensions survive into the pack.
struct Scene {
  std::string name;
  Vec3d origin{};  ///< what all coordinates but the document's are counted from (scene/place.h), in its coordinates
  Document document;
  std::vector<Primitive> primitives;
  std::vector<Instance> instances;
  std::vector<Material> materials;
  std::vector<Image> images;  ///< decoded; one that is not or cannot be read is a white pixel
  std::vector<Lamp> lamps;
  std::vector<Camera> cameras;
  Environment environment;

  /// The box of all instances, in scene space.
  Box3f bounds() const;
  const Material& material_of(const Primitive& primitive) const;
};

/// What the intensities of a file's lamps are: W/sr and W/m2, or cd and lx; automatic: by the program that wrote it.
enum class LampUnits { automatic, radiometric, photometric };

struct ImportOptions {
  Orientation orientation = {};
  uint64_t seed = 1;       ///< of built-in scenes
  std::string scene = {};  ///< name or number of the scene in a glTF that is shown; empty: its default one
  ImageLimit images = {};  ///< of each
  LampUnits lamp_units = LampUnits::automatic;
};

/// Reads a scene: a glTF 2.0 or GLB, OBJ or PLY file, each possibly gzipped, recognised by content; or a built-in scene
/// by name, see builtin_scenes(). Nothing outside the file's folder is read. `report` gets a warning for everything
/// unsupported. Errors name file, element and reason.
Result<Scene> load_scene(const std::string& path, const ImportOptions& options, Report& report);

}  // namespace lightwell
