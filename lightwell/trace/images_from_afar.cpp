// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/images_from_afar.h"

#include "lightwell/texture/mip.h"

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

}  // namespace

std::vector<Image> images_from_afar(const Scene& scene) {
  const std::vector<Use> uses = uses_of(scene);
  std::vector<Image> images(scene.images.size());
  for (size_t i = 0; i < images.size(); i++) {
    const Image& image = scene.images[i];
    if (uses[i] == Use::none) continue;
    const bool as_it_is = uses[i] == Use::both || std::min(image.width, image.height) < least_side;
    const int longest = std::max(image.width, image.height);
    const int side = as_it_is ? longest : (longest + texels_a_side - 1) / texels_a_side;
    images[i] = smallest_mip(image, side, uses[i] == Use::colours);
  }
  return images;
}

}  // namespace lightwell
