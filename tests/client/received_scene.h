// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "lightwell/asset/update.h"
#include "lightwell/base/bytes.h"
#include "lightwell/mesh/stream.h"

namespace lightwell {

/// What a viewer may see on the way to a pack's scene.
struct OnTheWay {
  struct Level {
    uint32_t vertices = 0;
    std::vector<uint32_t> indices;  ///< three a face
  };
  std::map<uint32_t, std::vector<Level>> levels;      ///< of each mesh, coarse to fine: after any number of blocks
  std::map<uint32_t, std::vector<Normal16>> normals;  ///< of each vertex of a mesh until its own has come
  std::vector<std::vector<uint8_t>> atlases;          ///< after any number of blocks, filled in any way
};

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
  ErrorKind kind{};

  /// Applies an update. Gives a complaint when it breaks what update.h promises: order, sizes, faces that may be drawn.
  std::string apply(const Update& update);

  /// True when all that is shown so far belongs to the scene `whole`: its opening, the beginnings of its vertices, the
  /// faces of one of its levels, perhaps some of them those of a later level already, its textures and its atlases.
  bool shows_only(const ReceivedScene& whole, const OnTheWay& on_the_way) const;

  bool operator==(const ReceivedScene&) const = default;
};

/// The whole scene of a pack, decoded block by block without a client.
ReceivedScene decode_directly(Bytes pack);

/// All that a viewer may see of a pack before the whole.
OnTheWay on_the_way(Bytes pack);

}  // namespace lightwell
