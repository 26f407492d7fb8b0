// SPDX-License-Identifier: Apache-2.0
#include "lightwell/light/light_field.h"

#include <algorithm>
#include <cstddef>

namespace lightwell {
namespace {

bool holds_point(const GridShape& shape, const Vec3f& point) { return max(shape.lo, min(point, shape.hi())) == point; }

}  // namespace

LightField::LightField(std::vector<Layer> layers) : layers_(std::move(layers)) {
  std::stable_sort(layers_.begin(), layers_.end(),
                   [](const Layer& a, const Layer& b) { return a.priority > b.priority; });
}

Vec3f LightField::irradiance(const Vec3f& point, const Vec3f& offset_normal, const Vec3f& direction) const {
  Vec3f sum{};
  for (size_t i = 0; i < layers_.size(); i++) {
    const auto alike = [&](const Layer& layer) { return layer.contents == layers_[i].contents; };
    // Layers of the same contents are looked up together, once, at the first of them.
    if (std::any_of(layers_.begin(), layers_.begin() + static_cast<std::ptrdiff_t>(i), alike)) continue;
    const Layer* answering = nullptr;
    for (size_t j = i; j < layers_.size(); j++) {
      if (!alike(layers_[j])) continue;
      answering = &layers_[j];
      if (holds_point(answering->grid.shape, point)) break;
    }
    sum += answering->grid.irradiance(point, offset_normal, direction);
  }
  return sum;
}

}  // namespace lightwell
