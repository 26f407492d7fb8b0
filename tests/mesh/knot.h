// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/base/random.h"
#include "lightwell/mesh/mesh.h"

namespace lightwell {

/// Noise in [-1, 1] that is smooth on the scale of 1: random values on the integer lattice, interpolated.
inline float value_noise(const Vec3f& p, uint64_t seed) {
  Vec3i cell;
  Vec3f weight;
  for (int i = 0; i < 3; i++) {
    cell[i] = static_cast<int>(std::floor(p[i]));
    const float t = p[i] - static_cast<float>(cell[i]);
    weight[i] = t * t * t * (t * (t * 6 - 15) + 10);
  }
  float sum = 0;
  for (int corner = 0; corner < 8; corner++) {
    float share = 1;
    uint64_t place = seed;
    for (int i = 0; i < 3; i++) {
      const int bit = corner >> i & 1;
      share *= bit ? weight[i] : 1 - weight[i];
      place = hash64(place + static_cast<uint64_t>(cell[i] + bit) + 0x9e3779b97f4a7c15u);
    }
    sum += share * (static_cast<float>(place >> 40) * 0x1p-23f - 1);
  }
  return sum;
}

/// A closed bumpy tube of 2 * along * round triangles about a torus knot, irregularly sampled, with normals and without
/// texcoords: like a scan in all that matters to a simplifier or a coder.
inline Mesh knot(int along, int round) {
  const float tau = 6.2831853f;
  const auto curve = [](float t) {
    const float r = 2 + std::cos(3 * t);
    return Vec3f{{r * std::cos(2 * t), r * std::sin(2 * t), 1.2f * std::sin(3 * t)}};
  };
  Mesh mesh;
  Random random(1, 0);
  for (int i = 0; i < along; i++)
    for (int j = 0; j < round; j++) {
      const auto jitter = [&] { return 0.35f * (2 * random.uniform() - 1); };
      const float a = tau * (static_cast<float>(i) + jitter()) / static_cast<float>(along);
      const float b = tau * (static_cast<float>(j) + jitter()) / static_cast<float>(round);
      const Vec3f tangent = normalized(curve(a + 1e-2f) - curve(a - 1e-2f));
      const Vec3f side = normalized(cross(tangent, Vec3f{{0, 0, 1}})), up = cross(side, tangent);
      const Vec3f out = up * std::cos(b) + side * std::sin(b), p = curve(a) + out * 0.42f;
      float height = 0, amplitude = 0.11f, frequency = 2.3f;
      for (uint64_t octave = 0; octave < 7; octave++, amplitude *= 0.5f, frequency *= 2.03f)
        height += amplitude * value_noise(p * frequency, octave);
      mesh.positions.push_back(p + out * height);
    }
  const auto at = [&](int i, int j) { return static_cast<uint32_t>(i % along * round + j % round); };
  for (int i = 0; i < along; i++)
    for (int j = 0; j < round; j++) {
      const uint32_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      const auto& p = mesh.positions;
      const bool along_ac = length(p[a] - p[c]) <= length(p[b] - p[d]);
      mesh.faces.push_back(along_ac ? Face{a, c, b} : Face{a, d, b});
      mesh.faces.push_back(along_ac ? Face{a, d, c} : Face{b, d, c});
    }
  mesh.normals = smooth_normals(mesh);
  return mesh;
}

}  // namespace lightwell
