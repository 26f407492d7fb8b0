// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/lamps.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "lightwell/texture/transfer.h"

namespace lightwell {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

float mean(const Vec3f& color) { return (color[0] + color[1] + color[2]) / 3; }

// The mean of an emission texture in linear light; white without one.
Vec3f mean_of_texture(const Scene& scene, const TextureLookup& lookup) {
  if (lookup.image < 0) return Vec3f::filled(1);
  const Image& image = scene.images[static_cast<size_t>(lookup.image)];
  const auto channels = static_cast<size_t>(image.channels);
  const size_t count = image.pixels.size() / channels;
  Vec3d sum{};
  for (size_t i = 0; i < count; i++)
    for (size_t c = 0; c < 3; c++) {
      const uint8_t value = image.pixels[i * channels + (channels >= 3 ? c : 0)];
      sum[static_cast<int>(c)] += static_cast<double>(srgb_to_linear(static_cast<float>(value) / 255));
    }
  return (sum / static_cast<double>(std::max<size_t>(count, 1))).cast<float>();
}

// The shape of an emissive surface, in scene space.
struct Surface {
  double area = 0;
  Vec3d center{};        // of its area
  Vec3d normal_sum{};    // area-weighted
  std::vector<Vec3d> points;
  std::vector<std::array<Vec3d, 2>> facets;  // centre, normal times area
};

Surface measure(const Scene& scene, const Instance& instance) {
  const Mesh& mesh = scene.primitives[static_cast<size_t>(instance.primitive)].mesh;
  Surface surface;
  for (const Vec3f& p : mesh.positions) surface.points.push_back(instance.to_scene.point(p.cast<double>()));
  const double side = instance.to_scene.determinant() < 0 ? -0.5 : 0.5;  // a mirrored triangle is wound the other way
  for (const Face& face : mesh.faces) {
    const Vec3d &a = surface.points[face[0]], &b = surface.points[face[1]], &c = surface.points[face[2]];
    const Vec3d normal = cross(b - a, c - a) * side;
    const Vec3d center = (a + b + c) / 3.0;
    const double area = length(normal);
    surface.area += area;
    surface.center += center * area;
    surface.normal_sum += normal;
    surface.facets.push_back({center, normal});
  }
  if (surface.area > 0) surface.center = surface.center / surface.area;
  return surface;
}

double extent(const Surface& surface) {
  double largest = 0;
  for (const Vec3d& p : surface.points) largest = std::max(largest, length(p - surface.center));
  return largest;
}

// The rectangle of the surface's own area in its plane, along its principal axes; none when it is not flat.
std::optional<ClientLamp> as_rectangle(const Surface& surface) {
  const Vec3d normal = normalized(surface.normal_sum);
  const double flat = 0.01 * extent(surface);
  if (length(surface.normal_sum) < 0.999 * surface.area) return {};
  for (const Vec3d& p : surface.points)
    if (std::abs(dot(p - surface.center, normal)) > flat) return {};

  const Vec3d helper = std::abs(normal[1]) < 0.9 ? Vec3d{{0, 1, 0}} : Vec3d{{1, 0, 0}};
  const Vec3d u = normalized(cross(helper, normal)), v = cross(normal, u);
  double uu = 0, uv = 0, vv = 0;
  for (const Vec3d& p : surface.points) {
    const double a = dot(p - surface.center, u), b = dot(p - surface.center, v);
    uu += a * a, uv += a * b, vv += b * b;
  }
  // A square's second moments are the same in all directions: any axes in the plane are principal, so take the edges'.
  const bool round = std::hypot(uu - vv, 2 * uv) < 1e-3 * (uu + vv);
  const double angle = round ? 0 : std::atan2(2 * uv, uu - vv) / 2;
  const Vec3d along = u * std::cos(angle) + v * std::sin(angle), across = cross(normal, along);
  double half_u = 0, half_v = 0;
  for (const Vec3d& p : surface.points) {
    half_u = std::max(half_u, std::abs(dot(p - surface.center, along)));
    half_v = std::max(half_v, std::abs(dot(p - surface.center, across)));
  }
  const double shrink = std::sqrt(surface.area / std::max(4 * half_u * half_v, 1e-30));  // a disc covers pi/4 of its square

  ClientLamp lamp;
  lamp.kind = ClientLamp::Kind::rectangle;
  lamp.normal = normal.cast<float>();
  lamp.half_u = (along * (half_u * shrink)).cast<float>();
  lamp.half_v = (across * (half_v * shrink)).cast<float>();
  return lamp;
}

// The sphere of the surface's own area; none when more than a tenth of it does not look away from the centre.
std::optional<ClientLamp> as_sphere(const Surface& surface) {
  double outward = 0;
  for (const auto& [center, normal] : surface.facets)
    if (dot(normal, center - surface.center) > 0) outward += length(normal);
  if (outward < 0.9 * surface.area) return {};
  ClientLamp lamp;
  lamp.kind = ClientLamp::Kind::sphere;
  lamp.radius = static_cast<float>(std::sqrt(surface.area / (4 * std::numbers::pi)));
  return lamp;
}

std::optional<ClientLamp> describe(const Scene& scene, int index) {
  const Instance& instance = scene.instances[static_cast<size_t>(index)];
  const Material& material = scene.material_of(scene.primitives[static_cast<size_t>(instance.primitive)]);
  const Surface surface = measure(scene, instance);
  if (!(surface.area > 0)) return {};
  std::optional<ClientLamp> lamp = as_rectangle(surface);
  if (!lamp) lamp = as_sphere(surface);
  if (!lamp) return {};
  lamp->center = surface.center.cast<float>();
  lamp->radiance = material.emission * mean_of_texture(scene, material.emission_texture);
  lamp->two_sided = material.double_sided && lamp->kind == ClientLamp::Kind::rectangle;
  lamp->power = mean(lamp->radiance) * pi * static_cast<float>(surface.area) * (lamp->two_sided ? 2.0f : 1.0f);
  lamp->name = material.name;
  lamp->instance = index;
  lamp->node = instance.node;
  return lamp;
}

ClientLamp describe(const Lamp& source, int index, float scene_radius) {
  ClientLamp lamp;
  lamp.name = source.name;
  lamp.center = source.position;
  lamp.normal = source.direction;
  lamp.intensity = source.intensity;
  lamp.range = source.range;
  lamp.inner_cone = source.inner_cone;
  lamp.outer_cone = source.outer_cone;
  lamp.lamp = index;
  lamp.node = source.node;
  switch (source.kind) {
    case Lamp::Kind::point:
      lamp.kind = ClientLamp::Kind::point;
      lamp.power = mean(source.intensity) * 4 * pi;
      break;
    case Lamp::Kind::spot:
      lamp.kind = ClientLamp::Kind::spot;
      lamp.power = mean(source.intensity) * 2 * pi * (1 - std::cos(source.outer_cone));
      break;
    case Lamp::Kind::sun:
      lamp.kind = ClientLamp::Kind::sun;
      lamp.power = mean(source.intensity) * pi * scene_radius * scene_radius;
      break;
  }
  return lamp;
}

}  // namespace

LampPlan plan_lamps(const Scene& scene, size_t most) {
  LampPlan plan;
  for (size_t i = 0; i < scene.instances.size(); i++) {
    const Primitive& primitive = scene.primitives[static_cast<size_t>(scene.instances[i].primitive)];
    if (primitive.deforming || max_component(scene.material_of(primitive).emission) <= 0) continue;
    if (auto lamp = describe(scene, static_cast<int>(i))) plan.client.push_back(std::move(*lamp));
    else plan.grid_instances.push_back(static_cast<int>(i));
  }
  const float radius = length(scene.bounds().size()) / 2;
  for (size_t i = 0; i < scene.lamps.size(); i++) plan.client.push_back(describe(scene.lamps[i], static_cast<int>(i), radius));

  std::stable_sort(plan.client.begin(), plan.client.end(),
                   [](const ClientLamp& a, const ClientLamp& b) { return a.power > b.power; });
  for (; plan.client.size() > most; plan.client.pop_back()) {
    const ClientLamp& weakest = plan.client.back();
    if (weakest.instance >= 0) plan.grid_instances.push_back(weakest.instance);
    else plan.grid_lamps.push_back(weakest.lamp);
  }
  return plan;
}

}  // namespace lightwell
