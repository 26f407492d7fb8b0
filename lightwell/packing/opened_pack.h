// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "lightwell/pack/reader.h"
#include "lightwell/packing/grids_extension.h"
#include "lightwell/packing/mesh_extension.h"
#include "lightwell/packing/streams_extension.h"
#include "lightwell/packing/texture_extension.h"
#include "lightwell/scene/client_lamp.h"

namespace lightwell {

/// A pack that is opened and whose JSON is parsed, once for all who ask. The extensions are read: every stream that
/// they name exists and is of the kind. Whether they repeat rightly what the streams say is for verify_pack.
class OpenedPack {
 public:
  /// Fails when the JSON is damaged or an extension cannot be read; the error names the element.
  static Result<OpenedPack> open(PackReader reader);
  /// The same of a file; errors name it.
  static Result<OpenedPack> open_file(const std::string& path);

  const PackReader& reader() const { return reader_; }
  /// The JSON chunk, with its LIGHTWELL_ extensions.
  const Json& json() const { return json_; }
  /// The data of the BIN chunk.
  Bytes bin() const;

  const PackIdentity& identity() const { return identity_; }
  const std::vector<GridDescription>& grids() const { return grids_; }
  /// The lamps that a client lights by itself.
  const std::vector<ClientLamp>& lamps() const { return lamps_; }
  const std::vector<RefinedPrimitive>& primitives() const { return primitives_; }
  const std::vector<RefinedTexture>& textures() const { return textures_; }

 private:
  explicit OpenedPack(PackReader reader) : reader_(std::move(reader)) {}
  Result<void> read_json();
  Result<void> check_streams() const;

  PackReader reader_;
  Json json_;
  PackIdentity identity_;
  std::vector<GridDescription> grids_;
  std::vector<ClientLamp> lamps_;
  std::vector<RefinedPrimitive> primitives_;
  std::vector<RefinedTexture> textures_;
};

}  // namespace lightwell
