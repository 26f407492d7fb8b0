// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/lamps.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

#include "lightwell/bake/shining_parts.h"

namespace lightwell {
namespace {

// A piece of emissive surface, in scene space.
struct Shape {
  struct Facet {
    Vec3d center;
    Vec3d normal;  // its length is the area
  };
  std::vector<Vec3d> points;  // three a facet
  std::vector<Facet> facets;
  double area = 0;
  Vec3d center{};  // of the area
  Vec3d normal_sum{};
};

Shape measure(const TraceScene& scene, const Luminaire& luminaire) {
  Shape shape;
  shape.center = luminaire.center.cast<double>();
  for (const uint32_t face : luminaire.faces) {
    const auto corners = scene.corners(static_cast<uint32_t>(luminaire.index), face);
    const Vec3d a = corners[0].cast<double>(), b = corners[1].cast<double>(), c = corners[2].cast<double>();
    const Vec3d front = scene.face_normal(static_cast<uint32_t>(luminaire.index), corners).cast<double>();
    shape.points.insert(shape.points.end(), {a, b, c});
    shape.facets.push_back({(a + b + c) / 3.0, front * (length(cross(b - a, c - a)) / 2)});
    shape.area += length(shape.facets.back().normal);
    shape.normal_sum += shape.facets.back().normal;
  }
  return shape;
}

double extent(const Shape& shape) {
  double largest = 0;
  for (const Vec3d& p : shape.points) largest = std::max(largest, length(p - shape.center));
  return largest;
}

// True when the surface lies in one plane and faces one way.
bool is_flat(const Shape& shape) {
  if (length(shape.normal_sum) < 0.999 * shape.area) return false;
  const Vec3d normal = normalized(shape.normal_sum);
  const double flat = 0.01 * extent(shape);
  return std::all_of(shape.points.begin(), shape.points.end(),
                     [&](const Vec3d& p) { return std::abs(dot(p - shape.center, normal)) <= flat; });
}

// The second moments of a surface's area about its centre, in the plane of two directions.
struct AreaMoments {
  double uu = 0, uv = 0, vv = 0;

  // How far from equal in all directions, 0 to 1.
  double difference() const { return std::hypot(uu - vv, 2 * uv) / (uu + vv); }
};

// A triangle adds area / 12 (a a' + b b' + c c' + (a + b + c)(a + b + c)').
AreaMoments second_moments(const Shape& shape, const Vec3d& u, const Vec3d& v) {
  AreaMoments sum;
  for (size_t i = 0; i < shape.facets.size(); i++) {
    const double weight = length(shape.facets[i].normal) / 12;
    const Vec3d a = shape.points[3 * i] - shape.center;
    const Vec3d b = shape.points[3 * i + 1] - shape.center;
    const Vec3d c = shape.points[3 * i + 2] - shape.center;
    for (const Vec3d& p : {a, b, c, a + b + c}) {
      const double along_u = dot(p, u), along_v = dot(p, v);
      sum.uu += weight * along_u * along_u;
      sum.uv += weight * along_u * along_v;
      sum.vv += weight * along_v * along_v;
    }
  }
  return sum;
}

// A direction perpendicular to one, after the axes of the scene.
Vec3d direction_across(const Vec3d& normal) {
  return normalized(cross(std::abs(normal[1]) < 0.9 ? Vec3d{{0, 1, 0}} : Vec3d{{1, 0, 0}}, normal));
}

// The direction of the largest second moment of a flat surface, in its plane.
Vec3d principal_axis(const Shape& shape, const Vec3d& normal) {
  const Vec3d u = direction_across(normal), v = cross(normal, u);
  const AreaMoments moments = second_moments(shape, u, v);
  // A square's moments are equal in all directions; the axes of the scene serve instead.
  const double angle = moments.difference() < 1e-3 ? 0 : std::atan2(2 * moments.uv, moments.uu - moments.vv) / 2;
  return u * std::cos(angle) + v * std::sin(angle);
}

double half_width(const Shape& shape, const Vec3d& direction) {
  double widest = 0;
  for (const Vec3d& p : shape.points) widest = std::max(widest, std::abs(dot(p - shape.center, direction)));
  return widest;
}

// A rectangle of the surface's area in its plane, along its principal axes; none when it is not flat.
std::optional<ClientLamp> as_rectangle(const Shape& shape) {
  if (!is_flat(shape)) return {};
  const Vec3d normal = normalized(shape.normal_sum);
  const Vec3d along = principal_axis(shape, normal), across = cross(normal, along);
  const double half_u = half_width(shape, along), half_v = half_width(shape, across);
  // The bounding rectangle may be larger: an ellipse covers pi/4 of it.
  const double shrink = std::sqrt(shape.area / std::max(4 * half_u * half_v, 1e-30));
  ClientLamp lamp;
  lamp.kind = ClientLamp::Kind::rectangle;
  lamp.normal = normal.cast<float>();
  lamp.half_u = (along * (half_u * shrink)).cast<float>();
  lamp.half_v = (across * (half_v * shrink)).cast<float>();
  return lamp;
}

// A disc of the surface's area in its plane; none when it is not flat, or no disc. Of all shapes of one area a disc has
// the smallest second moment, area^2 / (2 pi); a regular hexagon's is 0.8 % larger, a square's 4.7 %, that of a ring
// whose hole is a tenth as wide 2 %.
std::optional<ClientLamp> as_disc(const Shape& shape) {
  if (!is_flat(shape)) return {};
  const Vec3d normal = normalized(shape.normal_sum), u = direction_across(normal);
  const AreaMoments moments = second_moments(shape, u, cross(normal, u));
  const double least = shape.area * shape.area / (2 * std::numbers::pi);
  if (moments.uu + moments.vv > 1.01 * least || moments.difference() > 0.02) return {};
  ClientLamp lamp;
  lamp.kind = ClientLamp::Kind::disc;
  lamp.normal = normal.cast<float>();
  lamp.radius = static_cast<float>(std::sqrt(shape.area / std::numbers::pi));
  return lamp;
}

// A sphere of the surface's area. None when the surface is open, or when more than a tenth of it lies in planes less
// than half as far from the centre as its farthest point: a cube passes (0.58), a tube or a dome does not.
std::optional<ClientLamp> as_sphere(const Shape& shape) {
  if (length(shape.normal_sum) > 0.1 * shape.area) return {};
  const double farthest = extent(shape);
  double round = 0;
  for (const Shape::Facet& facet : shape.facets)
    if (dot(normalized(facet.normal), facet.center - shape.center) > farthest / 2) round += length(facet.normal);
  if (round < 0.9 * shape.area) return {};
  ClientLamp lamp;
  lamp.kind = ClientLamp::Kind::sphere;
  lamp.radius = static_cast<float>(std::sqrt(shape.area / (4 * std::numbers::pi)));
  return lamp;
}

// The parts of a textured rectangle that shine, each with its share of the power: at most `most`.
std::vector<ClientLamp> cut_to_what_shines(const TraceScene& scene, const Luminaire& luminaire, const ClientLamp& whole,
                                           size_t most) {
  std::vector<ClientLamp> lamps;
  const float both_sides = whole.two_sided ? 2.0f : 1.0f;
  for (const ShiningPart& part :
       shining_parts(scene, luminaire, normalized(whole.half_u), normalized(whole.half_v), most)) {
    ClientLamp& lamp = lamps.emplace_back(whole);
    lamp.center = part.center;
    lamp.half_u = normalized(whole.half_u) * part.half_size[0];
    lamp.half_v = normalized(whole.half_v) * part.half_size[1];
    lamp.radiance = part.radiance;
    lamp.power = mean_of_channels(part.radiance) * 4 * part.half_size[0] * part.half_size[1] * pi * both_sides;
  }
  return lamps;
}

std::vector<ClientLamp> describe_surface(const TraceScene& scene, const Luminaire& luminaire, size_t most) {
  const Shape shape = measure(scene, luminaire);
  const bool uniform = scene.is_uniform(static_cast<uint32_t>(luminaire.index));
  // What a texture makes shine is cut into rectangles.
  std::optional<ClientLamp> lamp = uniform ? as_disc(shape) : std::nullopt;
  if (!lamp) lamp = as_rectangle(shape);
  if (!lamp) lamp = as_sphere(shape);
  if (!lamp) return {};
  const Instance& instance = scene.scene().instances[static_cast<size_t>(luminaire.index)];
  const Primitive& primitive = scene.scene().primitives[static_cast<size_t>(instance.primitive)];
  lamp->name = scene.scene().material_of(primitive).name;
  lamp->center = luminaire.center;
  lamp->two_sided = luminaire.double_sided && lamp->kind != ClientLamp::Kind::sphere;
  // A double-sided surface emits half of its power on each side; the inside of a sphere is never seen.
  lamp->radiance = luminaire.power / (pi * luminaire.area * (luminaire.double_sided ? 2.0f : 1.0f));
  lamp->power = mean_of_channels(luminaire.power);
  lamp->luminaire = luminaire.id;
  if (uniform || lamp->kind == ClientLamp::Kind::sphere) return {*lamp};
  return cut_to_what_shines(scene, luminaire, *lamp, most);
}

// The lamps that stand for a luminaire, at most `most`; none where no simple shape does.
std::vector<ClientLamp> describe(const TraceScene& scene, const Luminaire& luminaire, size_t most) {
  switch (luminaire.kind()) {
    case Luminaire::Kind::lamp: {
      ClientLamp lamp = describe_lamp(scene.scene().lamps[static_cast<size_t>(luminaire.index)]);
      lamp.luminaire = luminaire.id;
      lamp.power = mean_of_channels(luminaire.power);
      return {std::move(lamp)};
    }
    case Luminaire::Kind::surface: return describe_surface(scene, luminaire, most);
    case Luminaire::Kind::environment: break;
  }
  return {};
}

}  // namespace

LampPlan plan_lamps(const World& world, size_t most) {
  const std::vector<Luminaire>& luminaires = world.lights().luminaires();
  std::vector<size_t> by_power(luminaires.size());
  std::iota(by_power.begin(), by_power.end(), size_t(0));
  std::stable_sort(by_power.begin(), by_power.end(), [&](size_t a, size_t b) {
    return mean_of_channels(luminaires[a].power) > mean_of_channels(luminaires[b].power);
  });
  LampPlan plan{{}, LuminaireSet::all(luminaires.size())};
  for (const size_t i : by_power) {
    const float power = mean_of_channels(luminaires[i].power);
    if (plan.client.size() == most || !(power > 0)) break;
    std::vector<ClientLamp> lamps = describe(world.surfaces(), luminaires[i], most - plan.client.size());
    if (lamps.empty()) continue;
    std::move(lamps.begin(), lamps.end(), std::back_inserter(plan.client));
    plan.contained.erase(static_cast<int>(i));
  }
  std::stable_sort(plan.client.begin(), plan.client.end(),
                   [](const ClientLamp& a, const ClientLamp& b) { return a.power > b.power; });
  return plan;
}

}  // namespace lightwell
