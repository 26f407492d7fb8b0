// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/pack/writer.h"
#include "lightwell/packing/pack_images.h"
#include "lightwell/packing/pack_light.h"
#include "lightwell/packing/pack_meshes.h"

namespace lightwell {

/// The streams of a pack in their order: light grids, meshes, images.
struct PackContent {
  size_t grids = 0;
  std::vector<StreamedMesh> meshes;
  std::vector<StreamedImage> images;

  size_t grid_stream(size_t index) const { return index; }
  size_t mesh_stream(size_t index) const { return grids + index; }
  size_t image_stream(size_t index) const { return grids + meshes.size() + index; }
};

/// Adds the extensions that do not depend on where streams lie: LIGHTWELL_progressive_mesh,
/// LIGHTWELL_progressive_texture, LIGHTWELL_light_grids and LIGHTWELL_lamps (docs/format.md).
void add_extensions(Document& document, const Scene& scene, const PackLight& light, const PackContent& content);

/// Adds LIGHTWELL_streams: the format's version, the pack's id, what baked it and the exposure (EV).
void add_pack_identity(Json& json, const PackId& id, float exposure);

}  // namespace lightwell
