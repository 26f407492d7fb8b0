// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/upright_images.h"

#include "lightwell/texture/image_format.h"
#include "lightwell/texture/orientation.h"

namespace lightwell {

void make_images_upright(Document& document) {
  DocumentBuilder builder(document);
  for (size_t i = 0; i < member(document.json, "images").size(); i++) {
    auto file = read_image(document, static_cast<int>(i));
    if (!file || !make_upright(*file)) continue;
    const int view = builder.buffer_view(*file);
    Json& image = document.json["images"][i];
    image.erase("uri");
    image["mimeType"] = mime_type(image_format(*file).value());
    image["bufferView"] = view;
  }
}

}  // namespace lightwell
