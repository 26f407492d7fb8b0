// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/surface_sampler.h"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/trace/chi_square.h"
#include "tests/trace/scenes.h"

namespace lightwell {
namespace {

constexpr int samples = 100000;
const Box3f everywhere{Vec3f::filled(-100), Vec3f::filled(100)};

/// The barycentric coordinates of the second and third corner of a point of a triangle's plane.
Vec2f barycentric(const std::array<Vec3f, 3>& corners, const Vec3f& point) {
  const Vec3f u = corners[1] - corners[0], v = corners[2] - corners[0], normal = cross(u, v), p = point - corners[0];
  const float square = dot(normal, normal);
  return {{dot(cross(p, v), normal) / square, dot(cross(u, p), normal) / square}};
}

/// A fan of triangles, of which the largest has 40 times the area of the smallest.
Mesh fan() {
  Mesh mesh;
  mesh.positions = {{{0, 0, 0}}};
  for (int i = 0; i <= 12; i++) {
    mesh.positions.push_back({{std::pow(1.4f, static_cast<float>(i)) - 1, 0, 1}});
    if (i > 0) mesh.faces.push_back({0, static_cast<uint32_t>(i), static_cast<uint32_t>(i + 1)});
  }
  return mesh;
}

// Faces of unlike areas, of a mesh that is placed four times, stretched, mirrored, turned and enlarged: each by its
// area in the scene. Four strips of a face along one side, of 7, 5, 3 and 1 sixteenths of its area, tell that it is
// sampled evenly.
TEST(SurfaceSampler, ChoosesPointsByArea) {
  Scene scene = scene_of(fan(), lambertian(0.5f));
  const auto place = [&](Transform to_scene) { scene.instances.push_back({0, to_scene, -1}); };
  place(Transform::translation(Vec3d{{0, 5, 0}}) * Transform::scaling(Vec3d{{0.5, 1, 3}}));
  place(Transform::translation(Vec3d{{0, -5, 0}}) * Transform::scaling(Vec3d{{-1, 1, 1}}));
  place(Transform::translation(Vec3d{{0, -9, 0}}) * Transform::rotation({{0.6, 0, 0, 0.8}}) *
        Transform::scaling(Vec3d::filled(1.5)));
  add(scene, quad({{-1, 9, -1}}, {{0, 1, 2}}, {{2, 0, 1}}), lambertian(0.5f));
  const auto surfaces = traced(scene);

  constexpr size_t strips = 4;
  std::vector<std::array<Vec3f, 3>> faces;
  std::vector<uint32_t> instances;
  std::vector<double> shares;
  double all = 0;
  for (uint32_t i = 0; i < scene.instances.size(); i++) {
    for (uint32_t face = 0; face < surfaces->mesh(i).faces.size(); face++) {
      faces.push_back(surfaces->corners(i, face));
      instances.push_back(i);
      const auto& [a, b, c] = faces.back();
      const double area = static_cast<double>(length(cross(b - a, c - a))) / 2;
      for (size_t strip = 0; strip < strips; strip++)
        shares.push_back(area * (7 - 2 * static_cast<double>(strip)) / 16);
      all += area;
    }
  }
  for (double& share : shares) share /= all;

  const SurfaceSampler sampler(*surfaces, everywhere);
  std::vector<int> counts(shares.size());
  Random random(1, 0);
  for (int i = 0; i < samples; i++) {
    const SurfacePoint point = sampler.sample(random);
    const Vec3f on_surface = (point.position + point.behind) / 2.0f;
    for (size_t face = 0; face < faces.size(); face++) {
      const Vec2f b = barycentric(faces[face], on_surface);
      if (instances[face] != point.instance || b[0] < 0 || b[1] < 0 || b[0] + b[1] >= 1) continue;
      counts[strips * face + static_cast<size_t>(b[0] * strips)]++;
      ASSERT_EQ(point.normal, surfaces->face_normal(point.instance, faces[face]));
      ASSERT_GT(dot(point.position - point.behind, point.normal), 0);
      break;
    }
  }
  // Coordinates of up to 60 m are rounded by 4e-6: a point in 50,000 may fall between two faces.
  EXPECT_GT(std::accumulate(counts.begin(), counts.end(), 0), samples - 20);
  EXPECT_GT(chi_square(counts, shares), least_probability);
}

// Of faces that reach out of the box, whose parts within have three to seven corners, what lies within, evenly: the
// square of a floor between two triangles of 20 m, and a slanted wall whose plane cuts off corners of the box.
TEST(SurfaceSampler, SpreadsPointsOverWhatLiesInABox) {
  const Box3f box{{{-1, -1, -1}}, {{1, 1, 1}}};
  const Scene floor = scene_of(quad({{-9, 0.25f, -11}}, {{0, 0, 20}}, {{20, 0, 0}}), lambertian(0.5f));
  const auto flat = traced(floor);
  const SurfaceSampler of_floor(*flat, box);
  std::vector<int> counts(256);
  Random random(2, 0);
  const auto part = [](float x) { return static_cast<size_t>(std::clamp((x + 1) * 8, 0.0f, 15.0f)); };
  for (int i = 0; i < samples; i++) {
    const Vec3f point = of_floor.sample(random).position;
    ASSERT_NEAR(point[1], 0.25f, 1e-3f);
    ASSERT_LE(std::max(std::abs(point[0]), std::abs(point[2])), 1 + 1e-5f);
    counts[16 * part(point[0]) + part(point[2])]++;
  }
  EXPECT_GT(chi_square_of_equal_bins(counts), least_probability);

  // x + y + z = 0 cuts the cube in a regular hexagon; by its symmetry six sixths and, of each, four strips by distance
  // from the middle, of 1, 3, 5 and 7 sixteenths of its area.
  const Vec3f normal = normalized(Vec3f::filled(1));
  const Frame frame(normal);
  const Scene slanted =
      scene_of(quad((-frame.x - frame.y) * 10.0f, frame.x * 20.0f, frame.y * 20.0f), lambertian(0.5f));
  const auto tilted = traced(slanted);
  const SurfaceSampler of_hexagon(*tilted, box);
  counts.assign(24, 0);
  std::vector<double> shares;
  for (int i = 0; i < 24; i++) shares.push_back((1 + 2 * (i % 4)) / (16 * 6.0));
  for (int i = 0; i < samples; i++) {
    const SurfacePoint sampled = of_hexagon.sample(random);
    const Vec3f point = (sampled.position + sampled.behind) / 2.0f;
    ASSERT_NEAR(dot(point, normal), 0, 1e-5f);
    int axis = 0;  // of the side of the cube that is nearest, which tells the sixth
    for (const int a : {1, 2})
      if (std::abs(point[a]) > std::abs(point[axis])) axis = a;
    const float share = std::min(std::abs(point[axis]), 0.999999f);  // of the way from the middle to the hexagon's side
    ASSERT_LE(std::abs(point[axis]), 1 + 1e-5f);
    counts[static_cast<size_t>(8 * axis + (point[axis] > 0 ? 4 : 0)) + static_cast<size_t>(share * 4)]++;
  }
  EXPECT_GT(chi_square(counts, shares), least_probability);
}

TEST(SurfaceSampler, IsEmptyWhereNothingIs) {
  const Scene scene = scene_of(room({{0, 0, 0}}, {{1, 1, 1}}), lambertian(0.5f));
  const auto surfaces = traced(scene);
  EXPECT_TRUE(SurfaceSampler(*surfaces, {Vec3f::filled(2), Vec3f::filled(3)}).empty());
  EXPECT_FALSE(SurfaceSampler(*surfaces, everywhere).empty());
}

}  // namespace
}  // namespace lightwell
