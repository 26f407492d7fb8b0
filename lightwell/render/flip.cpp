// SPDX-License-Identifier: Apache-2.0
#include "lightwell/render/flip.h"

#include <algorithm>
#include <numbers>

#include "lightwell/render/colour.h"

namespace lightwell {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

// A plane of numbers; beyond its edges the edge values repeat.
struct Plane {
  int width, height;
  std::vector<float> values;

  float operator()(int x, int y) const {
    const int cx = std::clamp(x, 0, width - 1), cy = std::clamp(y, 0, height - 1);
    return values[static_cast<size_t>(cy) * static_cast<size_t>(width) + static_cast<size_t>(cx)];
  }
};

// Weights for the offsets -radius ... radius.
using Kernel = std::vector<float>;

template <typename Weight>
Kernel kernel(int radius, const Weight& weight) {
  Kernel k;
  for (int x = -radius; x <= radius; x++) k.push_back(weight(static_cast<float>(x)));
  return k;
}

float sum(const Kernel& k) {
  float total = 0;
  for (const float w : k) total += w;
  return total;
}

// Convolution with the outer product of two kernels.
Plane convolve(const Plane& in, const Kernel& along_x, const Kernel& along_y) {
  const auto pass = [](const Plane& plane, const Kernel& k, int dx, int dy) {
    Plane out{plane.width, plane.height, {}};
    out.values.reserve(plane.values.size());
    const int radius = static_cast<int>(k.size()) / 2;
    for (int y = 0; y < plane.height; y++) {
      for (int x = 0; x < plane.width; x++) {
        float total = 0;
        for (int i = -radius; i <= radius; i++)
          total += k[static_cast<size_t>(i + radius)] * plane(x + i * dx, y + i * dy);
        out.values.push_back(total);
      }
    }
    return out;
  };
  return pass(pass(in, along_x, 1, 0), along_y, 0, 1);
}

// One channel's contrast sensitivity as two Gaussians (the paper's Table 1).
struct Sensitivity {
  float a1, b1, a2, b2;
};

constexpr Sensitivity achromatic{1, 0.0047f, 0, 1e-5f};
constexpr Sensitivity red_green{1, 0.0053f, 0, 1e-5f};
constexpr Sensitivity blue_yellow{34.1f, 0.04f, 13.5f, 0.025f};

Plane filtered(const Plane& plane, const Sensitivity& s, float pixels_per_degree) {
  const int radius = static_cast<int>(std::ceil(3 * std::sqrt(blue_yellow.b1 / (2 * pi * pi)) * pixels_per_degree));
  const auto gaussian = [&](float b) {
    return kernel(radius, [&](float x) {
      const float degrees = x / pixels_per_degree;
      return std::exp(-pi * pi * degrees * degrees / b);
    });
  };
  const Kernel first = gaussian(s.b1), second = gaussian(s.b2);
  const float w1 = s.a1 * std::sqrt(pi / s.b1), w2 = s.a2 * std::sqrt(pi / s.b2);
  const float total = w1 * sum(first) * sum(first) + w2 * sum(second) * sum(second);
  Plane result = convolve(plane, first, first);
  for (float& v : result.values) v *= w1 / total;
  if (w2 > 0) {
    const Plane more = convolve(plane, second, second);
    for (size_t i = 0; i < result.values.size(); i++) result.values[i] += more.values[i] * w2 / total;
  }
  return result;
}

// The opponent space YCxCz.
Vec3f opponent(const Vec3f& rgb) {
  const Vec3f xyz = relative_xyz(rgb);
  return {{116 * xyz[1] - 16, 500 * (xyz[0] - xyz[1]), 200 * (xyz[1] - xyz[2])}};
}

Vec3f from_opponent(const Vec3f& c) {
  const float y = (c[0] + 16) / 116;
  return linear_srgb({{c[1] / 500 + y, y, y - c[2] / 200}});
}

std::array<Plane, 3> opponent_planes(const std::vector<Vec3f>& picture, int width, int height) {
  std::array<Plane, 3> planes{Plane{width, height, {}}, Plane{width, height, {}}, Plane{width, height, {}}};
  for (const Vec3f& rgb : picture) {
    const Vec3f c = opponent(rgb);
    for (size_t i = 0; i < 3; i++) planes[i].values.push_back(c[static_cast<int>(i)]);
  }
  return planes;
}

// L*a*b* with chroma growing with lightness (Hunt).
Vec3f hunt_lab(const Vec3f& rgb) {
  const Vec3f lab = lab_of(relative_xyz(rgb));
  return {{lab[0], 0.01f * lab[0] * lab[1], 0.01f * lab[0] * lab[2]}};
}

float hyab(const Vec3f& a, const Vec3f& b) { return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]); }

// The picture as the eye blurs it, in Hunt's L*a*b*.
std::vector<Vec3f> perceived(const std::array<Plane, 3>& planes, float pixels_per_degree) {
  const Plane y = filtered(planes[0], achromatic, pixels_per_degree);
  const Plane cx = filtered(planes[1], red_green, pixels_per_degree);
  const Plane cz = filtered(planes[2], blue_yellow, pixels_per_degree);
  std::vector<Vec3f> result;
  for (size_t i = 0; i < y.values.size(); i++) {
    const Vec3f rgb = from_opponent({{y.values[i], cx.values[i], cz.values[i]}});
    result.push_back(hunt_lab(max(Vec3f{}, min(rgb, Vec3f::filled(1)))));
  }
  return result;
}

// HyAB compressed and remapped to [0, 1], section 4.1.3.
float colour_error(const Vec3f& a, const Vec3f& b) {
  constexpr float exponent = 0.7f, knee = 0.4f, knee_value = 0.95f;
  static const float largest = std::pow(hyab(hunt_lab({{0, 1, 0}}), hunt_lab({{0, 0, 1}})), exponent);
  const float error = std::pow(hyab(a, b), exponent);
  if (error < knee * largest) return knee_value / (knee * largest) * error;
  return knee_value + (error - knee * largest) / (largest - knee * largest) * (1 - knee_value);
}

// Scales a kernel so that its positive and its negative weights add up to 1 and -1.
Kernel balanced(Kernel k) {
  float positive = 0, negative = 0;
  for (const float w : k) (w > 0 ? positive : negative) += w;
  for (float& w : k) w /= w > 0 ? positive : -negative;
  return k;
}

// Magnitudes of the edge and point features of the luminance, section 4.2.
struct Features {
  std::vector<float> edges, points;
};

Features features(Plane luminance, float pixels_per_degree) {
  for (float& y : luminance.values) y = (y + 16) / 116;
  const float deviation = 0.5f * 0.082f * pixels_per_degree;
  const int radius = static_cast<int>(std::ceil(3 * deviation));
  const auto gaussian = [&](float x) { return std::exp(-x * x / (2 * deviation * deviation)); };
  Kernel blur = kernel(radius, gaussian);
  const float total = sum(blur);
  for (float& w : blur) w /= total;
  const Kernel edge = balanced(kernel(radius, [&](float x) { return -x * gaussian(x); }));
  const Kernel point =
      balanced(kernel(radius, [&](float x) { return (x * x / (deviation * deviation) - 1) * gaussian(x); }));

  const auto gradient = [&](const Kernel& k) {
    Plane x = convolve(luminance, k, blur);
    const Plane y = convolve(luminance, blur, k);
    for (size_t i = 0; i < x.values.size(); i++) x.values[i] = std::hypot(x.values[i], y.values[i]);
    return std::move(x.values);
  };
  return {gradient(edge), gradient(point)};
}

}  // namespace

std::vector<float> flip(const std::vector<Vec3f>& reference, const std::vector<Vec3f>& test, int width, int height,
                        float pixels_per_degree) {
  const std::array<Plane, 3> planes1 = opponent_planes(reference, width, height);
  const std::array<Plane, 3> planes2 = opponent_planes(test, width, height);
  const std::vector<Vec3f> colours1 = perceived(planes1, pixels_per_degree);
  const std::vector<Vec3f> colours2 = perceived(planes2, pixels_per_degree);
  const Features features1 = features(planes1[0], pixels_per_degree),
                 features2 = features(planes2[0], pixels_per_degree);

  std::vector<float> errors;
  for (size_t i = 0; i < reference.size(); i++) {
    const float difference = std::max(std::abs(features1.edges[i] - features2.edges[i]),
                                      std::abs(features1.points[i] - features2.points[i]));
    const float feature_error = std::min(1.0f, std::sqrt(difference / std::numbers::sqrt2_v<float>));
    errors.push_back(std::pow(colour_error(colours1[i], colours2[i]), 1 - feature_error));
  }
  return errors;
}

}  // namespace lightwell
