// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "lightwell/trace/material.h"
#include "tests/trace/scenes.h"

namespace lightwell {

struct NamedBsdf {
  std::string name;
  Bsdf bsdf;
  bool white = false;  ///< reflects all that arrives
};

inline Bsdf bsdf_of(const Material& material) { return surface_of(material, {}, {}, Vec4f::filled(1)).bsdf; }

/// Every kind of BSDF that materials have: diffuse, with gloss of common and strong reflectance, metal and mixtures,
/// smooth and rough, white and coloured.
inline std::vector<NamedBsdf> all_bsdfs(const std::vector<float>& roughnesses) {
  std::vector<NamedBsdf> all;
  for (const bool white : {true, false}) {
    const Vec3f color = white ? Vec3f::filled(1) : Vec3f{{0.9f, 0.5f, 0.1f}};
    const std::string shade = white ? "white " : "coloured ";
    all.push_back({shade + "diffuse", Bsdf::lambertian(color), white});
    for (const float roughness : roughnesses) {
      const auto add = [&](const char* kind, float metallic, float ior, const Vec3f& specular) {
        Material material = lambertian(color);
        material.metallic = metallic;
        material.roughness = roughness;
        material.specular = 1;
        material.ior = ior;
        material.specular_color = specular;
        all.push_back({shade + kind + " of roughness " + std::to_string(roughness), bsdf_of(material), white});
      };
      add("plastic", 0, 1.5f, Vec3f::filled(1));
      if (white) add("diamond", 0, 2.4f, Vec3f::filled(1));
      if (!white) add("tinted gloss", 0, 2.4f, {{0.2f, 0.6f, 1}});
      add("mixture", 0.5f, 1.5f, Vec3f::filled(1));
      add("metal", 1, 1.5f, Vec3f::filled(1));
    }
  }
  return all;
}

/// A direction in the plane of x and y at an angle to y, in degrees.
inline Vec3f tilted(float degrees) {
  const float angle = degrees * pi / 180;
  return {{std::sin(angle), std::cos(angle), 0}};
}

}  // namespace lightwell
