// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstdint>

namespace lightwell {

/// The name of a source of light as a person would count them: a lamp of the scene, a connected piece of emissive
/// surface, or the environment. A pack stores it: the same luminaire has the same id in the scene that was baked, and
/// in the pack's own scene at whatever level its meshes are, once `vertex` counts in the pack's order (docs/format.md).
struct LuminaireId {
  enum class Kind : uint8_t { lamp, surface, environment };

  Kind kind = Kind::environment;
  int node = -1;        ///< of the scene's document
  int copy = 0;         ///< of a surface: which of the instances that its node places (EXT_mesh_gpu_instancing)
  int primitive = -1;   ///< of a surface: of the node's mesh
  uint32_t vertex = 0;  ///< of a surface: the least vertex of the piece in the primitive's arrays

  auto operator<=>(const LuminaireId&) const = default;
};

}  // namespace lightwell
