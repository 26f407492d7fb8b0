// SPDX-License-Identifier: Apache-2.0
#include "lightwell/render/colour.h"

#include <numbers>

namespace lightwell {
namespace {

// The matrix from linear sRGB to XYZ (IEC 61966-2-1); the sums of its rows are the white point.
constexpr Vec3d to_x{{0.4124564, 0.3575761, 0.1804375}};
constexpr Vec3d to_y{{0.2126729, 0.7151522, 0.0721750}};
constexpr Vec3d to_z{{0.0193339, 0.1191920, 0.9503041}};

constexpr Vec3d relative(const Vec3d& row) { return row / (row[0] + row[1] + row[2]); }

constexpr Vec3d row_x = relative(to_x), row_y = relative(to_y), row_z = relative(to_z);

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

// The angle of a point of the a, b plane in degrees, 0 ... 360; 0 at the origin.
double hue(double a, double b) {
  if (a == 0 && b == 0) return 0;
  const double angle = std::atan2(b, a) * 180 / std::numbers::pi;
  return angle < 0 ? angle + 360 : angle;
}

double power7(double x) { return std::pow(x, 7); }

}  // namespace

Vec3f relative_xyz(const Vec3f& rgb) {
  const Vec3d c = rgb.cast<double>();
  return Vec3d{{dot(row_x, c), dot(row_y, c), dot(row_z, c)}}.cast<float>();
}

// Cramer's rule.
Vec3f linear_srgb(const Vec3f& xyz) {
  const Vec3d v = xyz.cast<double>();
  const double determinant = dot(row_x, cross(row_y, row_z));
  const Vec3d sum = cross(row_y, row_z) * v[0] + cross(row_z, row_x) * v[1] + cross(row_x, row_y) * v[2];
  return (sum / determinant).cast<float>();
}

Vec3f lab_of(const Vec3f& xyz) {
  const auto f = [](float t) {
    constexpr float edge = 6.0f / 29;
    return t > edge * edge * edge ? std::cbrt(t) : t / (3 * edge * edge) + 4.0f / 29;
  };
  const float x = f(xyz[0]), y = f(xyz[1]), z = f(xyz[2]);
  return {{116 * y - 16, 500 * (x - y), 200 * (y - z)}};
}

float ciede2000(const Vec3f& lab1, const Vec3f& lab2) {
  // Step 1: chroma and hue with a stretched for small chroma.
  const double c_mean = (std::hypot(lab1[1], lab1[2]) + std::hypot(lab2[1], lab2[2])) / 2;
  const double g = 0.5 * (1 - std::sqrt(power7(c_mean) / (power7(c_mean) + power7(25))));
  const double a1 = (1 + g) * lab1[1], a2 = (1 + g) * lab2[1];
  const double c1 = std::hypot(a1, lab1[2]), c2 = std::hypot(a2, lab2[2]);
  const double h1 = hue(a1, lab1[2]), h2 = hue(a2, lab2[2]);

  // Step 2: differences.
  double turn = h2 - h1;
  if (c1 * c2 == 0)
    turn = 0;
  else if (turn > 180)
    turn -= 360;
  else if (turn < -180)
    turn += 360;
  const double lightness = lab2[0] - lab1[0];
  const double chroma = c2 - c1;
  const double hue_distance = 2 * std::sqrt(c1 * c2) * std::sin(radians(turn) / 2);

  // Step 3: weights at the mean colour.
  const double l = (lab1[0] + lab2[0]) / 2, c = (c1 + c2) / 2;
  double h = h1 + h2;
  if (c1 * c2 != 0) {
    if (std::abs(h1 - h2) > 180) h += h < 360 ? 360 : -360;
    h /= 2;
  }
  const double t = 1 - 0.17 * std::cos(radians(h - 30)) + 0.24 * std::cos(radians(2 * h)) +
                   0.32 * std::cos(radians(3 * h + 6)) - 0.20 * std::cos(radians(4 * h - 63));
  const double s_l = 1 + 0.015 * (l - 50) * (l - 50) / std::sqrt(20 + (l - 50) * (l - 50));
  const double s_c = 1 + 0.045 * c;
  const double s_h = 1 + 0.015 * c * t;
  const double blue = 30 * std::exp(-std::pow((h - 275) / 25, 2));
  const double rotation = -std::sin(radians(2 * blue)) * 2 * std::sqrt(power7(c) / (power7(c) + power7(25)));
  const double dl = lightness / s_l, dc = chroma / s_c, dh = hue_distance / s_h;
  return static_cast<float>(std::sqrt(std::max(0.0, dl * dl + dc * dc + dh * dh + rotation * dc * dh)));
}

}  // namespace lightwell
