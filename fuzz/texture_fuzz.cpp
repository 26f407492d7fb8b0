// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>

#include "lightwell/texture/image_file.h"
#include "lightwell/texture/orientation.h"
#include "lightwell/texture/radiance_hdr.h"

using namespace lightwell;

namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

size_t area(int width, int height) { return static_cast<size_t>(width) * static_cast<size_t>(height); }

}  // namespace

/// Image files and Radiance pictures: any bytes give as many pixels as they announce, or an error.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const Bytes bytes(data, size);
  if (const auto image = read_image_file(bytes)) {
    require(image->pixels.size() == area(image->width, image->height) * static_cast<size_t>(image->channels));
    if (area(image->width, image->height) < size_t(1) << 20) require(!write_preview(*image, 16, true).empty());
  }
  std::vector<uint8_t> upright(bytes.begin(), bytes.end());
  make_upright(upright);
  if (const auto picture = read_radiance_hdr(bytes))
    require(picture->pixels.size() == area(picture->width, picture->height) * 3);
  return 0;
}
