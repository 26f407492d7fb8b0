// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "lightwell/base/half.h"
#include "lightwell/light/atlas.h"

namespace lightwell {

/// What a GPU does with an atlas: its filter, and the formula of three.js's chunk lightprobes_pars_fragment (0.187), in
/// plain arithmetic.
class AtlasLookup {
 public:
  explicit AtlasLookup(const LightAtlas& atlas) : atlas_(atlas) {}

  Vec4f texel(int x, int y, int slice) const {
    const size_t at = 4 * (static_cast<size_t>(x) + static_cast<size_t>(atlas_.width()) *
                                                        (static_cast<size_t>(y) + static_cast<size_t>(atlas_.height()) *
                                                                                      static_cast<size_t>(slice)));
    Vec4f v;
    for (int lane = 0; lane < 4; lane++) v[lane] = from_half(atlas_.halves()[at + static_cast<size_t>(lane)]);
    return v;
  }

  /// A linear filter, clamped to the edge.
  Vec4f texture(Vec3f uvw) const {
    const Vec3i size{{atlas_.width(), atlas_.height(), atlas_.depth()}};
    Vec3i first;
    Vec3f fraction;
    for (int a = 0; a < 3; a++) {
      const float at = uvw[a] * static_cast<float>(size[a]) - 0.5f;
      first[a] = static_cast<int>(std::floor(at));
      fraction[a] = at - static_cast<float>(first[a]);
    }
    Vec4f sum{};
    for (int corner = 0; corner < 8; corner++) {
      float weight = 1;
      Vec3i n;
      for (int a = 0; a < 3; a++) {
        const bool upper = corner >> a & 1;
        n[a] = std::clamp(first[a] + upper, 0, size[a] - 1);
        weight *= upper ? fraction[a] : 1 - fraction[a];
      }
      sum += texel(n[0], n[1], n[2]) * weight;
    }
    return sum;
  }

  /// Irradiance of a regular grid at a place given in nodes (0 ... nodes - 1), for a lookup already moved along the
  /// normal.
  Vec3f irradiance(const Vec3f& node, const Vec3f& n) const {
    const float layers = static_cast<float>(atlas_.depth()) / 7;
    const Vec3f last{{static_cast<float>(atlas_.width() - 1), static_cast<float>(atlas_.height() - 1), layers - 3}};
    return evaluate(max(Vec3f{}, min(node, last)) + Vec3f{{0, 0, 1}}, layers, n);
  }

  /// The same for a grid with bricks, as shaders/light_grid.glsl does it: `place` in cells of the grid.
  Vec3f irradiance_of_bricks(const Vec3f& place, const Vec3f& n) const {
    const Vec4f header = texel(0, 0, 0), parts = texel(1, 0, 0), cells = texel(2, 0, 0);
    const Vec3f last{{cells[0], cells[1], cells[2]}}, at = place + n * header[3];
    const float finest = std::exp2(parts[1]);
    const Vec3f within = max(Vec3f{}, min(at, last - Vec3f::filled(0.5f / finest)));
    const Vec3f cube = within * (finest / 4);
    const Vec4f brick = texel(static_cast<int>(cube[0]), static_cast<int>(cube[1]), 1 + static_cast<int>(cube[2]));
    const float level = std::exp2(brick[3]);
    Vec3f local;
    for (int a = 0; a < 3; a++)
      local[a] = std::clamp(at[a] * level - 4 * std::floor(within[a] * level / 4), 0.0f, 4.0f);
    return evaluate(local + Vec3f{{brick[0], brick[1], brick[2] + parts[3]}}, parts[2], n);
  }

 private:
  /// From seven texels, `next` slices from one to the next.
  Vec3f evaluate(const Vec3f& first, float next, const Vec3f& n) const {
    const Vec3f size = Vec3i{{atlas_.width(), atlas_.height(), atlas_.depth()}}.cast<float>();
    std::array<float, 28> channels;
    for (int t = 0; t < 7; t++) {
      const Vec3f at = first + Vec3f{{0.5f, 0.5f, 0.5f + static_cast<float>(t) * next}};
      const Vec4f value = texture(at / size);
      for (int lane = 0; lane < 4; lane++) channels[static_cast<size_t>(4 * t + lane)] = value[lane];
    }
    const std::array<float, 9> basis{0.886227f,
                                     2 * 0.511664f * n[1],
                                     2 * 0.511664f * n[2],
                                     2 * 0.511664f * n[0],
                                     2 * 0.429043f * n[0] * n[1],
                                     2 * 0.429043f * n[1] * n[2],
                                     0.743125f * n[2] * n[2] - 0.247708f,
                                     2 * 0.429043f * n[0] * n[2],
                                     0.429043f * (n[0] * n[0] - n[1] * n[1])};
    Vec3f sum{};
    for (size_t k = 0; k < 9; k++) sum += Vec3f{{channels[3 * k], channels[3 * k + 1], channels[3 * k + 2]}} * basis[k];
    return max(sum / channels[27], Vec3f{});
  }

  const LightAtlas& atlas_;
};

/// A grid somewhere in the world: turned by a quaternion, stretched, then moved; as the uniforms that light_grid.glsl
/// reads.
struct GridPlacement {
  Vec3f position;    ///< of the grid's own origin
  Vec4f quaternion;  ///< x, y, z, w
  Vec3f stretch;

  Vec3f turned(const Vec3f& v) const {
    const Vec3f q{{quaternion[0], quaternion[1], quaternion[2]}};
    return v + cross(q, cross(q, v) + v * quaternion[3]) * 2.0f;
  }
  Vec3f point(const Vec3f& p) const { return turned(p * stretch) + position; }
  Vec3f normal(const Vec3f& n) const { return normalized(turned(n / stretch)); }

  Vec3f uniform_min(const GridShape& shape) const { return point(shape.lo); }
  Vec3f uniform_max() const {
    return Vec3f{{quaternion[0], quaternion[1], quaternion[2]}} * (quaternion[3] < 0 ? -1.0f : 1.0f);
  }
  Vec3f uniform_resolution(const GridShape& shape) const {
    return stretch * (shape.hi() - shape.lo) * Vec3f{{1, 1, -1}};
  }
};

}  // namespace lightwell
