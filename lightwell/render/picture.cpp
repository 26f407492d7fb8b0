// SPDX-License-Identifier: Apache-2.0
#include "lightwell/render/picture.h"

#include <algorithm>
#include <cmath>

#include "lightwell/base/file.h"
#include "lightwell/render/float_picture.h"
#include "lightwell/texture/image_file.h"
#include "lightwell/texture/transfer.h"

namespace lightwell {

namespace {

// Of the neutral tone curve: where it begins to compress, and how quickly what is brighter turns to white.
constexpr float compression_begins = 0.8f - 0.04f, room = 1 - compression_begins;
constexpr float desaturation = 0.15f;

float share_of_white(float peak, float new_peak) { return 1 - 1 / (desaturation * (peak - new_peak) + 1); }

/// The inverse of neutral_tone.
Vec3f before_neutral_tone(Vec3f colour) {
  constexpr float brightest = 0.998f;  // white itself is shown by endless light only
  if (const float new_peak = std::min(max_component(colour), brightest); new_peak > compression_begins) {
    const float peak = room * room / (1 - new_peak) - room + compression_begins;
    const float white = share_of_white(peak, new_peak);
    for (float& channel : colour.e)
      channel = std::max(0.0f, (std::min(channel, new_peak) - new_peak * white) / (1 - white)) * (peak / new_peak);
  }
  const float least = *std::min_element(colour.e.begin(), colour.e.end());
  return colour + Vec3f::filled((least < 0.04f ? std::sqrt(least / 6.25f) : least + 0.04f) - least);
}

}  // namespace

Vec3f neutral_tone(Vec3f colour) {
  const float least = *std::min_element(colour.e.begin(), colour.e.end());
  colour -= Vec3f::filled(least < 0.08f ? least - 6.25f * least * least : 0.04f);
  const float peak = max_component(colour);
  if (peak < compression_begins) return colour;

  const float new_peak = 1 - room * room / (peak + room - compression_begins);
  colour *= new_peak / peak;
  return colour + (Vec3f::filled(new_peak) - colour) * share_of_white(peak, new_peak);
}

Vec3f Display::operator()(const Vec3f& radiance) const {
  Vec3f colour = radiance * std::exp2(exposure);
  if (tone == ToneCurve::neutral) colour = neutral_tone(colour);
  for (float& channel : colour.e) channel = channel > 0 ? std::min(channel, 1.0f) : 0.0f;
  return colour;
}

Vec3f Display::radiance_of(Vec3f colour) const {
  for (float& channel : colour.e) channel = channel > 0 ? std::min(channel, 1.0f) : 0.0f;
  if (tone == ToneCurve::neutral) colour = before_neutral_tone(colour);
  return colour * std::exp2(-exposure);
}

Image displayed(const Picture& picture, const Display& display) {
  Image image{picture.width, picture.height, 3, {}};
  image.pixels.reserve(picture.pixels.size());
  for (size_t i = 0; i + 2 < picture.pixels.size(); i += 3) {
    const Vec3f shown = display({{picture.pixels[i], picture.pixels[i + 1], picture.pixels[i + 2]}});
    for (const float channel : shown.e) image.pixels.push_back(to_byte(linear_to_srgb(channel)));
  }
  return image;
}

Result<void> write_picture(const std::filesystem::path& path, const Picture& picture, const Display& display) {
  const std::string ending = path.extension().string();
  if (ending.empty() || ending == ".png") return write_file(path, write_png(displayed(picture, display)));
  if (ending == ".pfm") return write_file(path, write_pfm(picture));
  if (ending != ".exr") return fail(in_file({"", "picture", "the name must end in .png, .exr or .pfm"}, path.string()));
  auto file = write_exr(picture);
  if (!file) return fail(in_file(file.error(), path.string()));
  return write_file(path, *file);
}

namespace {

Result<Picture> read_image(Bytes file) {
  LW_TRY(image, read_image_file(file));
  Picture picture{image.width, image.height, {}};
  const auto channels = static_cast<size_t>(image.channels);
  for (size_t pixel = 0; pixel < image.pixels.size(); pixel += channels) {
    for (size_t c = 0; c < 3; c++) {
      picture.pixels.push_back(srgb_to_linear(image.pixels[pixel + (channels < 3 ? 0 : c)]));
    }
  }
  return picture;
}

}  // namespace

Result<Picture> read_picture(Bytes file) {
  if (is_exr(file)) return read_exr(file);
  if (is_pfm(file)) return read_pfm(file);
  if (!image_format(file))
    return fail(ErrorKind::unsupported, "", "is no picture: neither PNG, JPEG, WebP, OpenEXR nor PFM");
  return read_image(file);
}

Result<Picture> read_picture(const std::filesystem::path& path) {
  LW_TRY(file, read_file(path));
  auto picture = read_picture(file);
  if (!picture) return fail(in_file(picture.error(), path.string()));
  return picture;
}

}  // namespace lightwell
