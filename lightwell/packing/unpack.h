// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>

#include "lightwell/asset/codecs.h"
#include "lightwell/gltf/document.h"
#include "lightwell/light/lattice_stream.h"
#include "lightwell/light/push_pull.h"
#include "lightwell/mesh/mesh.h"
#include "lightwell/pack/opening.h"
#include "lightwell/packing/opened_pack.h"
#include "lightwell/texture/image.h"

namespace lightwell {

/// The level of unpacked meshes: the coarsest with at least `share` of the final faces and an error of at most `error`
/// (in each mesh's own units; negative: any).
struct MeshLevel {
  float share = 1;
  float error = -1;
};

/// Opens the decoder of a stream of the given kind (asset/codecs.h), with the whole memory budget of a client to
/// itself.
template <typename Kind>
Result<std::unique_ptr<Kind>> open_asset_as(const PackReader& pack, size_t stream) {
  AssetContext context{.bin = glb_chunks(pack.opening()).bin};
  return open_asset_as<Kind>(pack.directory(), stream, context);
}

/// The sources of finer meshes, one for each region, and full images, by stream.
struct PackRefinement {
  std::function<Result<std::vector<Mesh>>(size_t stream)> meshes;
  std::function<Result<std::vector<uint8_t>>(size_t stream)> image;  ///< an image file; empty to keep the preview
};

/// Replaces the meshes and previews of an opening by finer meshes and full images, and removes its LIGHTWELL_
/// extensions.
Result<void> refine_document(Document& document, const PackRefinement& refinement);

/// The glTF of a pack with meshes of the given level and full images, without LIGHTWELL_ extensions. Parts
/// that were merged are so here.
Result<Document> unpack_document(const OpenedPack& pack, const MeshLevel& level, Report& report);

/// The image file that a texture stream brings, of an image or of a level of one.
Result<std::vector<uint8_t>> unpack_image(const PackReader& pack, size_t stream);

/// Takes the merged mesh of such a document apart (restore_parts), where the pack has one.
Result<void> unpack_parts(const OpenedPack& pack, Document& document);

/// The radiance of what surrounds the scene of a pack; nothing where it has no picture of that.
Result<std::optional<RadianceImage>> unpack_environment(const OpenedPack& pack, ImageLimit limit);

/// The part of a light grid to unpack: the first bundles that together hold at least `share` of its nodes. The
/// remaining nodes are filled. And how the light between them is found.
struct LightLevel {
  float share = 1;
  Fill fill = Fill::push_pull;
  LightLookup lookup = LightLookup::trilinear;
};

/// The streams of bricks of a light stream's grid, and what they say. Fails for invalid parameters of any such stream.
Result<std::map<uint32_t, BricksLayout>> bricks_of_grid(const Directory& directory, size_t grid);

/// The light grid of a light stream at the given level. Fails when `share` is 1 and the stream is incomplete.
Result<LightGrid> unpack_light(const PackReader& pack, size_t stream, const LightLevel& level);

}  // namespace lightwell
