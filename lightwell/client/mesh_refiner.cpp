// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <deque>
#include <span>

#include "lightwell/client/refiner.h"
#include "lightwell/mesh/base_places.h"
#include "lightwell/mesh/stream.h"

namespace lightwell {
namespace {

/// One of a mesh's buffers, in its final size.
struct Buffer {
  uint32_t number = 0;  ///< as in RangeUpdate
  Bytes bytes;
  uint32_t stride = 4;  ///< bytes an element
};

template <typename T>
Bytes bytes_of(std::span<const T> elements) {
  return {reinterpret_cast<const uint8_t*>(elements.data()), elements.size_bytes()};
}

class MeshRefiner final : public Refiner {
 public:
  MeshRefiner(uint32_t stream, MeshDecoder decoder) : stream_(stream), decoder_(std::move(decoder)) {
    using Semantic = AttributeLayout::Semantic;
    using Component = AttributeLayout::Component;
    add_attribute(decoder_.positions(), {Semantic::position, Component::f32, 3, false, 12});
    add_attribute(decoder_.normals(), {Semantic::normal, Component::i16, 3, true, 8});
    add_attribute(decoder_.texcoords(0), {Semantic::texcoord_0, Component::f32, 2, false, 8});
    add_attribute(decoder_.texcoords(1), {Semantic::texcoord_1, Component::f32, 2, false, 8});
    add_attribute(decoder_.colors(), {Semantic::color, Component::u8, 4, true, 4});
    indices_ = {RangeUpdate::indices, bytes_of(decoder_.indices()), 4};
  }

  bool accepts() const override { return !batch_; }

  Result<void> append(Bytes payload) override {
    changed_ = true;
    return decoder_.append(payload);
  }

  /// A batch of all changes since the last one. Its order keeps every moment drawable: the new vertices, the new faces,
  /// then old faces that may refer to the new vertices, and the draw count last.
  std::optional<Update> take(size_t budget) override {
    if (!announced_) {
      announced_ = true;
      return MeshUpdate{stream_, decoder_.layout().vertices, decoder_.layout().faces, attributes_};
    }
    if (changed_ && !batch_) start_batch();
    if (!batch_) return std::nullopt;
    if (!ranges_.empty()) return next_range(budget);
    batch_ = false;
    return DrawUpdate{stream_, decoder_.vertices(), decoder_.faces()};
  }

  uint64_t decoded() const override { return decoder_.faces(); }
  uint64_t total() const override { return decoder_.layout().faces; }

 private:
  template <typename T>
  void add_attribute(std::span<const T> elements, AttributeLayout layout) {
    if (elements.empty()) return;
    buffers_.push_back({static_cast<uint32_t>(attributes_.size()), bytes_of(elements), layout.stride});
    attributes_.push_back(layout);
  }

  void start_batch() {
    const MeshChanges changes = decoder_.take_changes();
    for (const Buffer& buffer : buffers_) enqueue(buffer, changes.vertices);
    enqueue(indices_, changes.indices);
    for (const BufferRange& range : changes.rewired) enqueue(indices_, range);
    changed_ = false;
    batch_ = true;
  }

  void enqueue(const Buffer& buffer, BufferRange range) {
    if (range.count == 0) return;
    const uint32_t offset = range.first * buffer.stride;
    ranges_.push_back(
        RangeUpdate{stream_, buffer.number, offset, buffer.bytes.subspan(offset, size_t(range.count) * buffer.stride)});
  }

  /// The first of the ranges, or as much of it as fits.
  RangeUpdate next_range(size_t budget) {
    RangeUpdate& range = ranges_.front();
    const size_t length = std::max<size_t>(budget / 4 * 4, 4);
    RangeUpdate update = range;
    if (range.data.size() > length) {
      update.data = range.data.first(length);
      range.data = range.data.subspan(length);
      range.offset += static_cast<uint32_t>(length);
    } else {
      ranges_.pop_front();
    }
    return update;
  }

  uint32_t stream_;
  MeshDecoder decoder_;
  std::vector<AttributeLayout> attributes_;
  std::vector<Buffer> buffers_;
  Buffer indices_;
  bool announced_ = false;
  bool changed_ = true;
  bool batch_ = false;              ///< a hand-over is under way
  std::deque<RangeUpdate> ranges_;  ///< what is left of it before the draw count
};

}  // namespace

Result<std::unique_ptr<Refiner>> make_mesh_refiner(const StreamEntry& entry, uint32_t stream, Bytes bin) {
  ByteReader reader(entry.parameters);
  LW_TRY(layout, MeshLayout::read(reader));
  LW_TRY(places, BasePlaces::read(reader));
  if (reader.remaining() != 0) return fail("mesh parameters", "are too long");
  LW_TRY(base, BaseArrays::read(layout, places, bin));
  LW_TRY(decoder, MeshDecoder::open(layout, base.view(), entry.length));
  return std::make_unique<MeshRefiner>(stream, std::move(decoder));
}

}  // namespace lightwell
