// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/pack_images.h"

#include <algorithm>
#include <array>
#include <iterator>

#include "lightwell/gltf/extensions.h"
#include "lightwell/scene/import_gltf_material.h"
#include "lightwell/texture/image_file.h"
#include "lightwell/texture/mip.h"

namespace lightwell {
namespace {

constexpr size_t preview_budget = 8192;      // bytes, of all previews together
constexpr size_t stream_worth_bytes = 1024;  // a file that exceeds its preview by no more goes into the opening

constexpr size_t levels_worth_bytes = 65536;  // what is larger comes in levels, too
constexpr int step_of_levels = 4;             // of their sides
constexpr size_t share_of_level = 4;          // a level takes this part of the next one's bytes at most
constexpr int least_side_of_level = 128;      // pixels: smaller ones are no better than previews
constexpr int level_quality = 80;             // of WebP

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
  std::vector<StreamedImage> streamed;
};

// The levels of an image whose file is streamed, coarse to fine.
std::vector<StreamedImage> levels_of(const Image& image, const StreamedImage& whole, bool color) {
  std::vector<StreamedImage> levels;
  if (whole.file.size() <= levels_worth_bytes) return levels;
  size_t next = whole.file.size();
  for (int side = std::max(image.width, image.height) / step_of_levels; side >= least_side_of_level;
       side /= step_of_levels) {
    const Image mip = smallest_mip(image, side, color);
    std::vector<uint8_t> file = write_webp(mip, level_quality);
    if (file.empty() || file.size() > next / share_of_level) continue;
    next = file.size();
    const TextureParameters parameters{static_cast<uint32_t>(next), ImageFormat::webp, static_cast<uint32_t>(mip.width),
                                       static_cast<uint32_t>(mip.height)};
    levels.insert(levels.begin(), {whole.image, true, parameters, std::move(file)});
  }
  return levels;
}

Shrunk shrink(const Scene& scene, const Document& document, int index, bool color, int side, bool has_levels) {
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
  const TextureParameters parameters{static_cast<uint32_t>(file->size()), *format, static_cast<uint32_t>(image.width),
                                     static_cast<uint32_t>(image.height)};
  StreamedImage whole{index, false, parameters, std::move(*file)};
  if (has_levels) shrunk.streamed = levels_of(image, whole, color);
  shrunk.streamed.push_back(std::move(whole));
  return shrunk;
}

}  // namespace

std::vector<StreamedImage> shrink_images(const Scene& scene, Document& document, int surroundings) {
  std::vector<StreamedImage> streamed;
  if (!document.json.contains("images")) return streamed;
  if (document.json.contains("textures")) use_plain_sources(document);
  const std::vector<bool> color = color_images(scene);
  const std::vector<bool> used = used_images(document);
  const int side = preview_side(static_cast<size_t>(std::count(used.begin(), used.end(), true)));
  for (size_t i = 0; i < scene.images.size(); i++) {
    if (!used[i]) continue;
    Shrunk shrunk = shrink(scene, document, static_cast<int>(i), color[i], side, static_cast<int>(i) != surroundings);
    std::ranges::move(shrunk.streamed, std::back_inserter(streamed));
    const int view = DocumentBuilder(document).buffer_view(shrunk.opening);
    Json& json = document.json["images"][i];
    json.erase("uri");
    json["mimeType"] = mime_type(shrunk.format);
    json["bufferView"] = view;
  }
  return streamed;
}

}  // namespace lightwell
