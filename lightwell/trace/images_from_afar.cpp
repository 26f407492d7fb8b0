// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/images_from_afar.h"

#include "lightwell/texture/transfer.h"

namespace lightwell {
namespace {

constexpr int texels_a_side = 4;
/// Images that are smaller stay as they are: they are in nobody's way.
constexpr int least_side = 64;

/// What the texels of an image stand for.
enum class Use : uint8_t { none, colours, numbers, both };

Use operator|(Use a, Use b) { return static_cast<Use>(static_cast<int>(a) | static_cast<int>(b)); }

std::vector<Use> uses_of(const Scene& scene) {
  std::vector<Use> uses(scene.images.size(), Use::none);
  const auto mark = [&](const TextureLookup& texture, Use use) {
    if (texture.image < 0) return;
    Use& known = uses[static_cast<size_t>(texture.image)];
    known = known | use;
  };
  for (const Material& material : scene.materials) {
    for (const TextureLookup* texture : {&material.base_color_texture, &material.specular_color_texture})
      mark(*texture, Use::colours);
    for (const TextureLookup* texture :
         {&material.metallic_roughness_texture, &material.transmission_texture, &material.specular_texture})
      mark(*texture, Use::numbers);
  }
  return uses;
}

/// The mean of the texels from (x, y) on, as far as the image goes.
void average(const Image& image, int x, int y, Use use, uint8_t* mean) {
  const int channels = image.channels;
  const bool alpha = channels % 2 == 0;
  const int colours = alpha ? channels - 1 : channels;
  std::array<float, 4> sums{}, plain{};
  float weights = 0, count = 0;
  for (int j = y; j < std::min(y + texels_a_side, image.height); j++)
    for (int i = x; i < std::min(x + texels_a_side, image.width); i++) {
      const uint8_t* texel =
          &image.pixels[(static_cast<size_t>(j) * static_cast<size_t>(image.width) + static_cast<size_t>(i)) *
                        static_cast<size_t>(channels)];
      const float weight = alpha ? static_cast<float>(texel[colours]) / 255 : 1.0f;
      weights += weight;
      count++;
      for (int c = 0; c < colours; c++) {
        const float value = use == Use::colours ? srgb_to_linear(texel[c]) : static_cast<float>(texel[c]) / 255;
        sums[static_cast<size_t>(c)] += value * weight;
        plain[static_cast<size_t>(c)] += value;
      }
    }
  for (int c = 0; c < colours; c++) {
    const auto i = static_cast<size_t>(c);
    const float value = weights > 0 ? sums[i] / weights : plain[i] / count;
    mean[c] = to_byte(use == Use::colours ? linear_to_srgb(value) : value);
  }
  if (alpha) mean[colours] = to_byte(weights / count);
}

Image from_afar(const Image& image, Use use) {
  const auto reduced = [](int side) { return (side + texels_a_side - 1) / texels_a_side; };
  Image small{.width = reduced(image.width), .height = reduced(image.height), .channels = image.channels, .pixels = {}};
  const auto channels = static_cast<size_t>(image.channels);
  small.pixels.resize(static_cast<size_t>(small.width) * static_cast<size_t>(small.height) * channels);
  uint8_t* texel = small.pixels.data();
  for (int y = 0; y < small.height; y++)
    for (int x = 0; x < small.width; x++, texel += channels)
      average(image, x * texels_a_side, y * texels_a_side, use, texel);
  return small;
}

}  // namespace

std::vector<Image> images_from_afar(const Scene& scene) {
  const std::vector<Use> uses = uses_of(scene);
  std::vector<Image> images(scene.images.size());
  for (size_t i = 0; i < images.size(); i++) {
    const Image& image = scene.images[i];
    const bool small = std::min(image.width, image.height) < least_side;
    if (uses[i] != Use::none) images[i] = small || uses[i] == Use::both ? image : from_afar(image, uses[i]);
  }
  return images;
}

}  // namespace lightwell
