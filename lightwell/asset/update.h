// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "lightwell/base/bytes.h"
#include "lightwell/base/result.h"

namespace lightwell {

/// The updates for a viewer, which must be applied in order: the opening (from the client), updates of assets (from
/// their decoders), and the end. Bytes are views into the client or the decoder, valid until its next call. `asset` is
/// the number from asset_of_stream() (asset/asset.h).

/// The opening: a GLB for a glTF loader. Comes once, first.
struct OpeningUpdate {
  Bytes glb;
};

/// An attribute of a mesh's vertices, in an array of its own.
struct AttributeLayout {
  enum class Semantic : uint8_t { position, normal, texcoord_0, texcoord_1, color };
  enum class Component : uint8_t { i8, u8, i16, u16, f32 };

  Semantic semantic = Semantic::position;
  Component component = Component::f32;
  uint8_t components = 3;   ///< numbers per vertex, without padding
  bool normalized = false;  ///< as in glTF
  uint8_t stride = 12;      ///< bytes from one vertex to the next: a multiple of 4
};

/// The final sizes of a mesh's buffers, which thus need to be allocated only once. Precedes all other updates of the
/// mesh.
struct MeshUpdate {
  uint32_t asset = 0;
  uint32_t vertices = 0;
  uint32_t faces = 0;  ///< three indices of 32 bits each; a region's follow one another, as many as there will be
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

/// The number of vertices and faces that may be drawn from now on. Follows the ranges that provide them.
struct DrawUpdate {
  uint32_t asset = 0;
  uint32_t vertices = 0;
  uint32_t faces = 0;                 ///< of all regions
  std::span<const uint32_t> regions;  ///< the faces of each, of which there is one at least
};

/// A whole light grid as the half-float RGBA texture of light/atlas.h. The first update follows the opening with the
/// eight corner nodes and, usually, the first block: a driver that calls Client::take() after each work() gets it
/// before anything else is decoded.
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

/// What the file said of the parts that meshes were merged from, complete: a gzip file of JSON (docs/format.md).
struct PartsUpdate {
  uint32_t asset = 0;
  uint32_t inflated = 0;  ///< bytes of the JSON
  Bytes file;
};

/// Everything has been received and taken.
struct CompleteUpdate {};

/// The client has given up. Earlier updates stay valid.
struct FailureUpdate {
  enum class Reason : uint8_t {
    unreadable,  ///< not a pack, another version, or damaged
    replaced,    ///< the file changed while it was read; a new client may start over
    refused      ///< the server refuses to send the file
  };
  Reason reason = Reason::unreadable;
  ErrorKind kind = ErrorKind::bad_input;
  std::string message;

  /// The failure of a file that cannot be read because of `error`.
  static FailureUpdate unreadable(const Error& error) { return {Reason::unreadable, error.kind, error.message()}; }
};

using Update = std::variant<OpeningUpdate, MeshUpdate, RangeUpdate, DrawUpdate, LightUpdate, TextureUpdate,
                            CompleteUpdate, FailureUpdate, PartsUpdate>;

}  // namespace lightwell
