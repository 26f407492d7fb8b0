// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/texture_extension.h"

#include <optional>

#include "lightwell/packing/member_reader.h"

namespace lightwell {
namespace {

std::optional<ImageFormat> format_of(std::string_view type) {
  for (const ImageFormat format : {ImageFormat::png, ImageFormat::jpeg, ImageFormat::webp})
    if (mime_type(format) == type) return format;
  return std::nullopt;
}

Result<std::vector<TextureLevel>> read_levels(const Json& list, const std::string& name) {
  std::vector<TextureLevel> levels;
  for (size_t i = 0; i < list.size(); i++) {
    MemberReader reader(list[i], name + ".levels[" + std::to_string(i) + "]");
    LW_TRY(read, reader.finish(TextureLevel{reader.whole("stream"), reader.whole("width"), reader.whole("height")}));
    levels.push_back(read);
  }
  return levels;
}

Result<RefinedTexture> read_refined_texture(const Json& texture, const std::string& name) {
  const std::string own = name + "." + texture_extension;
  MemberReader reader(extension(texture, texture_extension), own);
  RefinedTexture refined;
  refined.stream = reader.whole("stream");
  refined.width = reader.whole("width");
  refined.height = reader.whole("height");
  const std::optional<ImageFormat> format = format_of(reader.string("mimeType"));
  if (!format) reader.refuse("mimeType", "is no image format of packs");
  refined.format = format.value_or(ImageFormat::png);
  if (reader.has("levels")) {
    LW_TRY(levels, read_levels(reader.array("levels"), own));
    refined.levels = std::move(levels);
  }
  LW_CHECK(reader.finish(true));
  MemberReader plain(texture, name);
  refined.source = plain.whole("source");
  return plain.finish(refined);
}

}  // namespace

Json to_json(const RefinedTexture& refined) {
  Json json = {{"stream", refined.stream},
               {"width", refined.width},
               {"height", refined.height},
               {"mimeType", mime_type(refined.format)}};
  for (const TextureLevel& level : refined.levels)
    json["levels"].push_back({{"stream", level.stream}, {"width", level.width}, {"height", level.height}});
  return json;
}

Result<std::vector<RefinedTexture>> read_refined_textures(const Json& json) {
  std::vector<RefinedTexture> found;
  const Json& textures = member(json, "textures");
  for (size_t i = 0; i < textures.size(); i++) {
    const Json& texture = element(textures, i);
    if (extension(texture, texture_extension).is_null()) continue;
    LW_TRY(refined, read_refined_texture(texture, element_name("textures", i)));
    refined.texture = i;
    found.push_back(refined);
  }
  return found;
}

}  // namespace lightwell
