// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "lightwell/gltf/document.h"

namespace lightwell {

/// The triangles of a PLY file that show one texture.
struct PlyPart {
  Mesh mesh;
  int texture = -1;  ///< index into PlyContent::textures; -1: none
};

struct PlyContent {
  std::vector<PlyPart> parts;
  Vec3d origin{};                     ///< what the positions are counted from (scene/place.h)
  std::vector<std::string> textures;  ///< the names of the files, as the header has them
};

/// True when bytes begin like a PLY file.
bool is_ply(Bytes bytes);

/// Reads the triangles of a PLY file: ascii or binary of either byte order, elements and properties in any order and of
/// any type. Faces of more than three corners are cut into triangles; tristrips count as faces. Of the vertices
/// positions, normals, colours (sRGB, made linear) and texture coordinates are read, of the faces the list "texcoord"
/// and the number "texnumber" of one of the textures that lines "comment TextureFile NAME" give; everything else is
/// skipped. Vertices that no face uses are dropped; smooth normals replace missing ones. Errors name the header, vertex
/// or face at fault.
Result<PlyContent> read_ply(Bytes file, Report& report);

/// A PLY file as a glTF document of one object; `stem` is the file's name without its ending, `folder` holds its
/// textures. Materials are Lambertian: of the texture's colours, grey of reflectance 0.8, or white under the vertices'
/// colours. They are double-sided, since scans have holes and many do not say reliably which side is out.
Result<Document> ply_document(Bytes file, const std::filesystem::path& folder, const std::string& stem, Report& report);

}  // namespace lightwell
