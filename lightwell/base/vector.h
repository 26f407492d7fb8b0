// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace lightwell {

/// A vector of N numbers with componentwise arithmetic. Points, directions and linear RGB colours are Vec3f.
template <typename T, int N>
struct Vec {
  std::array<T, N> e{};

  constexpr T& operator[](int i) { return e[static_cast<size_t>(i)]; }
  constexpr T operator[](int i) const { return e[static_cast<size_t>(i)]; }
  bool operator==(const Vec&) const = default;
  auto operator<=>(const Vec&) const = default;

  static constexpr Vec filled(T value) {
    Vec v;
    v.e.fill(value);
    return v;
  }
  template <typename U>
  constexpr Vec<U, N> cast() const {
    Vec<U, N> v;
    for (int i = 0; i < N; i++) v[i] = static_cast<U>((*this)[i]);
    return v;
  }
  constexpr Vec& operator+=(const Vec& b) { return *this = *this + b; }
  constexpr Vec& operator-=(const Vec& b) { return *this = *this - b; }
  constexpr Vec& operator*=(const Vec& b) { return *this = *this * b; }
  constexpr Vec& operator*=(T s) { return *this = *this * s; }

  friend constexpr Vec operator+(Vec a, const Vec& b) {
    for (int i = 0; i < N; i++) a[i] += b[i];
    return a;
  }
  friend constexpr Vec operator-(Vec a, const Vec& b) {
    for (int i = 0; i < N; i++) a[i] -= b[i];
    return a;
  }
  friend constexpr Vec operator*(Vec a, const Vec& b) {
    for (int i = 0; i < N; i++) a[i] *= b[i];
    return a;
  }
  friend constexpr Vec operator/(Vec a, const Vec& b) {
    for (int i = 0; i < N; i++) a[i] /= b[i];
    return a;
  }
  friend constexpr Vec operator*(Vec a, T s) {
    for (int i = 0; i < N; i++) a[i] *= s;
    return a;
  }
  friend constexpr Vec operator*(T s, Vec a) { return a * s; }
  friend constexpr Vec operator/(Vec a, T s) {
    for (int i = 0; i < N; i++) a[i] /= s;
    return a;
  }
  friend constexpr Vec operator-(Vec a) { return a * T(-1); }
};

using Vec2f = Vec<float, 2>;
using Vec3f = Vec<float, 3>;
using Vec4f = Vec<float, 4>;
using Vec3d = Vec<double, 3>;
using Vec3i = Vec<int, 3>;

template <typename T, int N>
constexpr T dot(const Vec<T, N>& a, const Vec<T, N>& b) {
  T sum = a[0] * b[0];
  for (int i = 1; i < N; i++) sum += a[i] * b[i];
  return sum;
}

template <typename T>
constexpr Vec<T, 3> cross(const Vec<T, 3>& a, const Vec<T, 3>& b) {
  return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
}

template <typename T, int N>
T length(const Vec<T, N>& a) {
  return std::sqrt(dot(a, a));
}

/// a scaled to length 1; a zero vector stays zero.
template <typename T, int N>
Vec<T, N> normalized(const Vec<T, N>& a) {
  const T l = length(a);
  return l > 0 ? a / l : a;
}

template <typename T, int N>
constexpr Vec<T, N> min(const Vec<T, N>& a, const Vec<T, N>& b) {
  Vec<T, N> r;
  for (int i = 0; i < N; i++) r[i] = std::min(a[i], b[i]);
  return r;
}

template <typename T, int N>
constexpr Vec<T, N> max(const Vec<T, N>& a, const Vec<T, N>& b) {
  Vec<T, N> r;
  for (int i = 0; i < N; i++) r[i] = std::max(a[i], b[i]);
  return r;
}

template <typename T, int N>
constexpr T max_component(const Vec<T, N>& a) {
  return *std::max_element(a.e.begin(), a.e.end());
}

template <typename T, int N>
bool is_finite(const Vec<T, N>& a) {
  return std::all_of(a.e.begin(), a.e.end(), [](T x) { return std::isfinite(x); });
}

/// An axis-aligned box; empty until it is extended.
struct Box3f {
  Vec3f lo = Vec3f::filled(std::numeric_limits<float>::infinity());
  Vec3f hi = Vec3f::filled(-std::numeric_limits<float>::infinity());

  void extend(const Vec3f& p) {
    lo = min(lo, p);
    hi = max(hi, p);
  }
  void extend(const Box3f& b) {
    lo = min(lo, b.lo);
    hi = max(hi, b.hi);
  }
  bool empty() const { return lo[0] > hi[0]; }
  bool operator==(const Box3f&) const = default;
  Vec3f size() const { return empty() ? Vec3f{} : hi - lo; }
  Vec3f center() const { return (lo + hi) * 0.5f; }
};

}  // namespace lightwell
