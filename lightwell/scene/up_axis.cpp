// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/up_axis.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lightwell {
namespace {

// How much evidence is enough, chosen so that none of the scenes of ../shared is mistaken (tests/shared_data.sh).
constexpr float lower_than_deep = 0.9f;        ///< z extent by y extent: rooms and grounds have less
constexpr double along_an_axis = 0.8;          ///< cosine of a camera's up, or of the lamps' mean direction
constexpr double most_scattered = 0.5;         ///< of what lamps give, the share that cancels out
constexpr double floor_share = 0.5;            ///< of the box's cross-section
constexpr double most_ceiling = 0.1;           ///< the same
constexpr double most_difference = 0.5;        ///< the same of y, between what closes its ends: floor and no ceiling
constexpr double wall_share = 0.2;             ///< area of walls by that of the floor
constexpr float longest_furniture = 3;         ///< metres; what is longer along x and y has rooms
constexpr float longest_building = 1000;       ///< metres; what is longer is in another unit
constexpr float longest_relief = 100;          ///< metres; what is longer is a terrain
constexpr float flattest_terrain = 0.25f;      ///< z extent by the others
constexpr double terrain_share = 0.7;          ///< of the area, what is seen along z
constexpr float at_an_end = 0.01f;             ///< of the extent
constexpr double level = 0.99, upright = 0.1;  ///< least and most cosine between a normal and z

/// Sums over the faces of a scene; areas in m2.
struct FaceSums {
  double area = 0, along_z = 0;              ///< along_z: projected
  double walls = 0;                          ///< upright faces
  std::array<double, 2> z_ends{}, y_ends{};  ///< faces that close the lower and upper end of an axis
  Vec3d emitted{};                           ///< flux by direction
  double flux = 0;
};

/// Adds the area of a face across an axis to the end of the box where it lies, if it does.
void add_to_end(const std::array<Vec3f, 3>& corners, double area, int axis, const Box3f& box,
                std::array<double, 2>& ends) {
  const float tolerance = at_an_end * box.size()[axis];
  for (size_t upper = 0; upper < 2; upper++) {
    const float end = upper ? box.hi[axis] : box.lo[axis];
    if (std::all_of(corners.begin(), corners.end(),
                    [&](const Vec3f& p) { return std::abs(p[axis] - end) <= tolerance; }))
      ends[upper] += area;
  }
}

void add(const std::array<Vec3f, 3>& corners, const Material& material, const Box3f& box, FaceSums& sums) {
  const Vec3d normal = cross((corners[1] - corners[0]).cast<double>(), (corners[2] - corners[0]).cast<double>()) * 0.5;
  const double area = length(normal);
  if (!(area > 0)) return;
  sums.area += area;
  sums.along_z += std::abs(normal[2]);
  if (std::abs(normal[2]) < upright * area) sums.walls += area;
  if (std::abs(normal[2]) > level * area) add_to_end(corners, area, 2, box, sums.z_ends);
  if (std::abs(normal[1]) > level * area) add_to_end(corners, area, 1, box, sums.y_ends);
  const double radiance = max_component(material.emission);
  sums.emitted += normal * radiance;
  sums.flux += area * radiance;
}

FaceSums sum_faces(const Scene& scene, const Box3f& box) {
  FaceSums sums;
  for (const Instance& instance : scene.instances) {
    const Primitive& primitive = scene.primitives[static_cast<size_t>(instance.primitive)];
    const Material& material = scene.material_of(primitive);
    const bool mirrored = instance.to_scene.determinant() < 0;
    for (const Face& face : primitive.mesh.faces) {
      std::array<Vec3f, 3> corners;
      for (size_t i = 0; i < 3; i++) corners[i] = instance.to_scene.point(primitive.mesh.positions[face[i]]);
      if (mirrored) std::swap(corners[1], corners[2]);
      add(corners, material, box, sums);
    }
  }
  return sums;
}

bool shines_down_z(const FaceSums& sums) {
  const double all = length(sums.emitted);
  return all > most_scattered * sums.flux && -sums.emitted[2] > along_an_axis * all;
}

/// Rooms without a ceiling. Of an open shelf only the size tells it from them.
bool has_rooms_on_z(const FaceSums& sums, const Vec3f& size) {
  if (std::min(size[0], size[1]) < longest_furniture || std::max(size[0], size[1]) > longest_building) return false;
  const double across_z = double(size[0]) * size[1], across_y = double(size[0]) * size[2];
  return sums.z_ends[0] > floor_share * across_z && sums.z_ends[1] < most_ceiling * across_z &&
         std::abs(sums.y_ends[0] - sums.y_ends[1]) < most_difference * across_y &&
         sums.walls > wall_share * sums.z_ends[0];
}

bool is_terrain_in_z(const FaceSums& sums, const Vec3f& size) {
  return std::max(size[0], size[1]) > longest_relief && size[2] < flattest_terrain * std::min(size[0], size[1]) &&
         sums.along_z > terrain_share * sums.area;
}

}  // namespace

bool seems_z_up(const Scene& scene) {
  if (!scene.cameras.empty())
    return std::all_of(scene.cameras.begin(), scene.cameras.end(),
                       [](const Camera& camera) { return normalized(camera.to_scene.y)[2] > along_an_axis; });
  const Box3f box = scene.bounds();
  const Vec3f size = box.size();
  if (!(size[2] > 0) || size[2] > lower_than_deep * size[1]) return false;
  const FaceSums sums = sum_faces(scene, box);
  return shines_down_z(sums) || has_rooms_on_z(sums, size) || is_terrain_in_z(sums, size);
}

}  // namespace lightwell
