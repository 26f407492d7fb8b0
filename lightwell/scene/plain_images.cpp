// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/plain_images.h"

#include <optional>

#include "lightwell/scene/import_gltf_material.h"
#include "lightwell/texture/image_file.h"
#include "lightwell/texture/orientation.h"

namespace lightwell {
namespace {

/// The file in its plain form; none when it is plain already, or cannot be read.
std::optional<std::vector<uint8_t>> plain_form(std::vector<uint8_t> file, ImageLimit limit) {
  if (!image_format(file)) {
    const auto image = read_image_file(file, limit);
    return image ? std::optional(write_png(*image)) : std::nullopt;
  }
  return make_upright(file) ? std::optional(std::move(file)) : std::nullopt;
}

}  // namespace

void make_images_plain(Document& document, ImageLimit limit) {
  DocumentBuilder builder(document);
  const std::vector<bool> read = read_by_textures(document.json);
  for (size_t i = 0; i < read.size(); i++) {
    if (!read[i]) continue;
    auto file = read_image(document, static_cast<int>(i));
    const auto plain = file ? plain_form(std::move(*file), limit) : std::nullopt;
    if (!plain) continue;
    const int view = builder.buffer_view(*plain);
    Json& image = document.json["images"][i];
    image.erase("uri");
    image["mimeType"] = mime_type(image_format(*plain).value());
    image["bufferView"] = view;
  }
}

}  // namespace lightwell
