// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "lightwell/gltf/document.h"

namespace lightwell {

/// Turns a file of a format that Lightwell does not read itself into a glTF document by assimp: FBX, Collada (DAE), 3MF
/// and others, which assimp tells by content and by the name's ending. There in a build with LIGHTWELL_ASSIMP only:
/// assimp is not made for hostile files, and what it takes of memory is not bounded by the file.
Result<Document> assimp_document(Bytes file, const std::filesystem::path& path, Report& report);

}  // namespace lightwell
