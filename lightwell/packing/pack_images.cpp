// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/pack_images.h"

#include <algorithm>
#include <array>
#include <optional>

#include "lightwell/gltf/extensions.h"
#include "lightwell/scene/import_gltf_material.h"
#include "lightwell/texture/image_file.h"

namespace lightwell {
namespace {

constexpr size_t preview_budget = 8192;      // bytes, of all previews together
constexpr size_t stream_worth_bytes = 1024;  // a file that exceeds its preview by no more goes into the opening

// Extensions that give a texture's image in a format outside core glTF.
constexpr std::array other_formats = {"EXT_texture_webp", "EXT_texture_avif", "KHR_texture_basisu"};

// The longest side of a preview in pixels, assuming half a byte a pixel, as small PNG and JPEG files take.
int preview_side(size_t images) {
  int side = 128;
  while (side > 8 && images * static_cast<size_t>(side * side) / 2 > preview_budget) side /= 2;
  return side;
}

// Marks the images that hold sRGB colours; the others hold linear data.
std::vector<bool> color_images(const Scene& scene) {
  std::vector<bool> color(scene.images.size(), false);
  for (const Material& material : scene.materials)
    for (const TextureLookup* lookup : {&material.base_color_texture, &material.emission_texture})
      if (lookup->image >= 0) color[static_cast<size_t>(lookup->image)] = true;
  return color;
}

// Makes `source` name the image that was read and drops the extensions that name one in another format, since previews
// are PNG or JPEG.
void use_plain_sources(Document& document) {
  for (Json& texture : document.json["textures"]) {
    const int source = image_of(texture);
    if (source >= 0) texture["source"] = source;
    if (!texture.contains("extensions")) continue;
    for (const char* name : other_formats) texture["extensions"].erase(name);
    if (texture["extensions"].empty()) texture.erase("extensions");
  }
  for (const char* name : other_formats) forget_extension(document.json, name);
}

// Marks the images that textures refer to.
std::vector<bool> used_images(const Document& document) {
  std::vector<bool> used(member(document.json, "images").size(), false);
  for (const Json& texture : member(document.json, "textures"))
    if (const auto source = static_cast<size_t>(index_of(texture, "source")); source < used.size()) used[source] = true;
  return used;
}

// The two parts of an image: the file in the opening, and the file to stream, if that is worthwhile.
struct Shrunk {
  std::vector<uint8_t> opening;
  ImageFormat format = ImageFormat::png;
  std::optional<StreamedImage> streamed;
};

Shrunk shrink(const Scene& scene, const Document& document, int index, bool color, int side) {
  const Image& image = scene.images[static_cast<size_t>(index)];
  Shrunk shrunk{write_preview(image, side, color), ImageFormat::png, {}};
  shrunk.format = image_format(shrunk.opening).value_or(ImageFormat::png);
  auto file = read_image(document, index);
  const auto format = file ? image_format(*file) : std::nullopt;
  if (!format) return shrunk;
  if (*format != ImageFormat::webp && file->size() <= shrunk.opening.size() + stream_worth_bytes) {
    shrunk.opening = std::move(*file);
    shrunk.format = *format;
    return shrunk;
  }
  StreamedImage& streamed = shrunk.streamed.emplace();
  streamed.image = index;
  streamed.parameters = {static_cast<uint32_t>(file->size()), *format, static_cast<uint32_t>(image.width),
                         static_cast<uint32_t>(image.height)};
  streamed.file = std::move(*file);
  return shrunk;
}

}  // namespace

std::vector<StreamedImage> shrink_images(const Scene& scene, Document& document) {
  std::vector<StreamedImage> streamed;
  if (!document.json.contains("images")) return streamed;
  if (document.json.contains("textures")) use_plain_sources(document);
  const std::vector<bool> color = color_images(scene);
  const std::vector<bool> used = used_images(document);
  const int side = preview_side(static_cast<size_t>(std::count(used.begin(), used.end(), true)));
  for (size_t i = 0; i < scene.images.size(); i++) {
    if (!used[i]) continue;
    Shrunk shrunk = shrink(scene, document, static_cast<int>(i), color[i], side);
    if (shrunk.streamed) streamed.push_back(std::move(*shrunk.streamed));
    const int view = DocumentBuilder(document).buffer_view(shrunk.opening);
    Json& json = document.json["images"][i];
    json.erase("uri");
    json["mimeType"] = mime_type(shrunk.format);
    json["bufferView"] = view;
  }
  return streamed;
}

}  // namespace lightwell
