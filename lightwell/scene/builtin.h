// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "lightwell/gltf/document.h"

namespace lightwell {

/// A scene that needs no file. All are in metres, closed, and made of Lambertian surfaces whose fronts face the lit
/// space; each has a camera "camera".
struct BuiltinScene {
  std::string_view name;
  std::string_view description;
  Document (*make)(uint64_t seed);  ///< the seed chooses the relief of the objects
};

const std::vector<BuiltinScene>& builtin_scenes();

/// The built-in scene of that name, null when there is none.
const BuiltinScene* find_builtin_scene(std::string_view name);

}  // namespace lightwell
