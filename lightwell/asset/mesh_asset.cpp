// SPDX-License-Identifier: Apache-2.0
#include "lightwell/asset/mesh_asset.h"

#include <algorithm>

namespace lightwell {
namespace {

using Semantic = AttributeLayout::Semantic;

template <typename T>
Bytes bytes_of(std::span<const T> elements) {
  return {reinterpret_cast<const uint8_t*>(elements.data()), elements.size_bytes()};
}

Bytes bytes_of(const MeshBuffers& buffers, Semantic semantic) {
  switch (semantic) {
    case Semantic::position: return bytes_of(buffers.positions);
    case Semantic::normal: return bytes_of(buffers.normals);
    case Semantic::texcoord_0: return bytes_of(buffers.texcoords[0]);
    case Semantic::texcoord_1: return bytes_of(buffers.texcoords[1]);
    case Semantic::color: return bytes_of(buffers.colors);
  }
  return {};
}

}  // namespace

MeshAsset::MeshAsset(uint32_t asset, const MeshLayout& layout, const BasePlaces& places)
    : asset_(asset), places_(places) {
  using Component = AttributeLayout::Component;
  attributes_.push_back({Semantic::position, Component::f32, 3, false, 12});
  if (layout.has_normals) attributes_.push_back({Semantic::normal, Component::i16, 3, true, 8});
  if (layout.has_texcoords[0]) attributes_.push_back({Semantic::texcoord_0, Component::f32, 2, false, 8});
  if (layout.has_texcoords[1]) attributes_.push_back({Semantic::texcoord_1, Component::f32, 2, false, 8});
  if (layout.has_colors) attributes_.push_back({Semantic::color, Component::u16, 4, true, 8});
}

Result<void> MeshAsset::append(Bytes payload) {
  changed_ = true;
  return decode(payload);
}

bool MeshAsset::complete() const { return buffers().complete; }

std::optional<Update> MeshAsset::announce() {
  return MeshUpdate{asset_, layout().vertices, layout().faces, attributes_};
}

std::optional<Update> MeshAsset::take(size_t budget) {
  if (changed_ && !batch_) start_batch();
  if (!batch_) return std::nullopt;
  if (!ranges_.empty()) return next_range(budget);
  batch_ = false;
  const MeshBuffers now = buffers();
  return DrawUpdate{asset_, now.vertices, now.faces, region_faces_};
}

void MeshAsset::start_batch() {
  const MeshChanges changes = take_changes();
  const MeshBuffers now = buffers();
  for (uint32_t i = 0; i < attributes_.size(); i++) {
    const auto& [semantic, component, components, normalized, stride] = attributes_[i];
    enqueue(i, bytes_of(now, semantic), stride, changes.vertices);
    if (semantic == Semantic::normal) enqueue(i, bytes_of(now, semantic), stride, changes.normals);
  }
  region_faces_.clear();
  for (size_t i = 0; i < layout().region_count(); i++)
    region_faces_.push_back(static_cast<uint32_t>(indices(i).size() / 3));
  for (const auto* ranges : {&changes.indices, &changes.rewired})
    for (const BufferRange& range : *ranges) enqueue(RangeUpdate::indices, bytes_of(index_buffer()), 4, range);
  std::ranges::reverse(ranges_);
  changed_ = false;
  batch_ = true;
}

/// Adds a range of elements of `stride` bytes to the batch; `buffer` is numbered as in RangeUpdate. The layout's limits
/// keep offsets below 4 GiB.
void MeshAsset::enqueue(uint32_t buffer, Bytes bytes, uint32_t stride, BufferRange range) {
  if (range.count == 0) return;
  const uint32_t offset = range.first * stride;
  ranges_.push_back(RangeUpdate{asset_, buffer, offset, bytes.subspan(offset, size_t(range.count) * stride)});
}

/// The next range, or as much of it as `budget` allows.
RangeUpdate MeshAsset::next_range(size_t budget) {
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

}  // namespace lightwell
