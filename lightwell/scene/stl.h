// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/gltf/document.h"

namespace lightwell {

/// True when bytes are an STL file: a binary one says how many facets of 50 bytes follow its header, a text begins with
/// "solid".
bool is_stl(Bytes file);

/// An STL file as a glTF document of one object: its triangles, binary or ascii, with the facets' colours where a
/// binary file has them (VisCAM's and Magics' forms). Edges sharper than 40 degrees stay, the rest is smooth, since the
/// format knows no normals at corners. Errors name the facet or the line.
Result<Document> stl_document(Bytes file, Report& report);

}  // namespace lightwell
