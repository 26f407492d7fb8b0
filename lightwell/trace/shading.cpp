// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/shading.h"

namespace lightwell {
namespace {

/// The least cosine between a shading normal and the direction it is seen from.
constexpr float least_cosine = 0.01f;

Vec3f mirrored(const Vec3f& direction, const Vec3f& normal) {
  return direction - normal * (2 * dot(direction, normal));
}

}  // namespace

Shading::Evaluation Shading::evaluate(const Vec3f& in) const {
  Evaluation sum;
  if (dot(normal, in) <= 0) return sum;
  const auto add = [&](const Vec3f& direction) {
    const float cosine = dot(shading_normal, direction);
    if (cosine <= 0) return;
    const Bsdf::Evaluation found = bsdf.evaluate(shading_normal, out, direction);
    sum.reflectance += found.value * cosine;
    sum.density += found.density;
  };
  add(in);
  if (shading_normal != normal) add(mirrored(in, normal));
  return sum;
}

Bsdf::Sample Shading::sample(Random& random) const {
  Bsdf::Sample sample = bsdf.sample(shading_normal, out, random);
  if (shading_normal == normal || sample.density <= 0) return sample;
  if (dot(normal, sample.in) < 0) sample.in = mirrored(sample.in, normal);
  const Evaluation found = evaluate(sample.in);
  sample.density = found.density;
  sample.weight = found.density > 0 ? found.reflectance / found.density : Vec3f{};
  return sample;
}

Vec3f facing(const Vec3f& shading_normal, const Vec3f& out) {
  const float cosine = dot(shading_normal, out);
  if (cosine >= least_cosine) return shading_normal;
  const Vec3f in_plane = shading_normal - out * cosine;
  const float size = length(in_plane);
  if (!(size > 0)) return out;
  return in_plane * (std::sqrt(1 - least_cosine * least_cosine) / size) + out * least_cosine;
}

}  // namespace lightwell
