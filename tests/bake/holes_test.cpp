// SPDX-License-Identifier: Apache-2.0
//
// Closed meshes into which holes are cut, as scans have them: with up to 3 % of the area missing they are the solids
// that they were. What is inside of a closed mesh is told by its winding number, which knows nothing of light.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>

#include "lightwell/bake/free_space.h"
#include "lightwell/trace/sampling.h"
#include "tests/mesh/divided.h"
#include "tests/trace/scenes.h"

namespace lightwell {
namespace {

constexpr float most_missing = 0.03f;

/// A grid of `along` x `around` quads that closes on itself both ways, its front outside.
template <typename Place>
Mesh closed_tube(uint32_t along, uint32_t around, const Place& place) {
  Mesh mesh;
  for (uint32_t i = 0; i < along; i++) {
    for (uint32_t k = 0; k < around; k++) {
      mesh.positions.push_back(place(2 * pi * static_cast<float>(i) / static_cast<float>(along),
                                     2 * pi * static_cast<float>(k) / static_cast<float>(around)));
      const auto at = [&](uint32_t u, uint32_t v) { return u % along * around + v % around; };
      mesh.faces.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
      mesh.faces.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
    }
  }
  return mesh;
}

Mesh torus() {
  return closed_tube(72, 36, [](float along, float around) {
    const float radius = 0.75f + 0.3f * std::cos(around);
    return Vec3f{{radius * std::cos(along), 0.3f * std::sin(around), -radius * std::sin(along)}};
  });
}

/// A trefoil, a torus knot of two turns one way and three the other.
Mesh torus_knot() {
  const auto middle = [](float t) {
    const float radius = 0.7f + 0.25f * std::cos(3 * t);
    return Vec3f{{radius * std::cos(2 * t), 0.4f * std::sin(3 * t), -radius * std::sin(2 * t)}};
  };
  return closed_tube(240, 20, [&](float along, float around) {
    const Vec3f point = middle(along), tangent = normalized(middle(along + 1e-2f) - middle(along - 1e-2f));
    const Vec3f outwards = normalized(Vec3f{{point[0], 0, point[2]}}), side = normalized(cross(outwards, tangent));
    return point + (cross(tangent, side) * std::cos(around) + side * std::sin(around)) * 0.13f;
  });
}

/// A ball with relief, stretched.
Mesh bumpy_ball() {
  Mesh mesh = turned(sphere(1, 4));
  for (Vec3f& p : mesh.positions) {
    const float relief = 1 + 0.15f * std::sin(5 * p[0] + 3 * p[1]) * std::sin(4 * p[2]);
    p = p * relief * Vec3f{{0.9f, 1.1f, 0.7f}};
  }
  return mesh;
}

Mesh box() { return divided(block({{-1, -0.5f, -0.8f}}, {{1, 0.5f, 0.8f}}), 4); }

/// A solid within a solid.
Mesh nested() {
  Mesh mesh = box();
  append(mesh, turned(sphere(0.3f, 3)));
  return mesh;
}

/// A shell with a cavity.
Mesh hollow() {
  Mesh mesh = turned(sphere(1, 4));
  append(mesh, sphere(0.6f, 3));
  return mesh;
}

/// A box and a ball that reach into each other.
Mesh overlapping() {
  Mesh mesh = divided(block({{-1, -0.5f, -0.5f}}, {{0.2f, 0.5f, 0.5f}}), 4);
  Mesh ball = turned(sphere(0.6f, 4));
  for (Vec3f& p : ball.positions) p = p + Vec3f{{0.35f, 0.1f, 0}};
  append(mesh, ball);
  return mesh;
}

float area(const Mesh& mesh, const Face& f) {
  const Vec3f& a = mesh.positions[f[0]];
  return length(cross(mesh.positions[f[1]] - a, mesh.positions[f[2]] - a)) / 2;
}

/// Cuts patches of faces out, up to a share of the area, each of up to a sixth of the mesh's size.
void cut_holes(Mesh& mesh, float missing, Random& random) {
  Box3f bounds;
  for (const Vec3f& p : mesh.positions) bounds.extend(p);
  const float size = max_component(bounds.size());
  float left = 0;
  for (const Face& face : mesh.faces) left += missing * area(mesh, face);
  for (int hole = 0; hole < 1000 && left > 0; hole++) {
    const Vec3f middle = mesh.positions[mesh.faces[random.below(static_cast<uint32_t>(mesh.faces.size()))][0]];
    const float radius = size * (0.01f + 0.07f * random.uniform());
    std::erase_if(mesh.faces, [&](const Face& face) {
      if (length(mesh.positions[face[0]] - middle) >= radius || area(mesh, face) > left) return false;
      left -= area(mesh, face);
      return true;
    });
  }
}

/// How often a mesh winds around a point: 1 in a solid, 0 outside (van Oosterom and Strackee, The Solid Angle of a
/// Plane Triangle, 1983).
double winding_number(const Mesh& mesh, const Vec3f& point) {
  double sum = 0;
  for (const Face& face : mesh.faces) {
    const Vec3d a = (mesh.positions[face[0]] - point).cast<double>(),
                b = (mesh.positions[face[1]] - point).cast<double>(),
                c = (mesh.positions[face[2]] - point).cast<double>();
    const double la = length(a), lb = length(b), lc = length(c);
    sum += std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return sum / (2 * std::numbers::pi);
}

/// Random points in and around a mesh, not nearer to it than a fortieth of its size: `inside` of it, and outside.
struct Places {
  std::vector<Vec3f> inside, outside;

  Places(const Mesh& mesh, size_t count, uint64_t seed) {
    Box3f bounds;
    for (const Vec3f& p : mesh.positions) bounds.extend(p);
    const float size = max_component(bounds.size());
    Random random(seed, 1);
    for (int i = 0; i < 4000 && std::min(inside.size(), outside.size()) < count; i++) {
      const Vec3f share{{random.uniform(), random.uniform(), random.uniform()}};
      const Vec3f point = bounds.lo + bounds.size() * (share * 1.4f - Vec3f::filled(0.2f));
      const auto near = [&](const Vec3f& p) { return length(p - point) < size / 40; };
      if (std::ranges::any_of(mesh.positions, near)) continue;
      std::vector<Vec3f>& side = winding_number(mesh, point) > 0.5 ? inside : outside;
      if (side.size() < count) side.push_back(point);
    }
  }
};

/// Whether most of the rays from a point come from the inside of a solid; a few of those within leave by the holes.
bool is_inside(const World& world, const FreeSpace& space, const Vec3f& point) {
  Random random(2, 0);
  int inside = 0;
  const int rays = 400;
  for (int i = 0; i < rays; i++) {
    Hit hit;
    inside += world.surfaces().intersect({point, sample_sphere(random)}, random, hit) && space.from_inside(hit);
  }
  return 2 * inside > rays;
}

/// The mesh in a room that shines, or under a sky.
Scene scene_with(const Mesh& mesh, bool double_sided, bool in_a_room) {
  Scene scene;
  if (in_a_room) {
    Box3f bounds;
    for (const Vec3f& p : mesh.positions) bounds.extend(p);
    add(scene, room(bounds.center() - bounds.size(), bounds.center() + bounds.size()), lambertian(0.5f, 1));
  } else {
    scene.environment.radiance = Vec3f::filled(1);
  }
  add(scene, mesh, lambertian(0.5f));
  scene.materials.back().double_sided = double_sided;
  return scene;
}

void expect_the_same_solid(const Mesh& closed, uint64_t seeds, std::initializer_list<float> shares) {
  constexpr size_t points = 12;
  const Places places(closed, points, 1);
  ASSERT_EQ(places.inside.size(), points);
  ASSERT_EQ(places.outside.size(), points);
  for (uint64_t seed = 0; seed < seeds; seed++) {
    for (const float missing : shares) {
      Mesh mesh = closed;
      Random random(seed, 0);
      cut_holes(mesh, missing, random);
      const bool double_sided = seed % 4 < 2, in_a_room = seed % 2 == 0;
      const Scene scene = scene_with(mesh, double_sided, in_a_room);
      const auto world = world_of(scene);
      Progress silent;
      const FreeSpace space = FreeSpace::survey(*world, {.most_photons = 1 << 18}, silent).value();
      const auto where = testing::Message() << "seed " << seed << ", missing " << missing << ", double-sided "
                                            << double_sided << ", in a room " << in_a_room;
      const auto inside = [&](const Vec3f& point) { return is_inside(*world, space, point); };
      EXPECT_EQ(std::ranges::count_if(places.inside, inside), points) << where;
      EXPECT_EQ(std::ranges::count_if(places.outside, inside), 0) << where;
    }
  }
}

struct Shape {
  const char* name;
  Mesh (*make)();
};

class SolidsWithHoles : public testing::TestWithParam<Shape> {};

// With one side or two, in a room or under a sky.
TEST_P(SolidsWithHoles, AreTheSolidsThatTheyWere) {
  expect_the_same_solid(GetParam().make(), 8, {0, 0.01f, most_missing});
}

INSTANTIATE_TEST_SUITE_P(Shapes, SolidsWithHoles,
                         testing::Values(Shape{"bumpy_ball", bumpy_ball}, Shape{"torus", torus},
                                         Shape{"torus_knot", torus_knot}, Shape{"box", box}, Shape{"nested", nested},
                                         Shape{"hollow", hollow}, Shape{"overlapping", overlapping}),
                         [](const auto& shape) { return std::string(shape.param.name); });

// Real scans, which have holes of their own beside those that are cut.
TEST(ScansWithHoles, AreTheSolidsThatTheyWere) {
  for (const std::string name : {"bunny.ply", "armadillo.obj.gz", "lucy-100k.ply"}) {
    const std::filesystem::path path = std::filesystem::path(LIGHTWELL_SHARED) / "data" / "scans" / name;
    if (!std::filesystem::exists(path)) {
      std::printf("left out: %s is not there\n", path.c_str());
      continue;
    }
    SCOPED_TRACE(name);
    Report report;
    const Scene scan = load_scene(path.string(), {}, report).value();
    Mesh mesh = scan.primitives[0].mesh;
    for (Vec3f& p : mesh.positions) p = scan.instances[0].to_scene.point(p);
    expect_the_same_solid(mesh, 2, {most_missing});
  }
}

}  // namespace
}  // namespace lightwell
