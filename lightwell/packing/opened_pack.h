// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "lightwell/pack/reader.h"
#include "lightwell/packing/environment_extension.h"
#include "lightwell/packing/grids_extension.h"
#include "lightwell/packing/mesh_extension.h"
#include "lightwell/packing/parts_file.h"
#include "lightwell/packing/streams_extension.h"
#include "lightwell/packing/texture_extension.h"
#include "lightwell/scene/client_lamp.h"

namespace lightwell {

/// An opened pack with its JSON parsed and its extensions read. Every stream that an extension names exists and is of
/// the right kind; verify_pack checks that extensions and streams agree.
class OpenedPack {
 public:
  /// Fails when the JSON is damaged or an extension is invalid or names a stream of the wrong kind; the error names the
  /// element.
  static Result<OpenedPack> open(PackReader reader);
  /// The same for a file; errors name it.
  static Result<OpenedPack> open_file(const std::string& path);

  const PackReader& reader() const { return reader_; }
  /// The JSON chunk, with its LIGHTWELL_ extensions.
  const Json& json() const { return json_; }
  /// The data of the BIN chunk.
  Bytes bin() const;

  const PackIdentity& identity() const { return identity_; }
  const std::vector<GridDescription>& grids() const { return grids_; }
  /// The lamps whose direct light the client computes.
  const std::vector<ClientLamp>& lamps() const { return lamps_; }
  const std::vector<RefinedPrimitive>& primitives() const { return primitives_; }
  const std::vector<RefinedTexture>& textures() const { return textures_; }
  /// Where the parts are that its last mesh was merged from, if it was.
  const std::optional<PartsDescription>& parts() const { return parts_; }
  /// The picture of what surrounds the scene, where that has one.
  const std::optional<EnvironmentPicture>& environment() const { return environment_; }

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
  std::optional<PartsDescription> parts_;
  std::optional<EnvironmentPicture> environment_;
};

}  // namespace lightwell
