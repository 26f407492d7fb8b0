// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/base/progress.h"
#include "lightwell/light/client_lamp.h"
#include "lightwell/light/grid.h"
#include "lightwell/light/light_field.h"
#include "lightwell/scene/scene.h"

namespace lightwell {

struct PackOptions {
  float position_error = 0;  ///< metres that a vertex may move; 0: 14 bits for the longest side of each mesh
  int threads = 0;           ///< 0: all processors
};

/// A light grid as a pack states it.
struct PackGrid {
  const LightGrid* grid = nullptr;
  GridContents contains{};
  float estimated_error = 0;  ///< share of its root mean square
  int priority = 0;           ///< where grids overlap, the one of greater priority is looked up
  uint64_t seed = 1;          ///< of the order in which its nodes are streamed
};

/// The light of a scene as a pack states it.
struct PackLight {
  std::vector<PackGrid> grids;
  std::vector<ClientLamp> lamps;  ///< of the client, the strongest first
  float exposure = 0;             ///< EV
};

struct PackStatistics {
  uint64_t triangles = 0;  ///< of all meshes, instances counted once
  uint64_t vertices = 0;
  uint64_t opening_bytes = 0, geometry_bytes = 0, light_bytes = 0, texture_bytes = 0;
};

/// Makes the pack of a scene (docs/format.md): its glTF with the coarsest level of every mesh and a small picture for
/// every image, and the streams that refine them: the grids first, then meshes, the ones of greatest error first, then
/// images. Meshes that deform, lines and points go into the opening as they are. Fails when the user cancels or a limit
/// of the format is exceeded.
Result<std::vector<uint8_t>> make_pack(const Scene& scene, const PackLight& light, const PackOptions& options,
                                       Progress& progress, Report& report, PackStatistics& statistics);

}  // namespace lightwell
