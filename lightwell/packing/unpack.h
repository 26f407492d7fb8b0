// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "lightwell/asset/codecs.h"
#include "lightwell/gltf/document.h"
#include "lightwell/light/push_pull.h"
#include "lightwell/mesh/mesh.h"
#include "lightwell/pack/opening.h"
#include "lightwell/packing/opened_pack.h"

namespace lightwell {

/// How finely meshes are wanted: the coarsest level that has at least `share` of the final faces, and an error of at
/// most `error` (in each mesh's own units) unless that is negative.
struct MeshLevel {
  float share = 1;
  float error = -1;
};

/// The decoder of a stream that has to be of a kind (asset/codecs.h), alone in the memory that a client gives to all.
template <typename Kind>
Result<std::unique_ptr<Kind>> open_asset_as(const PackReader& pack, size_t stream) {
  AssetContext context{.bin = glb_chunks(pack.opening()).bin};
  return open_asset_as<Kind>(pack.directory(), stream, context);
}

/// Where the finer levels of an opening come from, by stream.
struct PackRefinement {
  std::function<Result<Mesh>(size_t stream)> mesh;
  std::function<Result<std::vector<uint8_t>>(size_t stream)> image;  ///< an image file; empty: the preview stays
};

/// Puts finer meshes and whole images in place of those of an opening, and takes its LIGHTWELL_ extensions out.
Result<void> refine_document(Document& document, const PackRefinement& refinement);

/// The glTF of a pack at a level, without the LIGHTWELL_ extensions: the opening with refined meshes and whole images.
Result<Document> unpack_document(const OpenedPack& pack, const MeshLevel& level, Report& report);

/// How much of a light grid is wanted: the first bundles that bring at least `share` of its nodes, the others filled.
struct LightLevel {
  float share = 1;
  Fill fill = Fill::push_pull;
};

/// The light grid of a light stream at a level.
Result<LightGrid> unpack_light(const PackReader& pack, size_t stream, const LightLevel& level);

}  // namespace lightwell
