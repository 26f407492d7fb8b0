// SPDX-License-Identifier: Apache-2.0
#include "lightwell/render/overview.h"

#include "lightwell/render/camera.h"
#include "lightwell/scene/camera.h"
#include "lightwell/trace/sampling.h"

namespace lightwell {
namespace {

constexpr int lattice = 7;        // points on an axis
constexpr int sight_lines = 256;  // from a point, in all directions
constexpr int headings = 16;
constexpr Vec<int, 2> view_rays{{12, 9}};
constexpr float view_aspect = 4.0f / 3;
/// The share of an enclosed point's sight lines that may leave the scene or end inside a solid, since doors and cracks
/// let some pass.
constexpr float most_strays = 0.03f;
/// The share of a point's sight lines that must end on fronts for it to be within something, open or not.
constexpr float least_fronts_within = 0.75f;
/// The shares of these points and of all points that must be enclosed for the scene to be: a stage open to the front
/// has enclosed corners, too, and a statue has hollows.
constexpr float least_enclosed = 0.15f, least_enclosed_of_all = 0.03f;

/// The centres of the cells into which a lattice divides a box.
std::vector<Vec3f> lattice_points(const Box3f& box) {
  std::vector<Vec3f> points;
  for (int i = 0; i < lattice * lattice * lattice; i++) {
    const Vec3f part = Vec3i{{i % lattice, i / lattice % lattice, i / lattice / lattice}}.cast<float>();
    points.push_back(box.lo + box.size() * ((part + Vec3f::filled(0.5f)) / static_cast<float>(lattice)));
  }
  return points;
}

/// Whether a sample of the luminaires reaches a surface.
bool is_lit(const World& world, const Hit& hit, Random& random) {
  if (world.lights().dark()) return true;
  const Arrival arrival = world.lights().sample(hit.position, random);
  const Vec3f normal = hit.facing_normal();
  return dot(normal, arrival.direction) > 0 && max_component(arrival.radiance) > 0 &&
         max_component(visibility(world.surfaces(), hit.position, normal, arrival, random)) > 0;
}

/// The share of a point's sight lines that end on the front of a surface, not on a back or nowhere. Backs of surfaces
/// with two sides are fronts where light reaches them, as in a room, and not in the dark inside of a solid.
float share_of_fronts(const World& world, const Vec3f& point) {
  constexpr int lit_of_backs = 10;  // one of so many
  Random random(0, 0);
  int fronts = 0, backs = 0, lit = 0;
  for (int i = 0; i < sight_lines; i++) {
    Hit hit;
    if (!world.surfaces().intersect({point, sample_sphere(random)}, random, hit)) continue;
    fronts += hit.front;
    if (hit.front || !world.surfaces().material(hit.instance).double_sided) continue;
    backs++;
    lit += is_lit(world, hit, random);
  }
  if (!world.lights().dark() && lit_of_backs * lit >= backs) fronts += backs;
  return static_cast<float>(fronts) / sight_lines;
}

/// A level camera at a point.
Camera level_camera(const Vec3f& eye, int heading) {
  const double angle = 2 * static_cast<double>(pi) * heading / headings;
  Camera camera;
  camera.name = "overview";
  camera.yfov = 1;
  camera.to_scene = looking_at(eye.cast<double>(), eye.cast<double>() + Vec3d{{std::sin(angle), 0, -std::cos(angle)}});
  return camera;
}

/// The sum of the logarithms of the distances that a camera's rays go, each at least `nothing`; a ray that leaves the
/// scene counts as `nothing`, one that ends in the dark as a tenth.
float depth_of_view(const World& world, const Camera& camera, float nothing) {
  constexpr float worth_of_dark = 0.1f;
  Random random(0, 0);
  float sum = 0;
  for (int y = 0; y < view_rays[1]; y++)
    for (int x = 0; x < view_rays[0]; x++) {
      const float u = (static_cast<float>(x) + 0.5f) / static_cast<float>(view_rays[0]);
      const float v = (static_cast<float>(y) + 0.5f) / static_cast<float>(view_rays[1]);
      Hit hit;
      float distance = 0;
      if (world.surfaces().intersect(camera_ray(camera, view_aspect, u, v), random, hit))
        distance = hit.distance * (is_lit(world, hit, random) ? 1 : worth_of_dark);
      sum += std::log(std::max(distance, nothing));
    }
  return sum;
}

Camera view_from_within(const World& world, const std::vector<Vec3f>& eyes) {
  const float nothing = 1e-3f * length(world.surfaces().focus().size());
  Camera best;
  float farthest = -std::numeric_limits<float>::infinity();
  for (const Vec3f& eye : eyes)
    for (int heading = 0; heading < headings; heading++) {
      const Camera camera = level_camera(eye, heading);
      const float depth = depth_of_view(world, camera, nothing);
      if (depth <= farthest) continue;
      farthest = depth;
      best = camera;
    }
  return best;
}

/// The nearest camera in front of a box that shows all of it in a square picture, with a margin.
Camera view_from_outside(const Box3f& box) {
  constexpr double margin = 1.1;
  const Vec3d back = normalized(Vec3d{{0, 0.2, 1}});
  const Vec3d center = box.center().cast<double>();
  Camera camera;
  camera.name = "overview";
  const Transform turn = looking_at(center, center - back);
  const double slope = std::tan(static_cast<double>(camera.yfov) / 2) / margin;
  double distance = 1e-6;
  for (int i = 0; i < 8; i++) {
    const Vec3d corner =
        Vec3f{{i & 1 ? box.hi[0] : box.lo[0], i & 2 ? box.hi[1] : box.lo[1], i & 4 ? box.hi[2] : box.lo[2]}}
            .cast<double>() -
        center;
    const double aside = std::max(std::abs(dot(corner, turn.x)), std::abs(dot(corner, turn.y)));
    distance = std::max(distance, dot(corner, back) + aside / slope);
  }
  camera.to_scene = looking_at(center + back * distance, center);
  return camera;
}

}  // namespace

Camera overview_camera(const World& world) {
  const TraceScene& scene = world.surfaces();
  std::vector<Vec3f> enclosed;
  const std::vector<Vec3f> points = lattice_points(scene.focus());
  float within = 0;
  for (const Vec3f& point : points) {
    const float fronts = share_of_fronts(world, point);
    within += fronts >= least_fronts_within;
    if (fronts >= 1 - most_strays) enclosed.push_back(point);
  }
  const float least = std::max(least_enclosed * within, least_enclosed_of_all * static_cast<float>(points.size()));
  const bool inside = static_cast<float>(enclosed.size()) >= least;
  return inside ? view_from_within(world, enclosed) : view_from_outside(scene.focus());
}

}  // namespace lightwell
