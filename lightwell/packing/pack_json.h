// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/pack/writer.h"
#include "lightwell/packing/encoded_light.h"
#include "lightwell/packing/environment_picture.h"
#include "lightwell/packing/pack_images.h"
#include "lightwell/packing/pack_light.h"
#include "lightwell/packing/pack_meshes.h"

namespace lightwell {

/// The contents of the streams of a pack, which are numbered in this order: light grids, their bricks where those are
/// apart, meshes, images, parts.
struct PackContent {
  EncodedLight light;
  std::vector<StreamedMesh> meshes;
  std::vector<StreamedImage> images;
  std::optional<MergedParts> parts;
  std::optional<EnvironmentPicture> environment;

  size_t grid_stream(size_t index) const { return index; }
  size_t mesh_stream(size_t index) const { return light.streams.size() + index; }
  size_t image_stream(size_t index) const { return mesh_stream(meshes.size()) + index; }
  size_t parts_stream() const { return image_stream(images.size()); }
};

/// Adds the extensions that do not depend on the pack's id: LIGHTWELL_progressive_mesh, LIGHTWELL_progressive_texture,
/// LIGHTWELL_light_grids, LIGHTWELL_lamps, LIGHTWELL_parts and LIGHTWELL_environment (docs/format.md).
void add_extensions(Document& document, const Scene& scene, const PackLight& light, const PackContent& content);

/// Adds LIGHTWELL_streams: format version, id, generator and exposure (EV).
void add_pack_identity(Json& json, const PackId& id, float exposure, const Vec3d& origin);

}  // namespace lightwell
