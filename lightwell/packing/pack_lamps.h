// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "lightwell/packing/pack_meshes.h"
#include "lightwell/scene/client_lamp.h"

namespace lightwell {

/// The lamps with the ids that their luminaires have in the pack, whose streamed meshes number their vertices anew: the
/// least vertex of a piece of surface there is the first one that stands, on the lattice, where the piece has a corner.
std::vector<ClientLamp> lamps_of_pack(std::span<const ClientLamp> lamps, const Scene& scene,
                                      std::span<const StreamedMesh> streamed);

}  // namespace lightwell
