// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "lightwell/base/bytes.h"
#include "lightwell/base/result.h"
#include "lightwell/texture/image_format.h"

namespace lightwell {

/// The codec number of this header's format: an image file as it is.
inline constexpr uint8_t texture_codec_file = 0;

/// A texture stream carries an image file as it is, cut into blocks of this many bytes; the last may be shorter.
constexpr size_t texture_block_bytes = 32768;

/// The parameters of a texture stream (docs/format.md): what file its blocks make up.
struct TextureParameters {
  uint32_t bytes = 0;  ///< of the whole file
  ImageFormat format = ImageFormat::png;
  uint32_t width = 0;  ///< pixels
  uint32_t height = 0;

  bool operator==(const TextureParameters&) const = default;
};

std::vector<uint8_t> encode_texture_parameters(const TextureParameters& parameters);

/// The blocks of an image file, as views into it, in the order of the stream.
std::vector<Bytes> texture_blocks(Bytes file);

/// Fails for an unknown format, an empty file or image, and wrong lengths.
Result<TextureParameters> decode_texture_parameters(Bytes bytes);

/// Puts an image file together from the blocks of its stream. Memory grows with what has arrived.
class TextureDecoder {
 public:
  explicit TextureDecoder(const TextureParameters& parameters) : parameters_(parameters) {}

  /// Adds the stream's next block. Fails, and stays as it was, when the block has not the length that is due.
  Result<void> append(Bytes block);
  /// True when every block has been added.
  bool complete() const { return file_.size() == parameters_.bytes; }
  /// What has arrived: when complete, the image file.
  const std::vector<uint8_t>& file() const { return file_; }
  const TextureParameters& parameters() const { return parameters_; }

 private:
  TextureParameters parameters_;
  std::vector<uint8_t> file_;
};

}  // namespace lightwell
