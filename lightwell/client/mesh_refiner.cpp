// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <span>

#include "lightwell/client/refiner.h"
#include "lightwell/mesh/base_places.h"
#include "lightwell/mesh/stream.h"

namespace lightwell {
namespace {

template <typename T>
Bytes bytes_of(std::span<const T> elements) {
  return {reinterpret_cast<const uint8_t*>(elements.data()), elements.size_bytes()};
}

class MeshRefiner final : public Refiner {
 public:
  MeshRefiner(uint32_t stream, MeshDecoder decoder) : stream_(stream), decoder_(std::move(decoder)) {
    using Component = AttributeLayout::Component;
    const MeshLayout& layout = decoder_.layout();
    attributes_.push_back({Semantic::position, Component::f32, 3, false, 12});
    if (layout.has_normals) attributes_.push_back({Semantic::normal, Component::i16, 3, true, 8});
    if (layout.has_texcoords[0]) attributes_.push_back({Semantic::texcoord_0, Component::f32, 2, false, 8});
    if (layout.has_texcoords[1]) attributes_.push_back({Semantic::texcoord_1, Component::f32, 2, false, 8});
    if (layout.has_colors) attributes_.push_back({Semantic::color, Component::u16, 4, true, 8});
  }

  bool accepts() const override { return !batch_; }

  Result<void> append(Bytes payload) override {
    changed_ = true;
    return decoder_.append(payload);
  }

  std::optional<Update> announce() override {
    return MeshUpdate{stream_, decoder_.layout().vertices, decoder_.layout().faces, attributes_};
  }

  /// A batch of all changes since the last one. Its order keeps every moment drawable: the new vertices, the new faces,
  /// then old faces that may refer to the new vertices, and the draw count last.
  std::optional<Update> take(size_t budget) override {
    if (changed_ && !batch_) start_batch();
    if (!batch_) return std::nullopt;
    if (!ranges_.empty()) return next_range(budget);
    batch_ = false;
    return DrawUpdate{stream_, decoder_.vertices(), decoder_.faces()};
  }

  bool complete() const override { return decoder_.complete(); }
  uint64_t decoded() const override { return decoder_.faces(); }
  uint64_t total() const override { return decoder_.layout().faces; }

 private:
  using Semantic = AttributeLayout::Semantic;

  Bytes bytes_of_attribute(Semantic semantic) const {
    switch (semantic) {
      case Semantic::position: return bytes_of(decoder_.positions());
      case Semantic::normal: return bytes_of(decoder_.normals());
      case Semantic::texcoord_0: return bytes_of(decoder_.texcoords(0));
      case Semantic::texcoord_1: return bytes_of(decoder_.texcoords(1));
      case Semantic::color: return bytes_of(decoder_.colors());
    }
    return {};
  }

  void start_batch() {
    const MeshChanges changes = decoder_.take_changes();
    for (uint32_t i = 0; i < attributes_.size(); i++)
      enqueue(i, bytes_of_attribute(attributes_[i].semantic), attributes_[i].stride, changes.vertices);
    const Bytes indices = bytes_of(decoder_.indices());
    enqueue(RangeUpdate::indices, indices, 4, changes.indices);
    for (const BufferRange& range : changes.rewired) enqueue(RangeUpdate::indices, indices, 4, range);
    std::ranges::reverse(ranges_);
    changed_ = false;
    batch_ = true;
  }

  /// Some elements of `stride` bytes of a buffer, numbered as in RangeUpdate. The layout's limits keep offsets below
  /// 4 GiB.
  void enqueue(uint32_t buffer, Bytes bytes, uint32_t stride, BufferRange range) {
    if (range.count == 0) return;
    const uint32_t offset = range.first * stride;
    ranges_.push_back(RangeUpdate{stream_, buffer, offset, bytes.subspan(offset, size_t(range.count) * stride)});
  }

  /// The next of the ranges, or as much of it as fits.
  RangeUpdate next_range(size_t budget) {
    RangeUpdate& range = ranges_.back();
    const size_t length = std::max<size_t>(budget / 4 * 4, 4);
    RangeUpdate update = range;
    if (range.data.size() > length) {
      update.data = range.data.first(length);
      range.data = range.data.subspan(length);
      range.offset += static_cast<uint32_t>(length);
    } else {
      ranges_.pop_back();
    }
    return update;
  }

  uint32_t stream_;
  MeshDecoder decoder_;
  std::vector<AttributeLayout> attributes_;
  bool changed_ = true;
  bool batch_ = false;               ///< a hand-over is under way
  std::vector<RangeUpdate> ranges_;  ///< what is left of it before the draw count, the next one last
};

}  // namespace

Result<std::unique_ptr<Refiner>> make_mesh_refiner(const StreamEntry& entry, uint32_t stream, Bytes bin,
                                                   uint64_t& budget) {
  ByteReader reader(entry.parameters);
  LW_TRY(layout, MeshLayout::read(reader));
  LW_TRY(places, BasePlaces::read(reader));
  if (reader.remaining() != 0) return fail("mesh parameters", "are too long");
  LW_CHECK(spend(budget, layout.buffer_bytes()));
  LW_TRY(base, BaseArrays::read(layout, places, bin));
  LW_TRY(decoder, MeshDecoder::open(layout, base.view(), entry.length));
  return std::make_unique<MeshRefiner>(stream, std::move(decoder));
}

}  // namespace lightwell
