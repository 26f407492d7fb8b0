// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/texture_lookup.h"

#include "lightwell/texture/transfer.h"

namespace lightwell {
namespace {

/// The texel that an index outside [0, size) stands for.
int wrapped(int index, int size, TextureLookup::Wrap wrap) {
  switch (wrap) {
    case TextureLookup::Wrap::clamp: return std::clamp(index, 0, size - 1);
    case TextureLookup::Wrap::repeat: return (index % size + size) % size;
    case TextureLookup::Wrap::mirror: break;
  }
  const int folded = (index % (2 * size) + 2 * size) % (2 * size);
  return folded < size ? folded : 2 * size - 1 - folded;
}

Vec4f texel(const Image& image, int x, int y, bool srgb) {
  const size_t channels = static_cast<size_t>(image.channels);
  const uint8_t* codes =
      &image.pixels[(static_cast<size_t>(y) * static_cast<size_t>(image.width) + static_cast<size_t>(x)) * channels];
  const auto color = [&](size_t channel) {
    return srgb ? srgb_to_linear(codes[channel]) : static_cast<float>(codes[channel]) / 255;
  };
  const bool grey = channels < 3;
  const float alpha = channels % 2 == 0 ? static_cast<float>(codes[channels - 1]) / 255 : 1.0f;
  return {{color(0), color(grey ? 0 : 1), color(grey ? 0 : 2), alpha}};
}

/// Limits a coordinate so that it fits an int, 0 if it is not finite; no texture is used that far out.
float bounded(float x) { return std::isfinite(x) ? std::clamp(x, -1e6f, 1e6f) : 0.0f; }

}  // namespace

Vec2f transformed(const TextureLookup& texture, const std::array<Vec2f, 2>& texcoords) {
  const Vec2f& t = texcoords[texture.texcoord == 1 ? 1 : 0];
  const Vec3f homogeneous{{t[0], t[1], 1}};
  return {{dot(Vec3f{texture.row_u}, homogeneous), dot(Vec3f{texture.row_v}, homogeneous)}};
}

Vec4f look_up(const TextureLookup& texture, const std::vector<Image>& images, const std::array<Vec2f, 2>& texcoords,
              bool srgb) {
  if (texture.image < 0) return Vec4f::filled(1);
  const Image& image = images[static_cast<size_t>(texture.image)];
  const Vec2f uv = transformed(texture, texcoords);
  const float x = bounded(uv[0] * static_cast<float>(image.width) - 0.5f);
  const float y = bounded(uv[1] * static_cast<float>(image.height) - 0.5f);
  const int left = static_cast<int>(std::floor(x)), top = static_cast<int>(std::floor(y));
  const float right_share = x - static_cast<float>(left), bottom_share = y - static_cast<float>(top);
  Vec4f sum{};
  for (int j = 0; j < 2; j++) {
    for (int i = 0; i < 2; i++) {
      const float weight = (i ? right_share : 1 - right_share) * (j ? bottom_share : 1 - bottom_share);
      sum += texel(image, wrapped(left + i, image.width, texture.wrap_u),
                   wrapped(top + j, image.height, texture.wrap_v), srgb) *
             weight;
    }
  }
  return sum;
}

}  // namespace lightwell
