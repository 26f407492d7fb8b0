// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "lightwell/gltf/document.h"
#include "lightwell/packing/parts_file.h"

namespace lightwell {

/// Takes a document's merged mesh apart: the nodes and meshes of the file come back, with their names and extras, and
/// each part's faces, at whatever level the document has them, in its own node's space. A part without faces at that
/// level loses its mesh. `final_level` gives the finest level of a primitive of the merged mesh; `origin` is that of
/// the pack (PackIdentity). Fails where the file does not fit the document.
Result<void> restore_parts(Document& document, const PartsDescription& description, PartsFile file,
                           const std::function<Result<Mesh>(size_t primitive)>& final_level, const Vec3d& origin);

}  // namespace lightwell
