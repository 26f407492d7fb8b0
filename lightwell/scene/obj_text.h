// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "lightwell/base/bytes.h"
#include "lightwell/base/result.h"
#include "lightwell/base/vector.h"

namespace lightwell {

/// True when the first statement of a text is an OBJ statement.
bool is_obj(Bytes bytes);

/// The text of an OBJ file in a form that tinyobjloader reads correctly. That library takes words that are not numbers
/// for zeros, counts a face's corners in eight bits, ends names at spaces, knows no continued lines, and lets a short
/// line reserve much memory. So every line is checked here first, and an error names the line; statements that
/// Lightwell does not use are left out (points, lines and curves with a warning), continued lines are joined, and
/// spaces in names become underscores, and slashes behind which no index stands ("1//") go. Lines keep their numbers.
Result<std::string> checked_obj_text(Bytes file, Report& report);

/// Counts the positions of a checked text from an origin amid them (scene/place.h), before the library makes them
/// floats. Returns that origin; the text stays as it is where it is zero.
Vec3d move_to_origin(std::string& checked);

/// The text of an MTL file with spaces in the materials' names replaced in the same way, keywords in the case in which
/// the library knows them, and backslashes in the names of textures turned.
std::string checked_mtl_text(Bytes file);

}  // namespace lightwell
