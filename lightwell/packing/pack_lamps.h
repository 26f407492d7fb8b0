// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "lightwell/packing/pack_meshes.h"
#include "lightwell/scene/client_lamp.h"

namespace lightwell {

/// The lamps with the luminaire ids that are valid in the pack. Streamed meshes renumber their vertices, so the vertex
/// of a piece of surface becomes the first one of the coarsest level that coincides, on the lattice, with a corner of
/// the piece. The lamp of a piece too small for the lattice names no surface: the pack has none.
std::vector<ClientLamp> lamps_of_pack(std::span<const ClientLamp> lamps, const Scene& scene,
                                      std::span<const StreamedMesh> streamed);

}  // namespace lightwell
