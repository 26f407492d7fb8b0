// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/base/progress.h"
#include "lightwell/packing/pack_light.h"
#include "lightwell/packing/pack_options.h"
#include "lightwell/scene/scene.h"

namespace lightwell {

struct PackStatistics {
  uint64_t triangles = 0;  ///< of all meshes; each counts once, however many instances it has
  uint64_t vertices = 0;
  uint64_t opening_bytes = 0, geometry_bytes = 0, light_bytes = 0, texture_bytes = 0;
};

/// Makes the pack of a scene (docs/format.md): an opening with a coarse level of every mesh and a preview of every
/// image, and the streams that refine them: light grids, then meshes by decreasing error, then images. Deforming
/// meshes, lines and points go into the opening as they are. Fails when cancelled or when a limit of the format is
/// exceeded.
Result<std::vector<uint8_t>> make_pack(Scene scene, const PackLight& light, const PackOptions& options,
                                       Progress& progress, Report& report, PackStatistics& statistics);

}  // namespace lightwell
