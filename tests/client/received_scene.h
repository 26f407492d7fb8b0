// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "lightwell/base/bytes.h"
#include "lightwell/client/update.h"

namespace lightwell {

/// What a viewer would hold: the buffers that updates make up.
struct ReceivedScene {
  struct ReceivedMesh {
    std::vector<std::vector<uint8_t>> buffers;  ///< one an attribute, the indices last
    std::vector<uint32_t> strides;
    uint32_t vertices = 0;
    uint32_t faces = 0;

    bool operator==(const ReceivedMesh&) const = default;
  };
  std::vector<uint8_t> opening;
  std::map<uint32_t, ReceivedMesh> meshes;
  std::map<uint32_t, std::vector<uint8_t>> atlases;
  std::map<uint32_t, std::vector<uint8_t>> textures;
  bool complete = false;
  std::string failure;
  FailureUpdate::Reason reason{};

  /// Applies an update. Gives a complaint when it breaks what update.h promises: order, sizes, faces that may be drawn.
  std::string apply(const Update& update);

  /// True when all that is shown so far belongs to the scene `whole`: its opening, the beginnings of its vertices, its
  /// textures, and atlases out of `atlases`.
  bool shows_only(const ReceivedScene& whole, const std::vector<std::vector<uint8_t>>& atlases) const;

  bool operator==(const ReceivedScene&) const = default;
};

/// The whole scene of a pack, decoded block by block without a client.
ReceivedScene decode_directly(Bytes pack);

/// Every atlas that a viewer may see on the way: after any number of blocks of a light stream, filled in any way.
std::vector<std::vector<uint8_t>> atlases_on_the_way(Bytes pack);

}  // namespace lightwell
