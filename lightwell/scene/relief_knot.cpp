// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/relief_knot.h"

#include <numbers>

#include "lightwell/base/assert.h"
#include "lightwell/base/parallel.h"
#include "lightwell/scene/gradient_noise.h"

namespace lightwell {
namespace {

constexpr float two_pi = 2 * std::numbers::pi_v<float>;

// Metres.
constexpr float knot_radius = 0.8f;
constexpr float knot_swing = 0.4f;
constexpr float knot_depth = 0.42f;
constexpr float tube_radius = 0.25f;
constexpr float tube_length = 12.5f;  // of the centre line, about

constexpr int flutes = 8;        // round the tube
constexpr int flute_turns = 30;  // that the flutes make on their way along the knot
constexpr float flute_depth = 0.06f;
constexpr float coarsest_relief = 0.3f;  // wavelength
constexpr float relief_height = 0.065f;  // per metre of wavelength

/// The centre line: a trefoil, for t in [0, 2 pi).
Vec3f center_line(float t) {
  const float radius = knot_radius + knot_swing * std::cos(3 * t);
  return {{-radius * std::sin(2 * t), radius * std::cos(2 * t), knot_depth * std::sin(3 * t)}};
}

/// The directions across the tube: outwards from the knot's middle, and the third one.
struct Frame {
  Vec3f center, outward, sideward;
};

Frame frame_at(float t) {
  constexpr float step = 1e-3f;
  const Vec3f center = center_line(t);
  const Vec3f tangent = normalized(center_line(t + step) - center_line(t - step));
  const Vec3f outward = normalized(center - tangent * dot(center, tangent));
  return {center, outward, cross(tangent, outward)};
}

/// Height of the weathered stone: ridges of all wavelengths from the coarsest to the finest, each as high as it is
/// long.
float stone_height(const GradientNoise& noise, const Vec3f& p, float finest) {
  float height = 0;
  for (float wavelength = coarsest_relief; wavelength >= finest; wavelength *= 0.5f) {
    const float value = noise.at(p * (1 / wavelength));
    height += wavelength * relief_height * (0.5f - 2 * std::abs(value));
  }
  return height;
}

/// Height of the flutes, round in their grounds and sharp on their ridges.
float flute_height(float t, float angle) {
  const float phase = (static_cast<float>(flutes) * angle + static_cast<float>(flute_turns) * t) / 2;
  return flute_depth * (0.5f - std::abs(std::sin(phase)));
}

std::vector<Face> tube_faces(uint32_t along, uint32_t around) {
  std::vector<Face> faces;
  faces.reserve(size_t(2) * along * around);
  for (uint32_t i = 0; i < along; i++) {
    for (uint32_t j = 0; j < around; j++) {
      const uint32_t here = i * around, next = (i + 1) % along * around, turn = (j + 1) % around;
      faces.push_back({here + j, next + turn, next + j});
      faces.push_back({here + j, here + turn, next + turn});
    }
  }
  return faces;
}

}  // namespace

Mesh relief_knot(uint32_t along, uint32_t around, uint64_t seed) {
  LW_ASSERT(along >= 3 && around >= 3);
  // Three vertices a wave are the fewest that show it.
  const float finest =
      3 * std::max(tube_length / static_cast<float>(along), two_pi * tube_radius / static_cast<float>(around));
  const GradientNoise noise(seed);
  Mesh mesh;
  mesh.positions.resize(size_t(along) * around);
  parallel_for(along, 16, default_threads(), [&](size_t begin, size_t end, int) {
    for (size_t i = begin; i < end; i++) {
      const float t = two_pi * static_cast<float>(i) / static_cast<float>(along);
      const Frame frame = frame_at(t);
      for (size_t j = 0; j < around; j++) {
        const float angle = two_pi * static_cast<float>(j) / static_cast<float>(around);
        const Vec3f across = frame.outward * std::cos(angle) + frame.sideward * std::sin(angle);
        const Vec3f smooth = frame.center + across * tube_radius;
        const float height = flute_height(t, angle) + stone_height(noise, smooth, finest);
        mesh.positions[i * around + j] = smooth + across * height;
      }
    }
  });
  mesh.faces = tube_faces(along, around);
  mesh.normals = smooth_normals(mesh);
  return mesh;
}

}  // namespace lightwell
