// SPDX-License-Identifier: Apache-2.0
#include "lightwell/client/refiner.h"
#include "lightwell/texture/stream.h"

namespace lightwell {
namespace {

class TextureRefiner final : public Refiner {
 public:
  TextureRefiner(uint32_t stream, const TextureParameters& parameters) : stream_(stream), decoder_(parameters) {}

  Result<void> append(Bytes payload) override { return decoder_.append(payload); }

  bool complete() const override { return decoder_.complete(); }

  std::optional<Update> take(size_t) override {
    if (taken_ || !decoder_.complete()) return std::nullopt;
    taken_ = true;
    const TextureParameters& image = decoder_.parameters();
    return TextureUpdate{stream_, static_cast<uint8_t>(image.format), image.width, image.height, decoder_.file()};
  }

 private:
  uint32_t stream_;
  TextureDecoder decoder_;
  bool taken_ = false;
};

}  // namespace

Result<std::unique_ptr<Refiner>> make_texture_refiner(const StreamEntry& entry, uint32_t stream, uint64_t& budget) {
  LW_TRY(parameters, decode_texture_parameters(entry.parameters));
  if (parameters.bytes > entry.length) return fail("texture parameters", "promise more bytes than the stream has");
  LW_CHECK(spend(budget, parameters.bytes));
  return std::make_unique<TextureRefiner>(stream, parameters);
}

}  // namespace lightwell
