// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "lightwell/base/bytes.h"
#include "lightwell/base/result.h"
#include "lightwell/mesh/mesh.h"

namespace draco {
class Mesh;
}

namespace lightwell {

/// Decodes a Draco stream, whose counts are held against its bytes first (gltf/draco_counts.h). `name` is used in
/// errors.
Result<std::shared_ptr<const draco::Mesh>> decode_draco(Bytes stream, const std::string& name);

/// A bare Draco file: its positions, normals, first texture coordinates (v downwards as in glTF) and colours (linear).
Result<Mesh> read_draco_file(Bytes file);

}  // namespace lightwell
