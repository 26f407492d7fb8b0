// SPDX-License-Identifier: Apache-2.0
#include <tinyexr.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string_view>

#include "lightwell/render/float_picture.h"
#include "lightwell/texture/image_file.h"

namespace lightwell {
namespace {

using Memory = std::unique_ptr<void, decltype(&std::free)>;

// The error of a tinyexr call; frees the message.
tl::unexpected<Error> exr_failure(const char* message) {
  std::string reason = message ? message : "not readable";
  FreeEXRErrorMessage(message);
  while (!reason.empty() && (reason.back() == '\n' || reason.back() == '.')) reason.pop_back();
  return fail("EXR", reason);
}

// tinyexr's header, freed also after a failure.
struct Header : EXRHeader {
  Header() { InitEXRHeader(this); }
  ~Header() { FreeEXRHeader(this); }
  Header(const Header&) = delete;
  Header& operator=(const Header&) = delete;

  // The index of the channel with this name, or of the only one.
  std::optional<size_t> channel(std::string_view wanted) const {
    for (int c = 0; c < num_channels; c++) {
      if (num_channels == 1 || channels[c].name == wanted) return static_cast<size_t>(c);
    }
    return std::nullopt;
  }
};

// Reads the header and checks the size before memory for pixels is allocated.
Result<void> read_header(Bytes file, Header& header) {
  EXRVersion version;
  if (ParseEXRVersionFromMemory(&version, file.data(), file.size()) != TINYEXR_SUCCESS)
    return fail("EXR", "broken header");
  if (version.multipart || version.non_image || version.tiled)
    return fail(ErrorKind::unsupported, "EXR", "is tiled, deep or has several parts");
  const char* message = nullptr;
  if (ParseEXRHeaderFromMemory(&header, &version, file.data(), file.size(), &message) != TINYEXR_SUCCESS) {
    return exr_failure(message);
  }
  const int64_t width = int64_t(header.data_window.max_x) - header.data_window.min_x + 1;
  const int64_t height = int64_t(header.data_window.max_y) - header.data_window.min_y + 1;
  return check_image_size(static_cast<uint64_t>(std::max<int64_t>(width, 0)),
                          static_cast<uint64_t>(std::max<int64_t>(height, 0)));
}

int rows_of_block(int compression) {
  switch (compression) {
    case TINYEXR_COMPRESSIONTYPE_PIZ: return 32;
    case TINYEXR_COMPRESSIONTYPE_ZIP:
    case TINYEXR_COMPRESSIONTYPE_ZFP: return 16;
    default: return 1;
  }
}

// Checks that every block lies within the file, since tinyexr leaks memory when one does not. A block is its first row,
// its length and that many bytes; the table of block offsets follows the header.
Result<void> check_blocks(Bytes file, const Header& header) {
  ByteReader table(file);
  table.take(size_t(8) + header.header_len);
  const int rows = rows_of_block(header.compression_type);
  for (int64_t y = header.data_window.min_y; y <= header.data_window.max_y; y += rows) {
    const uint64_t place = table.u64();
    if (!table.ok() || place > file.size()) return fail("EXR", "ends too early");
    ByteReader block(file.subspan(place));
    block.u32();
    block.take(block.u32());
    if (!block.ok()) return fail("EXR", "ends too early");
  }
  return {};
}

}  // namespace

bool is_exr(Bytes file) {
  constexpr std::array<uint8_t, 4> magic{0x76, 0x2f, 0x31, 0x01};
  return file.size() >= magic.size() && std::equal(magic.begin(), magic.end(), file.begin());
}

Result<std::vector<uint8_t>> write_exr(const Picture& picture) {
  // OpenEXR orders channels by name.
  std::array<std::vector<float>, 3> planes;
  for (size_t i = 0; i < picture.pixels.size(); i++) planes[2 - i % 3].push_back(picture.pixels[i]);
  std::array<float*, 3> plane_pointers{planes[0].data(), planes[1].data(), planes[2].data()};
  std::array<EXRChannelInfo, 3> channels{};
  for (size_t c = 0; c < 3; c++) channels[c].name[0] = "BGR"[c];
  std::array<int, 3> types{TINYEXR_PIXELTYPE_FLOAT, TINYEXR_PIXELTYPE_FLOAT, TINYEXR_PIXELTYPE_FLOAT};

  EXRHeader header;
  InitEXRHeader(&header);
  header.num_channels = 3;
  header.channels = channels.data();
  header.pixel_types = types.data();
  header.requested_pixel_types = types.data();
  header.compression_type = TINYEXR_COMPRESSIONTYPE_ZIP;
  EXRImage image;
  InitEXRImage(&image);
  image.num_channels = 3;
  image.width = picture.width;
  image.height = picture.height;
  image.images = reinterpret_cast<unsigned char**>(plane_pointers.data());

  unsigned char* memory = nullptr;
  const char* message = nullptr;
  const size_t size = SaveEXRImageToMemory(&image, &header, &memory, &message);
  if (size == 0) return exr_failure(message);
  const Memory owner(memory, &std::free);
  return std::vector<uint8_t>(memory, memory + size);
}

Result<Picture> read_exr(Bytes file) {
  Header header;
  LW_CHECK(read_header(file, header));
  LW_CHECK(check_blocks(file, header));
  const std::array<std::optional<size_t>, 3> rgb{header.channel("R"), header.channel("G"), header.channel("B")};
  if (!rgb[0] || !rgb[1] || !rgb[2]) return fail("EXR", "has no channels R, G and B");
  std::fill_n(header.requested_pixel_types, header.num_channels, TINYEXR_PIXELTYPE_FLOAT);

  EXRImage pixels;
  InitEXRImage(&pixels);
  const char* message = nullptr;
  if (LoadEXRImageFromMemory(&pixels, &header, file.data(), file.size(), &message) != TINYEXR_SUCCESS)
    return exr_failure(message);
  // A failed load has already freed it.
  const std::unique_ptr<EXRImage, decltype(&FreeEXRImage)> owner(&pixels, &FreeEXRImage);
  Picture picture{pixels.width, pixels.height, {}};
  const size_t count = static_cast<size_t>(pixels.width) * static_cast<size_t>(pixels.height);
  picture.pixels.reserve(3 * count);
  for (size_t i = 0; i < count; i++) {
    for (const auto& plane : rgb) picture.pixels.push_back(reinterpret_cast<const float*>(pixels.images[*plane])[i]);
  }
  return picture;
}

}  // namespace lightwell
