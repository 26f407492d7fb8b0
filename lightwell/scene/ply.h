// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/gltf/document.h"

namespace lightwell {

/// True when bytes begin like a PLY file.
bool is_ply(Bytes bytes);

/// Reads the triangles of a PLY file: ascii or binary of either byte order, elements and properties in any order and of
/// any type. Faces of more than three corners are cut into triangles; tristrips count as faces. Of the vertices
/// positions, normals, colours (sRGB, made linear) and texture coordinates are read, everything else is skipped.
/// Vertices that no face uses are dropped; smooth normals replace missing ones. Errors name the header, vertex or face
/// at fault.
Result<Mesh> read_ply(Bytes file, Report& report);

/// A PLY file as a glTF document of one object. Its material is Lambertian: grey of reflectance 0.8, or white under the
/// vertices' colours. It is double-sided, since scans have holes and many do not say reliably which side is out.
Result<Document> ply_document(Bytes file, Report& report);

}  // namespace lightwell
