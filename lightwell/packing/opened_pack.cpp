// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/opened_pack.h"

#include <span>

#include "lightwell/pack/opening.h"
#include "lightwell/pack/self_contained.h"
#include "lightwell/packing/lamps_extension.h"

namespace lightwell {

Result<OpenedPack> OpenedPack::open(PackReader reader) {
  OpenedPack pack(std::move(reader));
  LW_CHECK(pack.read_json());
  LW_CHECK(pack.check_streams());
  return pack;
}

Result<OpenedPack> OpenedPack::open_file(const std::string& path) {
  LW_TRY(reader, PackReader::open_file(path));
  auto pack = open(std::move(reader));
  if (!pack) return fail(in_file(pack.error(), path));
  return pack;
}

Bytes OpenedPack::bin() const { return glb_chunks(reader_.opening()).bin; }

Result<void> OpenedPack::read_json() {
  const Bytes opening = reader_.opening(), text = glb_chunks(opening).json;
  // Else a reader of the document would take in files beside whatever folder it runs in.
  LW_CHECK(check_self_contained({reinterpret_cast<const char*>(text.data()), text.size()}));
  LW_TRY(json, parse_json(text, static_cast<uint64_t>(text.data() - opening.data())));
  json_ = std::move(json);
  LW_TRY(identity, read_identity(json_));
  LW_TRY(grids, read_grids(json_));
  LW_TRY(lamps, read_lamps(json_));
  LW_TRY(primitives, read_refined_primitives(json_));
  LW_TRY(textures, read_refined_textures(json_));
  LW_TRY(parts, read_parts_description(json_));
  LW_TRY(environment, read_environment_picture(json_));
  identity_ = std::move(identity);
  grids_ = std::move(grids);
  lamps_ = std::move(lamps);
  primitives_ = std::move(primitives);
  textures_ = std::move(textures);
  parts_ = parts;
  environment_ = environment;
  return {};
}

Result<void> OpenedPack::check_streams() const {
  const auto& streams = reader_.directory().streams;
  const auto check = [&](const auto& elements, StreamKind kind, const char* extension) -> Result<void> {
    for (const auto& named : elements)
      if (named.stream >= streams.size() || streams[named.stream].kind != kind)
        return fail(extension, "stream " + std::to_string(named.stream) + " is no " + to_text(kind) + " stream");
    return {};
  };
  LW_CHECK(check(grids_, StreamKind::light, grids_extension));
  for (const GridDescription& grid : grids_) LW_CHECK(check(grid.bricks, StreamKind::bricks, grids_extension));
  LW_CHECK(check(primitives_, StreamKind::mesh, mesh_extension));
  if (parts_) LW_CHECK(check(std::span(&*parts_, 1), StreamKind::parts, parts_extension));
  for (const RefinedTexture& texture : textures_)
    LW_CHECK(check(texture.levels, StreamKind::texture, texture_extension));
  return check(textures_, StreamKind::texture, texture_extension);
}

}  // namespace lightwell
