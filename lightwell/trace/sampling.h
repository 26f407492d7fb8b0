// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>
#include <vector>

#include "lightwell/base/random.h"
#include "lightwell/base/vector.h"

namespace lightwell {

constexpr float pi = std::numbers::pi_v<float>;

/// The mean of red, green and blue, by which sources of light are chosen and ranked.
inline float mean_of_channels(const Vec3f& color) { return (color[0] + color[1] + color[2]) / 3; }

/// A right-handed orthonormal frame around a unit normal, its z (Duff et al., Building an Orthonormal Basis, Revisited,
/// JCGT 2017).
struct Frame {
  Vec3f x, y, z;

  explicit Frame(const Vec3f& normal);
  Vec3f to_world(const Vec3f& v) const { return x * v[0] + y * v[1] + z * v[2]; }
  Vec3f to_local(const Vec3f& v) const { return {{dot(v, x), dot(v, y), dot(v, z)}}; }
};

/// A direction around the unit normal with density cos / pi.
Vec3f sample_cosine_hemisphere(const Vec3f& normal, Random& random);

/// A uniform direction.
Vec3f sample_sphere(Random& random);

/// Direction i of `count` that are spread evenly over the sphere along a Fibonacci spiral; u and v in [0, 1) shift and
/// turn it.
Vec3f sphere_direction(size_t i, size_t count, float u, float v);

/// The same over the hemisphere round z, with density cos / pi.
Vec3f cosine_direction(size_t i, size_t count, float u, float v);

/// A uniform point of the unit disc, z = 0.
Vec3f sample_disc(Random& random);

/// Uniform barycentric coordinates of a triangle's second and third corner.
Vec2f sample_triangle(Random& random);

/// The power heuristic for one sample of each of two densities: the weight of the first (Veach and Guibas, Optimally
/// Combining Sampling Techniques, SIGGRAPH 1995). The two weights sum to 1 even where a density's square leaves the
/// range of a float.
inline float power_heuristic(float of_this, float of_other) {
  if (of_this <= 0) return 0;
  const float ratio = of_other / of_this;
  return 1 / (1 + ratio * ratio);
}

/// Chooses an index with a probability proportional to its weight.
class Distribution {
 public:
  Distribution() = default;
  /// The weights must be finite and not negative.
  explicit Distribution(const std::vector<float>& weights);

  void reserve(size_t entries) { cumulative_.reserve(entries); }
  /// Appends an entry; its weight must be finite and not negative.
  void add(double weight) { cumulative_.push_back(total() + weight); }

  /// The sum of the weights; when it is 0 there is nothing to sample.
  double total() const { return cumulative_.empty() ? 0 : cumulative_.back(); }
  size_t size() const { return cumulative_.size(); }
  /// Samples an index; the total must not be 0. Draws 32 bits, so that all entries of large maps and meshes can be
  /// chosen.
  size_t sample(Random& random) const { return at(random.bits() * 0x1p-32).index; }
  /// The entry up to which a share of the total goes, 0 to 1 without it, and how much of the entry is below, as a share
  /// of it: by that a distribution within the entry can be sampled.
  struct Place {
    size_t index = 0;
    double share = 0;
  };
  Place at(double share) const;
  /// The probability of an index.
  float probability(size_t index) const;

 private:
  std::vector<double> cumulative_;
};

}  // namespace lightwell
