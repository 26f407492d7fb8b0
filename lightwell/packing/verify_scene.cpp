// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/verify_scene.h"

#include <algorithm>

#include "lightwell/asset/mesh_asset.h"
#include "lightwell/packing/unpack.h"
#include "lightwell/scene/import_gltf.h"
#include "lightwell/texture/image_file.h"

namespace lightwell {
namespace {

Result<Scene> scene_at(const OpenedPack& pack, const MeshLevel& level) {
  Report report;
  LW_TRY(document, unpack_document(pack, level, report));
  return scene_from_document(std::move(document), "", report, pack.identity().origin, highest_image_limit);
}

// A scene of nothing can be neither traced nor looked at.
Result<void> verify_something_is_shown(const Scene& scene) {
  const auto has_faces = [&](const Instance& instance) {
    return !scene.primitives[static_cast<size_t>(instance.primitive)].mesh.faces.empty();
  };
  if (std::ranges::any_of(scene.instances, has_faces)) return {};
  return fail("scene", "it has no triangles");
}

// Whether a mesh lies in the bounds of the input, apart from rounding to the lattice (`step`).
bool holds(const Box3f& bounds, const Mesh& mesh, float step) {
  for (const Vec3f& p : mesh.positions)
    for (int i = 0; i < 3; i++)
      if (!(p[i] >= bounds.lo[i] - step && p[i] <= bounds.hi[i] + step)) return false;
  return true;
}

// Skips primitives that no node shows, since they are not imported.
Result<void> verify_bounds(const OpenedPack& pack, const Scene& scene) {
  for (const RefinedPrimitive& refined : pack.primitives())
    for (const Primitive& primitive : scene.primitives) {
      if (primitive.source_mesh != static_cast<int>(refined.mesh) ||
          primitive.source_primitive != static_cast<int>(refined.primitive))
        continue;
      LW_TRY(mesh, open_asset_as<MeshAsset>(pack.reader(), refined.stream));
      Mesh at_rest;  // of what deforms, which the scene has in its pose
      if (primitive.deforming) {
        Report known;
        LW_TRY(read, read_primitive(scene.document, primitive.source_mesh, primitive.source_primitive, known));
        at_rest = std::move(read);
      }
      const float step = mesh->layout().regions.empty() ? mesh->layout().positions.step() : 0;
      if (!holds(refined.bounds, primitive.deforming ? at_rest : primitive.mesh, step))
        return fail(element_name("meshes", refined.mesh) + "." + element_name("primitives", refined.primitive),
                    "the bounds in " + std::string(mesh_extension) + " do not hold its final level");
    }
  return {};
}

// Levels can be read, and are as large as is said.
Result<void> verify_levels(const OpenedPack& pack, const RefinedTexture& refined) {
  for (const TextureLevel& level : refined.levels) {
    const std::string name = "stream " + std::to_string(level.stream);
    LW_TRY(file, unpack_image(pack.reader(), level.stream));
    const auto image = read_image_file(file, highest_image_limit);
    if (!image) return fail(image.error().kind, name, image.error().message());
    if (image->width != static_cast<int>(level.width) || image->height != static_cast<int>(level.height))
      return fail(name, "is not of the size that is stated");
  }
  return {};
}

// The picture of the surroundings is no image of the scene: verify_sky reads it.
Result<void> verify_images(const OpenedPack& pack, const Scene& scene) {
  for (const RefinedTexture& refined : pack.textures()) {
    if (refined.source >= scene.images.size()) continue;
    const Image& image = scene.images[refined.source];
    LW_TRY(file, read_image(scene.document, static_cast<int>(refined.source)));
    if (image.width != static_cast<int>(refined.width) || image.height != static_cast<int>(refined.height) ||
        image_format(file) != refined.format)
      return fail(element_name("images", refined.source), "is not of the size and format that its stream states");
    LW_CHECK(verify_levels(pack, refined));
  }
  return {};
}

// What surrounds the scene stands in the JSON or is a picture, and its light is in the grids.
Result<void> verify_sky(const OpenedPack& pack, const Scene& scene) {
  LW_TRY(picture, unpack_environment(pack, highest_image_limit));
  for (const RefinedTexture& refined : pack.textures())
    if (picture && refined.texture == pack.environment()->texture &&
        (picture->width != static_cast<int>(refined.width) || picture->height != static_cast<int>(refined.height)))
      return fail(environment_extension, "its picture is not of the size that its stream states");
  if ((scene.environment.radiance == Vec3f{} && !picture) || contents_of(pack.grids()).environment) return {};
  return fail(grids_extension, "no grid has the light of the scene's sky");
}

// What the parts are taken apart into can be read.
Result<void> verify_parts(const OpenedPack& pack, const Scene& scene) {
  if (!pack.parts()) return {};
  Document document = scene.document;
  LW_CHECK(unpack_parts(pack, document));
  Report report;
  LW_CHECK(scene_from_document(std::move(document), "", report, pack.identity().origin, highest_image_limit));
  return {};
}

}  // namespace

Result<void> verify_scene(const OpenedPack& pack) {
  LW_CHECK(scene_at(pack, {.share = 0}));
  LW_TRY(scene, scene_at(pack, {}));
  LW_CHECK(verify_something_is_shown(scene));
  LW_CHECK(verify_bounds(pack, scene));
  LW_CHECK(verify_sky(pack, scene));
  LW_CHECK(verify_parts(pack, scene));
  return verify_images(pack, scene);
}

}  // namespace lightwell
