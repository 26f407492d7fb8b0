// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "lightwell/asset/asset.h"
#include "lightwell/light/push_pull.h"
#include "lightwell/pack/directory.h"

namespace lightwell {

class LatticeDecoder;

/// The state that the decoders of a pack share.
struct AssetContext {
  Bytes bin;                            ///< the data of the opening's BIN chunk
  Fill fill = Fill::push_pull;          ///< how nodes of a light grid that have not arrived are filled
  uint64_t budget = uint64_t(3) << 30;  ///< bytes left for buffers, out of a WebAssembly module's 4 GiB
  std::vector<std::shared_ptr<LatticeDecoder>> lattices{};  ///< of the light streams that are open, by stream

  /// Takes bytes from the budget; fails when fewer are left.
  Result<void> spend(uint64_t bytes);
};

/// Opens the decoder for a stream's kind and codec. Fails, naming the stream, for invalid parameters, for unknown
/// codecs, for sizes that the stream's length cannot hold, and for those beyond the budget, before anything of that
/// size is allocated.
Result<std::unique_ptr<AssetDecoder>> open_asset(const Directory& directory, uint32_t stream, AssetContext& context);

/// The same for a stream of a given kind: MeshAsset, LightAsset, TextureAsset or PartsAsset. Also fails when there is
/// no such stream or it is of another kind.
template <typename Kind>
Result<std::unique_ptr<Kind>> open_asset_as(const Directory& directory, size_t stream, AssetContext& context) {
  if (stream >= directory.streams.size() || directory.streams[stream].kind != Kind::kind)
    return fail("stream " + std::to_string(stream), "is no " + std::string(to_text(Kind::kind)) + " stream");
  LW_TRY(decoder, open_asset(directory, static_cast<uint32_t>(stream), context));
  return std::unique_ptr<Kind>(static_cast<Kind*>(decoder.release()));  // all codecs of a kind create one
}

/// The arguments of the function that opens a codec.
struct AssetSource {
  const Directory& directory;
  const StreamEntry& entry;
  uint32_t asset;  ///< the number of the stream
  AssetContext& context;
};

// Each has a file of its own: light_bricks.cpp, light_lattice.cpp, light_slices.cpp, mesh_splits.cpp, parts_file.cpp,
// texture_file.cpp.
Result<std::unique_ptr<AssetDecoder>> open_light_bricks(const AssetSource& source);
Result<std::unique_ptr<AssetDecoder>> open_light_lattice(const AssetSource& source);
Result<std::unique_ptr<AssetDecoder>> open_light_slices(const AssetSource& source);
Result<std::unique_ptr<AssetDecoder>> open_mesh_splits(const AssetSource& source);
Result<std::unique_ptr<AssetDecoder>> open_parts_file(const AssetSource& source);
Result<std::unique_ptr<AssetDecoder>> open_texture_file(const AssetSource& source);

}  // namespace lightwell
