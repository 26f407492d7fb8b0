// SPDX-License-Identifier: Apache-2.0
#include <tinyexr.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <memory>

#include "lightwell/render/float_picture.h"
#include "lightwell/texture/image_file.h"

namespace lightwell {
namespace {

using Memory = std::unique_ptr<void, decltype(&std::free)>;

// The error of a call of tinyexr, whose message is to be freed.
tl::unexpected<Error> exr_failure(const char* message) {
  std::string reason = message ? message : "not readable";
  FreeEXRErrorMessage(message);
  while (!reason.empty() && (reason.back() == '\n' || reason.back() == '.')) reason.pop_back();
  return fail("EXR", std::move(reason));
}

// The size in the header, so that it is checked before the pixels' memory is asked for.
Result<void> check_header(Bytes file) {
  EXRVersion version;
  if (ParseEXRVersionFromMemory(&version, file.data(), file.size()) != TINYEXR_SUCCESS)
    return fail("EXR", "broken header");
  if (version.multipart || version.non_image) return fail("EXR", "has several parts or is deep");
  EXRHeader header;
  InitEXRHeader(&header);
  const char* message = nullptr;
  if (ParseEXRHeaderFromMemory(&header, &version, file.data(), file.size(), &message) != TINYEXR_SUCCESS) {
    return exr_failure(message);
  }
  const int64_t width = int64_t(header.data_window.max_x) - header.data_window.min_x + 1;
  const int64_t height = int64_t(header.data_window.max_y) - header.data_window.min_y + 1;
  FreeEXRHeader(&header);
  return check_image_size(static_cast<uint64_t>(std::max<int64_t>(width, 0)),
                          static_cast<uint64_t>(std::max<int64_t>(height, 0)));
}

}  // namespace

bool is_exr(Bytes file) {
  constexpr std::array<uint8_t, 4> magic{0x76, 0x2f, 0x31, 0x01};
  return file.size() >= magic.size() && std::equal(magic.begin(), magic.end(), file.begin());
}

Result<std::vector<uint8_t>> write_exr(const Picture& picture) {
  // Channels stand in the order of their names.
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
  LW_CHECK(check_header(file));
  float* rgba = nullptr;
  int width = 0, height = 0;
  const char* message = nullptr;
  if (LoadEXRFromMemory(&rgba, &width, &height, file.data(), file.size(), &message) != TINYEXR_SUCCESS)
    return exr_failure(message);
  const Memory owner(rgba, &std::free);
  Picture picture{width, height, {}};
  const size_t pixels = static_cast<size_t>(width) * static_cast<size_t>(height);
  picture.pixels.reserve(3 * pixels);
  for (size_t i = 0; i < pixels; i++) picture.pixels.insert(picture.pixels.end(), rgba + 4 * i, rgba + 4 * i + 3);
  return picture;
}

}  // namespace lightwell
