// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/photons.h"

#include <gtest/gtest.h>

#include "lightwell/base/parallel.h"
#include "lightwell/trace/paths.h"
#include "lightwell/trace/sampling.h"
#include "tests/trace/chi_square.h"
#include "tests/trace/scenes.h"

namespace lightwell {
namespace {

std::vector<Flight> flights_of(const World& world, uint64_t index) {
  std::vector<Flight> flights;
  Flight flight;
  for (PhotonWalk walk(world, 1, index); walk.next(flight);) flights.push_back(flight);
  return flights;
}

/// A floor, seen from above, of a size that no light passes by.
Mesh floor_mesh() { return quad({{-5, 0, -5}}, {{0, 0, 10}}, {{10, 0, 0}}); }

// In a closed room of albedo rho a photon makes 1 / (1 - rho) flights on average, all of them the same flux.
TEST(Photons, AreReflectedByTheAlbedo) {
  const Scene scene = scene_of(room({{0, 0, 0}}, {{1, 1, 1}}), lambertian(0.75f, 1));
  const auto world = world_of(scene);
  const uint64_t count = 20000;
  double flights = 0;
  for (uint64_t i = 0; i < count; i++) {
    int bounces = 0;
    for (const Flight& flight : flights_of(*world, i)) {
      flights++;
      ASSERT_NEAR(flight.flux[0], 6 * pi, 1e-4f);
      ASSERT_NEAR(length(flight.direction), 1, 1e-5f);
      ASSERT_TRUE(std::isfinite(flight.length));
      ASSERT_EQ(flight.bounces, bounces++);
      ASSERT_FALSE(flight.from_back);
    }
  }
  // A geometric distribution of mean 4 has a standard deviation of 3.5: 1 % is 1.6 standard errors; 3 % are allowed.
  EXPECT_NEAR(flights / static_cast<double>(count), 4, 0.12);
}

// A spot upon a matt floor of albedo 0.7: that share of its photons goes on, in directions of a cosine's density, and
// the others end.
TEST(Photons, AreReflectedInADiffuseWay) {
  Scene scene = scene_of(floor_mesh(), lambertian({{0.2f, 0.7f, 0.1f}}));
  scene.lamps = {spot_lamp({{0, 1, 0}}, 1, 0.3f, 0.4f)};
  const auto world = world_of(scene);
  std::vector<double> shares(257, 0.7 / 256);
  shares.back() = 0.3;
  std::vector<int> counts(shares.size());
  const auto part = [](float share) { return static_cast<size_t>(std::clamp(share, 0.0f, 0.999999f) * 16); };
  for (uint64_t i = 0; i < 50000; i++) {
    const std::vector<Flight> flights = flights_of(*world, i);
    if (flights.empty()) continue;  // at the very edge of the cone, where a photon carries nothing
    if (flights.size() == 1) {
      counts.back()++;
      continue;
    }
    // Malley: the square of the cosine is uniform.
    const Vec3f& v = flights[1].direction;
    counts[16 * part(v[1] * v[1]) + part(0.5f + std::atan2(v[2], v[0]) / (2 * pi))]++;
  }
  EXPECT_GT(chi_square(counts, shares), least_probability);
}

// A closed white furnace keeps all flux for as long as a photon is followed, and each flight begins where the last one
// ended.
TEST(Photons, LoseNothingInAWhiteFurnace) {
  const Scene scene = scene_of(room({{0, 0, 0}}, {{1, 1, 1}}), lambertian(1, 1));
  const auto world = world_of(scene);
  const float offset = world->surfaces().offset();
  for (uint64_t i = 0; i < 20; i++) {
    const std::vector<Flight> flights = flights_of(*world, i);
    ASSERT_EQ(flights.size(), 1001u);
    for (size_t k = 0; k < flights.size(); k++) {
      // A thousand roundings of 6e-8.
      ASSERT_NEAR(flights[k].flux[0] / (6 * pi), 1, 6e-5f);
      ASSERT_EQ(flights[k].bounces, static_cast<int>(k));
      if (k == 0) continue;
      const Vec3f end = flights[k - 1].origin + flights[k - 1].direction * flights[k - 1].length;
      ASSERT_LE(length(end - flights[k].origin), offset + 1e-5f);
    }
  }
}

// After k reflections rho^k of each colour's flux is left, although all colours share one photon.
TEST(Photons, CarryEachColoursShareOnAverage) {
  const Vec3f albedo{{0.9f, 0.5f, 0.1f}};
  const Scene scene = scene_of(room({{0, 0, 0}}, {{1, 1, 1}}), lambertian(albedo, Vec3f::filled(1)));
  const auto world = world_of(scene);
  const uint64_t count = 50000;
  std::vector<Vec3d> flux(5);
  for (uint64_t i = 0; i < count; i++) {
    for (const Flight& flight : flights_of(*world, i)) {
      const size_t bounces = static_cast<size_t>(flight.bounces);
      if (bounces < flux.size()) flux[bounces] += flight.flux.cast<double>() / static_cast<double>(count);
    }
  }
  for (size_t k = 0; k < flux.size(); k++) {
    for (int c = 0; c < 3; c++) {
      const double share = flux[k][c] / static_cast<double>(6 * pi);
      // A photon survives with the brightest colour's 0.9^k, whose standard error is below 0.5 / sqrt(50000) of it; the
      // share of the other colours in it is certain. Four of them.
      const double expected = std::pow(static_cast<double>(albedo[c]), k);
      EXPECT_NEAR(share / expected, 1, 0.009 / std::pow(0.9, k)) << k << " " << c;
    }
  }
}

TEST(Photons, FlyTheSameWayWhicheverThreadTracesThem) {
  Scene scene = scene_of(room({{0, 0, 0}}, {{1, 1, 1}}), lambertian(0.6f, 1));
  Material glass = lambertian(0.5f);
  glass.alpha = Material::Alpha::blend;
  glass.base_color[3] = 0.5f;
  add(scene, quad({{0, 0.5f, 0}}, {{0, 0, 1}}, {{1, 0, 0}}), glass);
  const auto world = world_of(scene);
  const size_t count = 2000;
  std::vector<std::vector<Flight>> alone(count), together(count);
  for (size_t i = 0; i < count; i++) alone[i] = flights_of(*world, i);
  parallel_for(count, 7, 4, [&](size_t begin, size_t end, int) {
    for (size_t i = begin; i < end; i++) together[i] = flights_of(*world, i);
  });
  size_t alike = 0;
  for (size_t i = 0; i < count; i++) {
    ASSERT_EQ(alone[i].size(), together[i].size()) << i;
    for (size_t k = 0; k < alone[i].size(); k++) {
      ASSERT_EQ(alone[i][k].origin, together[i][k].origin) << i;
      ASSERT_EQ(alone[i][k].direction, together[i][k].direction) << i;
      ASSERT_EQ(alone[i][k].length, together[i][k].length) << i;
      ASSERT_EQ(alone[i][k].flux, together[i][k].flux) << i;
    }
    alike += i > 0 && alone[i][0].origin == alone[i - 1][0].origin;
  }
  EXPECT_EQ(alike, 0u);
}

// 1 - (d / range)^4 of a lamp's photons fly further than d.
TEST(Photons, EndAtTheRangeOfTheirLamp) {
  Scene scene = scene_of(floor_mesh(), lambertian(0.5f));
  scene.lamps = {point_lamp({{0, 100, 0}}, Vec3f::filled(1), 2)};
  const auto world = world_of(scene);
  int beyond = 0;
  const int count = 20000;
  for (int i = 0; i < count; i++) {
    Flight flight;
    PhotonWalk walk(*world, 1, static_cast<uint64_t>(i));
    ASSERT_TRUE(walk.next(flight));
    ASSERT_EQ(walk.end(), nullptr);
    ASSERT_LE(flight.length, 2);
    beyond += flight.length > 1;
    ASSERT_FALSE(walk.next(flight));
  }
  EXPECT_NEAR(beyond / static_cast<double>(count), 15.0 / 16, 0.006);  // 3.5 standard errors
}

TEST(Photons, KnowThatTheyStartAtTheBackOfASurface) {
  for (const bool from_below : {false, true}) {
    for (const bool double_sided : {false, true}) {
      Material white = lambertian(1);
      white.double_sided = double_sided;
      Scene scene = scene_of(floor_mesh(), white);
      scene.lamps = {sun_lamp({{0, from_below ? 1.0f : -1.0f, 0}}, 1)};
      const auto world = world_of(scene);
      int reflected = 0;
      for (uint64_t i = 0; i < 200; i++) {
        const std::vector<Flight> flights = flights_of(*world, i);
        ASSERT_FALSE(flights[0].from_back);
        if (flights.size() < 2) continue;  // past the floor, whose circle of light is larger
        reflected++;
        EXPECT_EQ(flights[1].from_back, from_below && !double_sided);
        EXPECT_GT(flights[1].direction[1] * (from_below ? -1 : 1), 0);
      }
      EXPECT_GT(reflected, 50);
    }
  }
}

// Half metal, half glass without gloss, white: half of the light goes straight on, and the metal reflects the rest.
TEST(Photons, PassAPaneOfGlassAndMetal) {
  Material pane = lambertian(1);
  pane.metallic = 0.5f;
  pane.transmission = 1;
  Scene scene = scene_of(floor_mesh(), pane);
  scene.lamps = {spot_lamp({{0, 1, 0}}, 1, 0.01f, 0.02f)};
  const auto world = world_of(scene);
  double emitted = 0, passed = 0, reflected = 0;
  for (uint64_t i = 0; i < 20000; i++) {
    Flight flight;
    PhotonWalk walk(*world, 1, i);
    if (!walk.next(flight)) continue;  // at the very edge of the cone, where a photon carries nothing
    const float flux = flight.flux[0];
    emitted++;
    if (!walk.end()) {
      passed++;
    } else if (walk.next(flight)) {
      ASSERT_GT(flight.direction[1], 0);
      reflected += static_cast<double>(flight.flux[0] / flux);  // which survivors of chance gain
    }
  }
  EXPECT_GT(emitted, 19900);
  // 4 standard errors of 0.5 / sqrt(20000), rounded up.
  EXPECT_NEAR(passed / emitted, 0.5, 0.015);
  EXPECT_NEAR(reflected / emitted, 0.5, 0.015);
}

/// A room of smooth plastic with a block of metal and a lamp; with `bumps`, of a normal map on its walls.
Scene glossy_room(bool bumps) {
  Mesh walls = room({{0, 0, 0}}, {{2, 1.5f, 3}});
  for (size_t i = 0; i < walls.positions.size(); i++)
    walls.texcoords[0].push_back({{i % 4 == 1 || i % 4 == 2 ? 1.0f : 0.0f, i % 4 > 1 ? 1.0f : 0.0f}});
  Material plastic = lambertian({{0.7f, 0.5f, 0.3f}});
  plastic.specular = 1;
  plastic.roughness = 0.3f;
  if (bumps) plastic.normal_texture.image = 0;
  Scene scene = scene_of(walls, plastic);
  Image map{32, 32, 3, {}};
  Random random(7, 0);
  for (int i = 0; i < 32 * 32; i++) {
    const Vec3f disc = sample_disc(random) * 0.6f;  // normals lean by up to 37 degrees, 24 on average
    const Vec3f normal{{disc[0], disc[1], std::sqrt(1 - dot(disc, disc))}};
    for (int c = 0; c < 3; c++) map.pixels.push_back(static_cast<uint8_t>(std::lround(127.5f * (normal[c] + 1))));
  }
  scene.images = {map};
  Material metal = lambertian(0.8f);
  metal.metallic = 1;
  metal.roughness = 0.3f;
  add(scene, block({{1.2f, 0.2f, 1}}, {{1.7f, 0.6f, 1.6f}}), metal);
  scene.lamps = {point_lamp({{0.5f, 1, 2.2f}}, {{1, 2, 3}})};
  return scene;
}

/// Irradiance of the floor by photons that land there.
Vec3d floor_by_photons(const World& world, uint64_t count) {
  Vec3d sum{};
  Flight flight;
  for (uint64_t i = 0; i < count; i++)
    for (PhotonWalk walk(world, 2, i); walk.next(flight);)
      if (walk.end() && walk.end()->position[1] < 1e-3f) sum += flight.flux.cast<double>();
  return sum / (6.0 * static_cast<double>(count));
}

Vec3d floor_by_paths(const World& world, uint64_t count) {
  Vec3d sum{};
  const LuminaireSet none;
  for (uint64_t i = 0; i < count; i++) {
    Random random(3, i);
    const float x = 2 * random.uniform(), z = 3 * random.uniform();
    DirectAndIndirect light(none);
    trace_path(world, Receiver::irradiance({{x, 0, z}}, {{0, 1, 0}}), 64, random, light);
    sum += (light.direct + light.indirect).cast<double>();
  }
  return sum / static_cast<double>(count);
}

// Both directions of following light meet where gloss, metal and bumps reflect it. Each side scatters by about its
// mean, 0.5 % of 40000, and a photon lands on the floor more than once; four times both. Photons leave bumps out: such
// strong ones reflect 3 % less of this lamp's light (docs/decisions/022-materials.md).
TEST(Photons, AgreeWithPathsOnGlossAndBumps) {
  for (const bool bumps : {false, true}) {
    const Scene scene = glossy_room(bumps);
    const auto world = world_of(scene);
    const Vec3d photons = floor_by_photons(*world, 40000), paths = floor_by_paths(*world, 40000);
    for (int c = 0; c < 3; c++) EXPECT_NEAR(photons[c] / paths[c], 1, bumps ? 0.05 : 0.025) << c;
  }
}

}  // namespace
}  // namespace lightwell
