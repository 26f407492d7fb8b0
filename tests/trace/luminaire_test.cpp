// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/luminaire.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "lightwell/base/random.h"
#include "lightwell/trace/paths.h"
#include "tests/trace/scenes.h"

namespace lightwell {
namespace {

/// Three lit panels in one mesh that its node places twice, a mirrored one of another node, a lamp and a sky.
Scene scene_of_lamps() {
  Mesh panels = quad({{0, 3, 0}}, {{1, 0, 0}}, {{0, 0, 1}});
  append(panels, quad({{3, 3, 0}}, {{1, 0, 0}}, {{0, 0, 1}}));
  append(panels, quad({{6, 3, 0}}, {{1, 0, 0}}, {{0, 0, 1}}));
  Scene scene = scene_of(panels, lambertian(0, 1));
  scene.primitives[0].source_primitive = 2;
  scene.instances[0].node = 4;
  scene.instances.push_back({0, Transform::translation({{0, 5, 0}}), 4});
  scene.instances.push_back({0, Transform::scaling({{1, -1, 1}}), 9});
  scene.lamps = {point_lamp({{1, 1, 1}}, Vec3f::filled(1))};
  scene.lamps[0].node = 7;
  scene.environment.radiance = Vec3f::filled(1);
  return scene;
}

std::vector<LuminaireId> ids(const Scene& scene) {
  const auto world = world_of(scene);
  std::vector<LuminaireId> all;
  for (const Luminaire& luminaire : world->lights().luminaires()) all.push_back(luminaire.id);
  return all;
}

TEST(Luminaires, HaveIdsOfTheirOwn) {
  const std::vector<LuminaireId> all = ids(scene_of_lamps());
  ASSERT_EQ(all.size(), 11u);
  EXPECT_EQ(std::set(all.begin(), all.end()).size(), all.size());
  using Kind = LuminaireId::Kind;
  EXPECT_EQ(all[0], (LuminaireId{Kind::lamp, 7}));
  EXPECT_EQ(all[2], (LuminaireId{Kind::surface, 4, 0, 2, 4}));  // the second panel begins with vertex 4
  EXPECT_EQ(all[5], (LuminaireId{Kind::surface, 4, 1, 2, 4}));
  EXPECT_EQ(all[8], (LuminaireId{Kind::surface, 9, 0, 2, 4}));
  EXPECT_EQ(all[10], LuminaireId{Kind::environment});
}

// The order of faces is the file's affair, and a level of a mesh lacks some of them.
TEST(Luminaires, KeepTheirIdsWhenFacesAreShuffledOrFewer) {
  Scene scene = scene_of_lamps();
  std::vector<LuminaireId> before = ids(scene);
  std::sort(before.begin(), before.end());
  Random random(3, 0);
  for (int round = 0; round < 5; round++) {
    std::vector<Face>& faces = scene.primitives[0].mesh.faces;
    for (size_t left = faces.size(); left > 1; left--)
      std::swap(faces[left - 1], faces[random.below(static_cast<uint32_t>(left))]);
    std::vector<LuminaireId> after = ids(scene);
    std::sort(after.begin(), after.end());
    EXPECT_EQ(after, before);
  }
  // The panels' second triangles are gone; vertices 0, 4 and 8 belong to their first ones.
  std::erase_if(scene.primitives[0].mesh.faces,
                [](const Face& f) { return *std::max_element(f.begin(), f.end()) % 4 == 3; });
  std::vector<LuminaireId> fewer = ids(scene);
  std::sort(fewer.begin(), fewer.end());
  EXPECT_EQ(fewer, before);
}

TEST(LuminaireSet, IsWhatWasPutIn) {
  LuminaireSet set;
  EXPECT_FALSE(set.contains(0));
  EXPECT_FALSE(set.contains(-1));
  set.insert(5);
  set.insert(2);
  EXPECT_TRUE(set.contains(5));
  EXPECT_FALSE(set.contains(4));
  set.erase(5);
  set.erase(5);
  LuminaireSet other;
  other.insert(2);
  EXPECT_EQ(set, other);
  EXPECT_EQ(LuminaireSet::all(3), luminaires({1, 1, 1}));
}

// The same path, its light told by luminaire and in two sums.
TEST(ReceivedLight, ByLuminaireAddsUpToTheWhole) {
  Scene scene = scene_of(room({{0, 0, 0}}, {{4, 4, 4}}), lambertian({{0.5f, 0.6f, 0.7f}}));
  add(scene, quad({{1, 3.9f, 1}}, {{1, 0, 0}}, {{0, 0, 1}}), lambertian(0, 5));
  scene.lamps = {point_lamp({{3, 1, 3}}, {{4, 2, 1}}), point_lamp({{1, 1, 3}}, {{0, 2, 5}})};
  const auto world = world_of(scene);
  const Receiver receiver = Receiver::irradiance({{2, 0, 2}}, {{0, 1, 0}});
  const LuminaireSet first = luminaires({1});
  DirectAndIndirect without_first(first);
  LightByLuminaire by_luminaire(world->lights());
  const LuminaireSet none;
  DirectAndIndirect sums(none);
  for (uint64_t i = 0; i < 2000; i++) {
    Random a(1, i), b(1, i), c(1, i);
    const int rays = trace_path(*world, receiver, 8, a, sums);
    EXPECT_EQ(trace_path(*world, receiver, 8, b, by_luminaire), rays);
    trace_path(*world, receiver, 8, c, without_first);
  }
  Vec3f direct{}, indirect{};
  for (const LightByLuminaire::Sums& of_luminaire : by_luminaire.sums) {
    EXPECT_GT(max_component(of_luminaire.direct), 0);
    EXPECT_GT(max_component(of_luminaire.indirect), 0);
    direct += of_luminaire.direct;
    indirect += of_luminaire.indirect;
  }
  for (int c = 0; c < 3; c++) {  // sums of 2000 floats in another order
    EXPECT_NEAR(direct[c] / sums.direct[c], 1, 1e-4f);
    EXPECT_NEAR(indirect[c] / sums.indirect[c], 1, 1e-4f);
    EXPECT_NEAR((without_first.direct[c] + by_luminaire.sums[0].direct[c]) / sums.direct[c], 1, 1e-4f);
    EXPECT_NEAR(without_first.indirect[c] / sums.indirect[c], 1, 1e-4f);
  }
}

// The others keep their numbers, send no photons and no samples, and are not met.
TEST(Luminaires, ShineAloneInAWorldLitByThem) {
  const Scene scene = scene_of_lamps();
  const auto world = world_of(scene);
  const Lights& all = world->lights();
  for (int only = 0; only < 11; only++) {
    LuminaireSet set;
    set.insert(only);
    const auto lit = world->lit_by(set);
    const Lights& lights = lit->lights();
    ASSERT_EQ(lights.luminaires().size(), 11u);
    EXPECT_EQ(lights.power(), all.luminaires()[static_cast<size_t>(only)].power);
    EXPECT_EQ(lights.environment_luminaire(), only == 10 ? 10 : -1);
    Random random(5, static_cast<uint64_t>(only));
    for (int i = 0; i < 50; i++) {
      EXPECT_EQ(lights.emit(random).luminaire, only);
      EXPECT_EQ(lights.sample({{0.5f, 1, 0.5f}}, random).luminaire, only);
      const Ray ray{.origin = {{0, 1, 0}}, .direction = sample_sphere(random)};
      Hit hit;
      if (!world->surfaces().intersect(ray, random, hit)) continue;
      const int met = all.luminaire(hit);
      EXPECT_EQ(lights.luminaire(hit), met == only ? only : -1);
      EXPECT_EQ(lights.density(ray.origin, hit) > 0, met == only && all.density(ray.origin, hit) > 0);
    }
  }
  EXPECT_TRUE(world->lit_by({})->lights().dark());
}

}  // namespace
}  // namespace lightwell
