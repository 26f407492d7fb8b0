// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <vector>

#include "lightwell/asset/update.h"
#include "lightwell/gltf/document.h"

namespace lightwell {

/// The scene that a client has delivered so far, as a viewer would hold it: the opening's glTF and each mesh's buffers.
class ReceivedScene {
 public:
  /// Applies an update.
  void apply(const Update& update);
  /// The scene at the level it has reached, as a GLB. Fails before the opening has arrived.
  Result<std::vector<uint8_t>> glb() const;

 private:
  struct Buffers {
    std::vector<AttributeLayout> attributes;
    std::vector<std::vector<uint8_t>> data;  ///< one for each attribute
    std::vector<uint8_t> indices;
    uint32_t vertices = 0;        ///< to be drawn
    std::vector<uint32_t> faces;  ///< of each region, to be drawn
  };

  /// One for each region, given how many faces each will have.
  static std::vector<Mesh> meshes_of(const Buffers& buffers, const std::map<uint32_t, uint32_t>& region_faces);
  void take(const MeshUpdate& update);
  void take(const RangeUpdate& update);

  std::vector<uint8_t> opening_;
  std::map<uint32_t, Buffers> meshes_;  ///< by asset
  std::map<uint32_t, std::vector<uint8_t>> images_;
  std::vector<uint8_t> parts_;  ///< their file, which comes last
  uint32_t parts_inflated_ = 0;
};

}  // namespace lightwell
