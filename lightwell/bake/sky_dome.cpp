// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/sky_dome.h"

#include <algorithm>

#include "lightwell/bake/mesh_name.h"
#include "lightwell/scene/sky_map.h"
#include "lightwell/trace/trace_scene.h"

namespace lightwell {
namespace {

/// Of a dome's size: what is larger is ground.
constexpr float largest_object = 0.5f;
/// How far away a dome is at least, in half diagonals of all that stands in it: closer walls are walls.
constexpr float least_distance = 2;
/// Of all directions: a hemisphere has half of them.
constexpr float least_coverage = 0.4f;
/// Of the map of what it shows, pixels.
constexpr int map_width = 512, map_height = map_width / 2;

bool shines(const Material& material) { return material.unlit || max_component(material.emission) > 0; }

const Material& material_of(const Scene& scene, const Instance& instance) {
  return scene.material_of(scene.primitives[static_cast<size_t>(instance.primitive)]);
}

/// The boxes of all instances, each that of its primitive's box.
std::vector<Box3f> boxes_of(const Scene& scene) {
  std::vector<Box3f> of_primitives, boxes;
  for (const Primitive& primitive : scene.primitives) of_primitives.push_back(primitive.mesh.bounds());
  for (const Instance& instance : scene.instances) {
    const Box3f& own = of_primitives[static_cast<size_t>(instance.primitive)];
    Box3f& box = boxes.emplace_back();
    for (int corner = 0; corner < 8 && !own.empty(); corner++) {
      Vec3f place;
      for (int axis = 0; axis < 3; axis++) place[axis] = (corner >> axis & 1 ? own.hi : own.lo)[axis];
      box.extend(instance.to_scene.point(place));
    }
  }
  return boxes;
}

/// Instances that may be domes, and the box of what stands in them.
struct Candidates {
  explicit Candidates(const Scene& scene) {
    const auto may_be_dome = [&](size_t i) { return shines(material_of(scene, scene.instances[i])); };
    const std::vector<Box3f> boxes = boxes_of(scene);
    Box3f shining;
    for (size_t i = 0; i < boxes.size(); i++)
      if (may_be_dome(i)) shining.extend(boxes[i]);
    const float large = shining.empty() ? 0 : largest_object * length(shining.size());
    for (size_t i = 0; i < boxes.size(); i++) {
      if (boxes[i].empty()) continue;
      if (length(boxes[i].size()) <= large)
        objects.extend(boxes[i]);
      else if (may_be_dome(i))
        instances.push_back(static_cast<uint32_t>(i));
    }
  }

  std::vector<uint32_t> instances;
  Box3f objects;
};

/// A scene of some instances alone.
Scene scene_of(const Scene& scene, const std::vector<uint32_t>& instances) {
  Scene part;
  part.materials = scene.materials;
  part.images = scene.images;
  for (const uint32_t i : instances) {
    const Instance& instance = scene.instances[i];
    part.instances.push_back({static_cast<int>(part.primitives.size()), instance.to_scene, instance.node});
    part.primitives.push_back(scene.primitives[static_cast<size_t>(instance.primitive)]);
  }
  return part;
}

/// What a dome shows from a place.
struct View {
  std::shared_ptr<RadianceImage> map;
  float coverage = 0;  ///< of all directions
  float nearest = std::numeric_limits<float>::infinity();
};

View look_around(const TraceScene& dome, const Vec3f& from) {
  View view{.map = std::make_shared<RadianceImage>(RadianceImage{map_width, map_height, {}})};
  RadianceImage& map = *view.map;
  map.pixels.resize(3 * size_t(map_width) * map_height);
  Random random(1, 0);
  for (size_t pixel = 0; pixel < map.pixels.size() / 3; pixel++) {
    Hit hit;
    const Vec3f direction = pixel_direction(map, pixel);
    if (!dome.intersect({from, direction}, random, hit)) continue;
    view.coverage += solid_angle(static_cast<int>(pixel / map_width), map) / (4 * std::numbers::pi_v<float>);
    view.nearest = std::min(view.nearest, hit.distance);
    const Surface surface = dome.surface(hit);
    // What is unlit is shown as it is.
    const Vec3f radiance = dome.material(hit.instance).unlit ? surface.bsdf.diffuse : dome.emission(hit, surface);
    std::copy(radiance.e.begin(), radiance.e.end(), map.pixels.begin() + static_cast<ptrdiff_t>(3 * pixel));
  }
  return view;
}

}  // namespace

Result<void> take_sky_dome(Scene& scene, Report& report) {
  if (std::ranges::none_of(scene.materials, shines)) return {};
  const Candidates candidates(scene);
  if (candidates.instances.empty() || candidates.objects.empty()) return {};
  const Scene dome = scene_of(scene, candidates.instances);
  LW_TRY(traced, TraceScene::build(dome));
  const View view = look_around(*traced, candidates.objects.center());
  const float radius = length(candidates.objects.size()) / 2;
  if (view.coverage < least_coverage || view.nearest < least_distance * radius) return {};
  const std::string name =
      mesh_name(scene, scene.primitives[static_cast<size_t>(scene.instances[candidates.instances.front()].primitive)]);
  const bool dark = scene.environment.map == nullptr && max_component(scene.environment.radiance) <= 0;
  report.warn(name + " stands around everything and is taken for the sky" +
              (dark ? "" : ", whose light is that of the environment"));
  if (dark) scene.environment = {Vec3f::filled(1), view.map};
  for (size_t i = candidates.instances.size(); i > 0; i--)
    scene.instances.erase(scene.instances.begin() + candidates.instances[i - 1]);
  return {};
}

}  // namespace lightwell
