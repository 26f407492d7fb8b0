// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "lightwell/asset/asset.h"
#include "lightwell/mesh/stream.h"
#include "lightwell/pack/directory.h"

namespace lightwell {

/// The buffers of a mesh as far as they are decoded: `vertices` and `faces` of them may be drawn. Absent attributes are
/// empty.
struct MeshBuffers {
  uint32_t vertices = 0;
  uint32_t faces = 0;
  std::span<const Vec3f> positions;
  std::span<const Normal16> normals;
  std::array<std::span<const Vec2f>, 2> texcoords;
  std::span<const Color16> colors;
  std::span<const uint32_t> indices;  ///< three a face
};

/// A mesh, by whichever codec: hands over what the codec decodes. A codec derives from it and says how a block is
/// decoded.
class MeshAsset : public AssetDecoder {
 public:
  static constexpr StreamKind kind = StreamKind::mesh;

  const MeshLayout& layout() const { return layout_; }
  virtual MeshBuffers buffers() const = 0;

  bool accepts() const final { return !batch_; }
  Result<void> append(Bytes payload) final;
  uint64_t added() const final { return buffers().vertices; }
  bool complete() const final;
  std::optional<Update> announce() final;
  /// A batch of all changes since the last one, in pieces. Its order keeps every moment drawable: the new vertices, the
  /// new faces, then old faces that may refer to the new vertices, and the draw count last.
  std::optional<Update> take(size_t budget) final;
  uint64_t decoded() const final { return buffers().faces; }
  uint64_t total() const final { return layout_.faces; }

 protected:
  MeshAsset(uint32_t asset, const MeshLayout& layout);

  virtual Result<void> decode(Bytes payload) = 0;
  /// What has changed in the buffers since the last call.
  virtual MeshChanges take_changes() = 0;

 private:
  void start_batch();
  void enqueue(uint32_t buffer, Bytes bytes, uint32_t stride, BufferRange range);
  RangeUpdate next_range(size_t budget);

  uint32_t asset_;
  MeshLayout layout_;
  std::vector<AttributeLayout> attributes_;
  bool changed_ = true;
  bool batch_ = false;               ///< a hand-over is under way
  std::vector<RangeUpdate> ranges_;  ///< what is left of it before the draw count, the next one last
};

}  // namespace lightwell
