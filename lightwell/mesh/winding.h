// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "lightwell/mesh/mesh.h"

namespace lightwell {

/// For each face 1 if it is wound against the greater part, by area, of the surface to which it belongs, else 0. Faces
/// belong together across edges that two of them share, by the positions of its ends; wound alike, they run along it in
/// opposite directions. A surface that cannot be wound alike everywhere, as a Moebius strip, has none.
std::vector<uint8_t> wound_against_the_rest(const Mesh& mesh);

/// Turns the faces that are marked with 1, and the normals of their vertices that then point to the backs of the faces
/// round them. A vertex that other faces share keeps its own.
void turn_faces(Mesh& mesh, const std::vector<uint8_t>& marked);

/// Turns the few faces that are wound against the normals of all their corners, as programs leave them in scans;
/// returns how many. Where they are more than a few it changes nothing: the normals are meant otherwise, or all of them
/// are wrong.
size_t turn_faces_against_normals(Mesh& mesh);

/// Turns all normals when nearly all of them point to the backs of the faces round their vertices; else it changes
/// nothing, since some do so on purpose, as those of leaves that are shaded as a crown. True when it did.
bool turn_opposed_normals(Mesh& mesh);

}  // namespace lightwell
