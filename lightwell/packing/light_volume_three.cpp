// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "lightwell/gltf/json.h"
#include "lightwell/light/atlas.h"
#include "lightwell/packing/light_volume.h"

namespace lightwell {

std::string three_light_probe_grid(const LightVolume& volume) {
  constexpr float scale = 4096;
  Json data = Json::array();
  for (const Moments& node : volume.nodes)
    for (const Vec3f& coefficient : spherical_harmonics(node))
      for (const float channel : coefficient.e) data.push_back(std::llround(channel * scale));
  const Vec3f size = volume.size();
  const Json json = {
      {"metadata", {{"version", 1}, {"type", "LightProbeGrid"}, {"generator", "Lightwell " LIGHTWELL_VERSION}}},
      {"width", size[0]},
      {"height", size[1]},
      {"depth", size[2]},
      {"resolution", volume.shape.nodes.e},
      {"position", volume.center().e},
      {"coefficients", {{"scale", static_cast<int>(scale)}, {"data", std::move(data)}}}};
  return json.dump();
}

}  // namespace lightwell
