// SPDX-License-Identifier: Apache-2.0
#include "lightwell/client/refiner.h"
#include "lightwell/light/atlas.h"
#include "lightwell/light/stream.h"

namespace lightwell {
namespace {

class LightRefiner final : public Refiner {
 public:
  LightRefiner(uint32_t stream, Fill fill, LightDecoder decoder)
      : stream_(stream),
        fill_(fill),
        decoder_(std::move(decoder)),
        atlas_(decoder_.layout().shape, decoder_.layout().normal_offset, decoder_.layout().scale) {}

  Result<void> append(Bytes payload) override { return decoder_.append(payload); }

  /// True unless an eighth more nodes are there than the last time, or all: so the cost of filling is spread over the
  /// stream, however small its blocks are.
  bool settled() const override {
    const size_t received = decoder_.received();
    return received == settled_ || (received < settled_ + settled_ / 8 && !decoder_.complete());
  }

  /// Fills the holes and writes the atlas.
  bool settle() override {
    if (settled()) return false;
    LightGrid filled = decoder_.grid();
    push_pull(filled, decoder_.known(), fill_);
    atlas_.update(filled);
    settled_ = decoder_.received();
    return true;
  }

  std::optional<Update> take(size_t) override {
    if (taken_ == settled_) return std::nullopt;
    taken_ = settled_;
    const auto size = [](int n) { return static_cast<uint32_t>(n); };
    const Bytes bytes(reinterpret_cast<const uint8_t*>(atlas_.halves.data()), atlas_.halves.size() * sizeof(uint16_t));
    return LightUpdate{
        stream_, size(atlas_.width()), size(atlas_.height()), size(atlas_.depth()), static_cast<uint32_t>(settled_),
        bytes};
  }

  bool complete() const override { return decoder_.complete(); }
  uint64_t decoded() const override { return decoder_.received(); }
  uint64_t total() const override { return decoder_.layout().shape.count(); }

 private:
  uint32_t stream_;
  Fill fill_;
  LightDecoder decoder_;
  LightAtlas atlas_;
  size_t settled_ = 0;  ///< nodes in the atlas
  size_t taken_ = 0;    ///< nodes in the atlas that was handed over
};

}  // namespace

Result<std::unique_ptr<Refiner>> make_light_refiner(const StreamEntry& entry, uint32_t stream, Fill fill,
                                                    uint64_t& budget) {
  // The decoder's and the atlas's 250 bytes a node, and as much again while holes are filled.
  constexpr uint64_t bytes_a_node = 500;
  LW_TRY(layout, LightLayout::read(entry.parameters));
  LW_CHECK(spend(budget, layout.shape.count() * bytes_a_node));
  LW_TRY(decoder, LightDecoder::open(entry.parameters, entry.length));
  return std::make_unique<LightRefiner>(stream, fill, std::move(decoder));
}

}  // namespace lightwell
