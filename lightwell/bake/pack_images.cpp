// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/pack_images.h"

#include <algorithm>

#include "lightwell/gltf/extensions.h"
#include "lightwell/texture/image_file.h"

namespace lightwell {
namespace {

constexpr size_t preview_budget = 8192;      // bytes, of all previews together
constexpr size_t stream_worth_bytes = 1024;  // a file that is this close to its preview goes into the opening

// The longest side of a preview: half a byte a pixel is what small PNG and JPEG files take.
int preview_side(size_t images) {
  int side = 128;
  while (side > 8 && images * static_cast<size_t>(side * side) / 2 > preview_budget) side /= 2;
  return side;
}

// Marks the images that hold colours (sRGB); the others hold numbers.
std::vector<bool> color_images(const Scene& scene) {
  std::vector<bool> color(scene.images.size(), false);
  for (const Material& material : scene.materials)
    for (const TextureLookup* lookup : {&material.base_color_texture, &material.emission_texture})
      if (lookup->image >= 0) color[static_cast<size_t>(lookup->image)] = true;
  return color;
}

// An extension may name a texture's image in another format; previews are PNG or JPEG, so `source` names them all.
void use_plain_sources(Document& document) {
  for (Json& texture : document.json["textures"]) {
    for (const char* name : {"EXT_texture_webp", "EXT_texture_avif", "KHR_texture_basisu"}) {
      const int source = index_of(extension(texture, name), "source");
      if (source < 0) continue;
      texture["source"] = source;
      texture["extensions"].erase(name);
      if (texture["extensions"].empty()) texture.erase("extensions");
    }
  }
  for (const char* name : {"EXT_texture_webp", "EXT_texture_avif", "KHR_texture_basisu"})
    forget_extension(document.json, name);
}

}  // namespace

std::vector<StreamedImage> shrink_images(const Scene& scene, Document& document) {
  std::vector<StreamedImage> streamed;
  if (!document.json.contains("images")) return streamed;
  if (document.json.contains("textures")) use_plain_sources(document);
  const std::vector<bool> color = color_images(scene);
  const int side = preview_side(scene.images.size());
  for (size_t i = 0; i < scene.images.size(); i++) {
    const Image& image = scene.images[i];
    auto file = read_image(scene.document, static_cast<int>(i));
    const std::optional<ImageFormat> format = file ? image_format(*file) : std::nullopt;
    std::vector<uint8_t> preview = write_preview(image, side, color[i]);
    if (format && *format != ImageFormat::webp && file->size() <= preview.size() + stream_worth_bytes)
      preview = std::move(*file);
    else if (format)
      streamed.push_back({static_cast<int>(i),
                          {static_cast<uint32_t>(file->size()), *format, static_cast<uint32_t>(image.width),
                           static_cast<uint32_t>(image.height)},
                          std::move(*file)});
    Json& json = document.json["images"][i];
    json.erase("uri");
    json["mimeType"] = mime_type(image_format(preview).value_or(ImageFormat::png));
    json["bufferView"] = DocumentBuilder(document).buffer_view(preview);
  }
  return streamed;
}

}  // namespace lightwell
