// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "lightwell/light/grid.h"
#include "lightwell/mesh/mesh.h"

namespace lightwell {

/// What a sample pack is made of.
struct SampleScene {
  std::vector<Mesh> meshes;  ///< each a node of its own
  LightGrid grid;
  std::vector<uint8_t> image;        ///< a PNG file, the base colour of the first mesh
  std::vector<uint8_t> small_image;  ///< the same, smaller, for the opening
};

/// A room with a red and a green wall, in it a sphere with bumps of about `triangles` triangles; the light is a
/// formula, `nodes` on each axis of its grid.
SampleScene sample_scene(uint32_t triangles, int nodes);

/// Its pack: a stream for the grid, each mesh, and the image. `salt` makes another pack of the same layout.
std::vector<uint8_t> sample_pack(const SampleScene& scene, uint32_t salt = 0);

}  // namespace lightwell
