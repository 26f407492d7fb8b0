// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "lightwell/base/bytes.h"

namespace lightwell {

/// What a viewer is handed, in the order in which it has to be applied: by a client the opening, what decoders hand
/// over of their assets, and the end. Bytes are views into the client or the decoder, good until its next call. `asset`
/// is numbered as asset_of_stream() says (asset/asset.h).

/// The opening: a GLB for a glTF loader. Comes once, first.
struct OpeningUpdate {
  Bytes glb;
};

/// One attribute of a mesh's vertices, an array of its own.
struct AttributeLayout {
  enum class Semantic : uint8_t { position, normal, texcoord_0, texcoord_1, color };
  enum class Component : uint8_t { i8, u8, i16, u16, f32 };

  Semantic semantic = Semantic::position;
  Component component = Component::f32;
  uint8_t components = 3;   ///< numbers a vertex, without padding
  bool normalized = false;  ///< as in glTF
  uint8_t stride = 12;      ///< bytes from a vertex to the next: a multiple of 4
};

/// A mesh's buffers in their final sizes, to be allocated once; comes before any other update of the mesh.
struct MeshUpdate {
  uint32_t asset = 0;
  uint32_t vertices = 0;
  uint32_t faces = 0;  ///< three indices of 32 bits each
  std::vector<AttributeLayout> attributes;
};

/// New bytes of one of a mesh's buffers.
struct RangeUpdate {
  static constexpr uint32_t indices = 255;

  uint32_t asset = 0;
  uint32_t buffer = 0;  ///< index into MeshUpdate::attributes, or `indices`
  uint32_t offset = 0;  ///< bytes from the start of the buffer: a multiple of 4, as is the length
  Bytes data;
};

/// The mesh may be drawn with this many vertices and faces: comes behind the ranges that make it so.
struct DrawUpdate {
  uint32_t asset = 0;
  uint32_t vertices = 0;
  uint32_t faces = 0;
};

/// A light grid as a whole, as the half-float RGBA texture of light/atlas.h. Its eight corner nodes come with the
/// opening, mostly with the first block behind it: who calls a client's take() after each work() has that light before
/// anything else is decoded.
struct LightUpdate {
  uint32_t asset = 0;
  uint32_t width = 0;
  uint32_t height = 0;
  uint32_t depth = 0;
  uint32_t nodes = 0;  ///< received so far; the others are filled in
  Bytes atlas;
};

/// A complete image file.
struct TextureUpdate {
  uint32_t asset = 0;
  uint8_t format = 0;  ///< ImageFormat of texture/image_format.h
  uint32_t width = 0;
  uint32_t height = 0;
  Bytes file;
};

/// Everything has been received and handed over.
struct CompleteUpdate {};

/// The client can do no more. What was handed over stays good.
struct FailureUpdate {
  enum class Reason : uint8_t {
    unreadable,  ///< not a pack, another version, or damaged
    replaced,    ///< the file changed while it was read: a new client may start anew
    refused      ///< the server will not give the file
  };
  Reason reason = Reason::unreadable;
  std::string message;
};

using Update = std::variant<OpeningUpdate, MeshUpdate, RangeUpdate, DrawUpdate, LightUpdate, TextureUpdate,
                            CompleteUpdate, FailureUpdate>;

}  // namespace lightwell
