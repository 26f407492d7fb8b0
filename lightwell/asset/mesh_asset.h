// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "lightwell/asset/asset.h"
#include "lightwell/mesh/base_places.h"
#include "lightwell/mesh/stream.h"
#include "lightwell/pack/directory.h"

namespace lightwell {

/// The buffers of a mesh as far as they are decoded: the first `vertices`, and faces in all regions. Absent attributes
/// are empty.
struct MeshBuffers {
  uint32_t vertices = 0;
  uint32_t faces = 0;
  std::span<const Vec3f> positions;
  std::span<const Normal16> normals;
  std::array<std::span<const Vec2f>, 2> texcoords;
  std::span<const Color16> colors;
  bool complete = false;  ///< everything has come, normals too
};

/// A mesh of any codec: returns updates for what has been decoded. Derived classes decode the blocks.
class MeshAsset : public AssetDecoder {
 public:
  static constexpr StreamKind kind = StreamKind::mesh;

  virtual const MeshLayout& layout() const = 0;
  /// Where the arrays of the coarsest level lie in the opening.
  const BasePlaces& places() const { return places_; }
  virtual MeshBuffers buffers() const = 0;
  /// Of the faces of a region that may be drawn, three each.
  virtual std::span<const uint32_t> indices(size_t region) const = 0;
  /// As MeshDecoder::index_buffer().
  virtual std::span<const uint32_t> index_buffer() const = 0;

  bool accepts() const final { return !batch_; }
  Result<void> append(Bytes payload) final;
  uint64_t added() const final { return buffers().vertices; }
  bool complete() const final;
  std::optional<Update> announce() final;
  /// Returns all changes since the last batch, in pieces. Their order keeps the mesh drawable at every moment: new
  /// vertices, final normals, new faces, older faces that may refer to the new vertices, and the draw counts last.
  std::optional<Update> take(size_t budget) final;
  uint64_t decoded() const final { return buffers().faces; }
  uint64_t total() const final { return layout().faces; }

 protected:
  MeshAsset(uint32_t asset, const MeshLayout& layout, const BasePlaces& places);

  virtual Result<void> decode(Bytes payload) = 0;
  /// The changes in the buffers since the last call.
  virtual MeshChanges take_changes() = 0;

 private:
  void start_batch();
  void enqueue(uint32_t buffer, Bytes bytes, uint32_t stride, BufferRange range);
  RangeUpdate next_range(size_t budget);

  uint32_t asset_;
  BasePlaces places_;
  std::vector<AttributeLayout> attributes_;
  std::vector<uint32_t> region_faces_;  ///< that may be drawn after the batch
  bool changed_ = true;
  bool batch_ = false;               ///< a batch is being taken
  std::vector<RangeUpdate> ranges_;  ///< of the batch, before its draw count; the next one is last
};

}  // namespace lightwell
