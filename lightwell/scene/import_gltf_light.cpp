// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/import_gltf_light.h"

#include <numbers>

namespace lightwell {
namespace {

constexpr double largest = 1e12;  ///< of intensities and lengths, so that products stay finite in floats

float clamped(double value, double most) { return static_cast<float>(std::clamp(value, 0.0, most)); }

Vec3f clamped(const Vec3d& value) {
  return {{clamped(value[0], largest), clamped(value[1], largest), clamped(value[2], largest)}};
}

const Json& node_of(const Json& document, int node) {
  return element(member(document, "nodes"), static_cast<size_t>(node));
}

/// The name of an element, or of the node that shows it.
std::string name_of(const Json& element, const Json& node) {
  const std::string name = text(element, "name");
  return name.empty() ? text(node, "name") : name;
}

std::optional<Lamp::Kind> kind_of(const std::string& type) {
  if (type == "point") return Lamp::Kind::point;
  if (type == "spot") return Lamp::Kind::spot;
  if (type == "directional") return Lamp::Kind::sun;
  return std::nullopt;
}

/// A side of a camera's picture; 0 where there is none, or one that no picture has.
int picture_side(const Json& extras, const char* key) {
  const int side = index_of(extras, key);
  return side <= largest_picture_side ? std::max(0, side) : 0;
}

}  // namespace

std::optional<Lamp> read_lamp(const Json& document, int node_index, const Transform& to_scene, Report& report) {
  const Json& node = node_of(document, node_index);
  const int index = index_of(extension(node, "KHR_lights_punctual"), "light");
  const Json& light = element(member(extension(document, "KHR_lights_punctual"), "lights"), static_cast<size_t>(index));
  if (index < 0 || !light.is_object()) return std::nullopt;
  const std::optional<Lamp::Kind> kind = kind_of(text(light, "type"));
  if (!kind) {
    report.warn(element_name("lights", static_cast<size_t>(index)) + ": type \"" + text(light, "type").substr(0, 40) +
                "\" is none of point, spot and directional; left out");
    return std::nullopt;
  }
  Lamp lamp;
  lamp.kind = *kind;
  lamp.name = name_of(light, node);
  lamp.position = to_scene.t.cast<float>();
  lamp.direction = normalized(-to_scene.z).cast<float>();
  lamp.intensity = clamped(numbers<3>(light, "color", Vec3d::filled(1)) * number(light, "intensity", 1));
  lamp.range = clamped(number(light, "range", 0), largest);
  const Json& spot = member(light, "spot");
  lamp.outer_cone = clamped(number(spot, "outerConeAngle", std::numbers::pi / 4), std::numbers::pi / 2);
  lamp.inner_cone = clamped(number(spot, "innerConeAngle", 0), lamp.outer_cone);
  lamp.node = node_index;
  if (max_component(lamp.intensity) <= 0) return std::nullopt;
  return lamp;
}

std::optional<Camera> read_camera(const Json& document, int node_index, const Transform& to_scene, Report& report) {
  const Json& node = node_of(document, node_index);
  const int index = index_of(node, "camera");
  if (index < 0) return std::nullopt;
  const Json& json = element(member(document, "cameras"), static_cast<size_t>(index));
  const Json& perspective = member(json, "perspective");
  if (!perspective.is_object()) {
    report.warn("cameras without perspective are left out");
    return std::nullopt;
  }
  Camera camera;
  camera.name = name_of(json, node);
  camera.to_scene.z = normalized(to_scene.z);
  camera.to_scene.x = normalized(cross(to_scene.y, camera.to_scene.z));
  camera.to_scene.y = cross(camera.to_scene.z, camera.to_scene.x);
  camera.to_scene.t = to_scene.t;
  camera.yfov = static_cast<float>(std::clamp(number(perspective, "yfov", 0.8), 1e-3, 3.1));
  camera.aspect = clamped(number(perspective, "aspectRatio", 0), 1e3);
  camera.width = picture_side(member(json, "extras"), "width");
  camera.height = picture_side(member(json, "extras"), "height");
  return camera;
}

}  // namespace lightwell
