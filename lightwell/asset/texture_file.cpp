// SPDX-License-Identifier: Apache-2.0
//
// The texture codec texture_codec_file: an image file cut into blocks (texture/stream.h).
#include "lightwell/asset/codecs.h"
#include "lightwell/asset/texture_asset.h"
#include "lightwell/texture/image_size.h"

namespace lightwell {
namespace {

class TextureFile final : public TextureAsset {
 public:
  TextureFile(uint32_t asset, const TextureParameters& parameters) : TextureAsset(asset), decoder_(parameters) {}

  Result<void> append(Bytes payload) override {
    LW_CHECK(decoder_.append(payload));
    return decoder_.complete() ? check_image() : Result<void>();
  }
  const TextureParameters& parameters() const override { return decoder_.parameters(); }
  const std::vector<uint8_t>& file() const override { return decoder_.file(); }

 private:
  /// A page has made room for an image of the size that was promised.
  Result<void> check_image() const {
    const TextureParameters& promised = decoder_.parameters();
    const auto size = image_size(decoder_.file());
    if (image_format(decoder_.file()) == promised.format && size == ImageSize{promised.width, promised.height})
      return {};
    return fail("image", "is not of the size and format that its stream states");
  }

  TextureDecoder decoder_;
};

}  // namespace

Result<std::unique_ptr<AssetDecoder>> open_texture_file(const AssetSource& source) {
  LW_TRY(parameters, decode_texture_parameters(source.entry.parameters));
  if (parameters.bytes > source.entry.length)
    return fail("texture parameters", "promise more bytes than the stream has");
  LW_CHECK(source.context.spend(parameters.bytes));
  return std::make_unique<TextureFile>(source.asset, parameters);
}

}  // namespace lightwell
