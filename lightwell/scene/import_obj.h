// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "lightwell/gltf/document.h"
#include "lightwell/texture/image.h"

namespace lightwell {

/// An OBJ may have no more parts: a page would draw each by itself, and glTF describes each in kilobytes of JSON.
constexpr size_t most_obj_parts = size_t(1) << 18;

/// Turns an OBJ file into a glTF document: a node for each object or group, a primitive for each of its materials.
/// Materials come from MTL files below `folder`: Kd, map_Kd, Ke, map_Ke and d; they become Lambertian and double-sided,
/// since the winding of OBJ files is not reliable. Kd and Ke are taken as linear, vertex colours as sRGB. Faces are cut
/// into triangles; equal corners share a vertex; corners without a normal get the smooth one of their position. Points,
/// lines and curves are left out with a warning. Errors name the line, face or vertex at fault. Fails beyond
/// most_obj_parts.
Result<Document> obj_document(Bytes file, const std::filesystem::path& folder, Report& report, ImageLimit limit = {});

}  // namespace lightwell
