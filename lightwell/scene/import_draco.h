// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/gltf/document.h"

namespace lightwell {

/// True when bytes begin like a bare Draco file.
bool is_draco(Bytes file);

/// A bare Draco mesh (.drc) as a glTF document of one object, with the material that a PLY file gets. Missing normals
/// become smooth ones.
Result<Document> draco_document(Bytes file);

}  // namespace lightwell
