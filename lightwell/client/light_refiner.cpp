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
        atlas_(decoder_.layout().shape, AtlasForm::patched, decoder_.layout().normal_offset, decoder_.layout().scale) {}

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

Result<std::unique_ptr<Refiner>> make_light_refiner(const StreamEntry& entry, uint32_t stream, Fill fill) {
  // The largest bundle that an encoder makes; a directory that promises more nodes than its blocks can bring is refused
  // before the decoder allocates them.
  constexpr uint64_t most_nodes_a_block = 4096;
  LW_TRY(layout, LightLayout::read(entry.parameters));
  if (layout.shape.count() > 8 + most_nodes_a_block * entry.blocks)
    return fail("light parameters", "promise more nodes than the stream has");
  LW_TRY(decoder, LightDecoder::open(entry.parameters));
  return std::make_unique<LightRefiner>(stream, fill, std::move(decoder));
}

}  // namespace lightwell
