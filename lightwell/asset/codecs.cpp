// SPDX-License-Identifier: Apache-2.0
#include "lightwell/asset/codecs.h"

#include "lightwell/asset/parts_asset.h"
#include "lightwell/light/lattice_stream.h"
#include "lightwell/light/stream.h"
#include "lightwell/mesh/stream.h"
#include "lightwell/texture/stream.h"

namespace lightwell {
namespace {

struct Codec {
  StreamKind kind;
  uint8_t number;
  Result<std::unique_ptr<AssetDecoder>> (*open)(const AssetSource& source);
};

/// The table of codecs. All codecs of a kind create that kind's class, on which open_asset_as() relies.
constexpr Codec codecs[] = {
    {StreamKind::light, light_codec_slices, open_light_slices},
    {StreamKind::light, light_codec_lattice, open_light_lattice},
    {StreamKind::bricks, bricks_codec_lattice, open_light_bricks},
    {StreamKind::mesh, mesh_codec_splits, open_mesh_splits},
    {StreamKind::mesh, mesh_codec_regions, open_mesh_splits},
    {StreamKind::parts, parts_codec_gzip, open_parts_file},
    {StreamKind::texture, texture_codec_file, open_texture_file},
};

Result<std::unique_ptr<AssetDecoder>> open(const AssetSource& source) {
  const StreamEntry& entry = source.entry;
  for (const Codec& codec : codecs)
    if (codec.kind == entry.kind && codec.number == entry.codec) return codec.open(source);
  return fail(ErrorKind::unsupported, "codec",
              "the " + std::string(to_text(entry.kind)) + " codec " + std::to_string(entry.codec) +
                  " is not known to this program");
}

}  // namespace

Result<void> AssetContext::spend(uint64_t bytes) {
  if (bytes > budget)
    return fail(ErrorKind::limit, "", "the streams' buffers together would need more memory than a client gives them");
  budget -= bytes;
  return {};
}

Result<std::unique_ptr<AssetDecoder>> open_asset(const Directory& directory, uint32_t stream, AssetContext& context) {
  auto decoder = open({directory, directory.streams[stream], asset_of_stream(stream), context});
  if (!decoder) return fail(in_element(std::move(decoder.error()), "stream " + std::to_string(stream)));
  return decoder;
}

}  // namespace lightwell
