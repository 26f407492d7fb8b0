// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "lightwell/base/bytes.h"
#include "lightwell/base/result.h"
#include "lightwell/mesh/mesh.h"
#include "lightwell/mesh/vertex_codes.h"

namespace lightwell {

struct ProgressiveMesh;

/// The codec number of this header's format: the vertex splits of a progressive mesh (H. Hoppe, "Progressive Meshes",
/// SIGGRAPH 1996, sections 3.1 and 3.3), ordered by the points that they split, after a coarsest level; then the
/// normals. Codec 0, of older packs, had these with the splits.
inline constexpr uint8_t mesh_codec_splits = 1;
/// The same of a mesh of several regions.
inline constexpr uint8_t mesh_codec_regions = 2;

/// The most vertices and faces that a byte of a payload may add. It bounds a decoder's memory, 88 bytes a vertex and 24
/// a face, by the bytes that have arrived. Encoders pad shorter payloads; a flat grid of squares has 2.5, scans have
/// 0.5.
inline constexpr uint32_t elements_per_byte = 4;

/// A part of a mesh's faces that is drawn by itself, since it has a material of its own. Regions share vertices and
/// splits, so that at every level they meet where they meet in the final one.
struct RegionLayout {
  uint32_t faces = 0;       ///< of the final level
  uint32_t base_faces = 0;  ///< of the coarsest level
  uint8_t shift = 0;        ///< its positions are multiples of 2^shift steps of the lattice

  bool operator==(const RegionLayout&) const = default;
};

/// What a client must know about a mesh stream before its first block: the start of the stream's parameters in
/// docs/format.md.
struct MeshLayout {
  static constexpr size_t most_regions = 1024;
  static constexpr uint8_t most_shift = 20;
  /// How much coarser at most the lattice of a vertex is than that of one of its regions.
  static constexpr uint8_t most_shift_between = 4;

  uint32_t vertices = 0, faces = 0;            ///< of the final level
  uint32_t base_vertices = 0, base_faces = 0;  ///< of the coarsest level
  uint32_t loose_faces = 0;                    ///< the last of `faces`: degenerate, or repeated in their region
  bool has_normals = false, has_colors = false;
  std::array<bool, 2> has_texcoords{};
  Lattice positions;
  std::array<Lattice, 2> texcoords;
  float base_error = 0;  ///< distance of the coarsest level from the final one, in the mesh's units; an estimate
  std::vector<RegionLayout> regions;  ///< two or more, of all faces; empty: there is one

  size_t region_count() const { return regions.empty() ? 1 : regions.size(); }
  /// The size of MeshDecoder's buffers at the final level, bytes; of several regions with what it takes at once.
  uint64_t buffer_bytes() const;
  /// Fails when a count or a lattice is impossible. No buffer may reach 4 GiB.
  Result<void> check() const;
  /// Without the regions, which stand behind all else (MeshParameters).
  void write(ByteWriter& writer) const;
  /// Reads what write() wrote and checks it. Fails when it is too short, has an unknown flag or does not pass check().
  Result<void> read(ByteReader& reader);
  void write_regions(ByteWriter& writer) const;
  /// Reads what write_regions() wrote, to the end of the bytes, and checks it.
  Result<void> read_regions(ByteReader& reader);
};

/// A block of the stream. It can be decoded once all blocks before it have been.
struct MeshBlock {
  std::vector<uint8_t> payload;
  uint32_t vertices = 0;  ///< that it adds
  float error = 0;        ///< that remains after it, as MeshLayout::base_error; 0 when the mesh is complete
};

struct EncodedMesh {
  MeshLayout layout;
  Mesh base;  ///< the coarsest level; stored as floats, with 16-bit colours, it gives the decoder exactly its codes
  std::vector<MeshBlock> blocks;
};

/// Encodes a progressive mesh as layout, base and blocks of about `block_vertices` new vertices, then of so many
/// normals.
EncodedMesh encode(const ProgressiveMesh& mesh, uint32_t block_vertices = 1024);

using Normal16 = std::array<int16_t, 4>;

/// The arrays of a coarsest level as they come from glTF accessors. Absent attributes are empty.
struct MeshArrays {
  std::span<const Vec3f> positions, normals;
  std::array<std::span<const Vec2f>, 2> texcoords;
  std::span<const Color16> colors;
  std::span<const uint32_t> indices;  ///< three a face, region by region
};

/// A run of elements of a buffer.
struct BufferRange {
  uint32_t first = 0, count = 0;

  bool operator==(const BufferRange&) const = default;
};

/// What has changed in a decoder's buffers.
struct MeshChanges {
  BufferRange vertices;              ///< new ones
  BufferRange normals;               ///< of vertices, older ones too, that now are those of the final level
  std::vector<BufferRange> indices;  ///< those of new faces, of each region
  std::vector<BufferRange> rewired;  ///< those of older faces; ascending, gaps of up to 256 indices included
};

/// Decodes a mesh stream: refines a mesh block by block in buffers that are ready for the GPU. The buffers grow with
/// the bytes that arrive, so that a false layout costs nothing; but of several regions the indices take 24 bytes for
/// each face that a layout promises, which its stream's length and a client's budget (asset/codecs.h) bound. After
/// every block the faces refer to decoded vertices, so that each level can be drawn.
class MeshDecoder {
 public:
  /// Begins with the coarsest level. `stream_bytes` is the sum of all blocks' payloads, or more: a layout that promises
  /// more than these bytes can hold is an error, as is a base that does not fit the layout.
  static Result<MeshDecoder> open(MeshLayout layout, const MeshArrays& base, uint64_t stream_bytes);

  MeshDecoder(MeshDecoder&&) noexcept;
  MeshDecoder& operator=(MeshDecoder&&) noexcept;
  ~MeshDecoder();

  /// Decodes the next block. After an error the mesh stays as the last intact split left it, drawable, and further
  /// blocks are refused.
  Result<void> append(Bytes payload);

  const MeshLayout& layout() const;
  uint32_t vertices() const;  ///< decoded so far
  uint32_t faces() const;     ///< of all regions
  bool complete() const;      ///< the final level is reached, normals and all

  /// The buffers: vertices() elements, and three indices for each face of a region. append() may move them.
  std::span<const Vec3f> positions() const;
  /// Signed normalised x, y, z and 0; empty without normals. Those of the faces that a vertex came with until its own
  /// have come, after all faces.
  std::span<const Normal16> normals() const;
  std::span<const Vec2f> texcoords(int set) const;
  std::span<const Color16> colors() const;
  std::span<const uint32_t> indices(size_t region = 0) const;
  /// Of all regions, each with room for the faces that it will have, as far as there are any: MeshChanges is in places
  /// of this.
  std::span<const uint32_t> index_buffer() const;

  /// The changes since the last call; the first call includes the coarsest level.
  MeshChanges take_changes();

 private:
  struct State;
  explicit MeshDecoder(std::unique_ptr<State> state);

  std::unique_ptr<State> state_;
};

}  // namespace lightwell
