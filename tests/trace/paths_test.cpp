// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/paths.h"

#include <gtest/gtest.h>

#include "tests/trace/scenes.h"

namespace lightwell {
namespace {

const Vec3f up{{0, 1, 0}};

/// Received light by how many reflections it has behind it, and all of it.
class LightByBounces : public ReceivedLight {
 public:
  void add(int /*luminaire*/, int bounces, const Vec3f& light) override {
    if (by_bounces.size() <= static_cast<size_t>(bounces)) by_bounces.resize(static_cast<size_t>(bounces) + 1);
    by_bounces[static_cast<size_t>(bounces)] += light.cast<double>();
  }

  std::vector<Vec3d> by_bounces;
};

/// The mean over `count` paths of light by its bounces; as many entries as asked for.
std::vector<Vec3d> mean_light(const World& world, const Receiver& receiver, int max_bounces, int count) {
  LightByBounces light;
  for (int i = 0; i < count; i++) {
    Random random(1, static_cast<uint64_t>(i));
    trace_path(world, receiver, max_bounces, random, light);
  }
  EXPECT_LE(light.by_bounces.size(), static_cast<size_t>(max_bounces) + 1);
  light.by_bounces.resize(static_cast<size_t>(max_bounces) + 1);
  for (Vec3d& sum : light.by_bounces) sum = sum / static_cast<double>(count);
  return light.by_bounces;
}

/// Irradiance by a polygon of constant radiance that lies above the receiver's plane (Lambert 1760): half the radiance
/// times the sum over edges of the angle that an edge subtends and the cosine of its plane's normal.
double lambert_irradiance(const std::vector<Vec3f>& corners, double radiance, const Vec3f& point, const Vec3f& normal) {
  double sum = 0;
  for (size_t i = 0; i < corners.size(); i++) {
    const Vec3d a = normalized((corners[i] - point).cast<double>());
    const Vec3d b = normalized((corners[(i + 1) % corners.size()] - point).cast<double>());
    const Vec3d across = cross(a, b);
    sum += std::asin(std::min(1.0, length(across))) * dot(normalized(across), normal.cast<double>());
  }
  return radiance / 2 * std::abs(sum);
}

// A rectangle aside and above, seen by receivers of several inclinations.
TEST(Paths, FindARectanglesDirectLight) {
  const Vec3f corner{{0.4f, 1, -0.3f}}, u{{0.7f, 0.2f, 0}}, v{{0, 0.1f, 0.9f}};
  Scene scene = scene_of(quad({{-5, 0, -5}}, {{0, 0, 10}}, {{10, 0, 0}}), lambertian(0.5f));
  Material lamp = lambertian(0, 3);
  lamp.double_sided = true;
  add(scene, quad(corner, u, v), lamp);
  const auto world = world_of(scene);
  for (const Vec3f& towards : {up, Vec3f{{0.5f, 1, 0.2f}}, Vec3f{{1, 0.4f, 0}}}) {
    const Vec3f normal = normalized(towards);
    const Vec3f point{{0, 0.05f, 0}};
    const double expected = lambert_irradiance({corner, corner + u, corner + u + v, corner + v}, 3, point, normal);
    const double found = mean_light(*world, Receiver::irradiance(point, normal), 0, 20000)[0][0];
    // Weighted by the power heuristic a sample scatters by about half of the mean: 4 * 0.5 / sqrt(20000) is 1.5 %.
    EXPECT_NEAR(found / expected, 1, 0.015);
  }
}

// Every wall shines with L and reflects rho: after k reflections arrives pi L rho^k, and all of it is pi L / (1 - rho).
TEST(Paths, FindEveryBounceOfAFurnace) {
  const Vec3f albedo{{0.8f, 0.5f, 0.2f}};
  const Scene scene = scene_of(room({{0, 0, 0}}, {{1, 2, 1}}), lambertian(albedo, Vec3f::filled(2)));
  const auto world = world_of(scene);
  const Receiver receiver = Receiver::irradiance({{0.3f, 0, 0.6f}}, up);
  for (const int max_bounces : {0, 3, 100}) {
    const std::vector<Vec3d> light = mean_light(*world, receiver, max_bounces, 20000);
    for (int c = 0; c < 3; c++) {
      const double rho = static_cast<double>(albedo[c]), direct = 2 * std::numbers::pi;
      double all = 0;
      for (size_t k = 0; k < light.size(); k++) {
        if (k < 4) {
          // Sampling lights scatters by about one mean: 4 / sqrt(20000) is 3 %.
          EXPECT_NEAR(light[k][c] / (direct * std::pow(rho, k)), 1, 0.03) << k << " of " << max_bounces;
        }
        all += light[k][c];
      }
      const double expected = direct * (1 - std::pow(rho, max_bounces + 1)) / (1 - rho);
      EXPECT_NEAR(all / expected, 1, 0.03) << max_bounces;
    }
  }
}

// A sphere's wall gets the same from each of its patches: the k-th reflection brings flux / area rho^k everywhere,
// wherever the lamp is.
TEST(Paths, FindOneBounceInASphere) {
  Scene scene = scene_of(sphere(1, 5), lambertian(0.6f));
  scene.lamps = {point_lamp({{0.4f, 0.3f, 0}}, Vec3f::filled(2))};
  const auto world = world_of(scene);
  for (const Vec3f& position : {Vec3f{{0, -0.999f, 0}}, Vec3f{{0.999f, 0, 0}}, Vec3f{{0, 0, -0.999f}}}) {
    const std::vector<Vec3d> light =
        mean_light(*world, Receiver::irradiance(position, normalized(-position)), 2, 20000);
    // The mesh is up to 0.1 % smaller than the sphere. A lamp half-way to the wall makes samples of it scatter by about
    // their mean: 4 / sqrt(20000) is 3 %.
    EXPECT_NEAR(light[1][0] / (2 * 0.6), 1, 0.03);
    EXPECT_NEAR(light[2][0] / (2 * 0.36), 1, 0.03);
  }
}

// A smooth white metal shows what it mirrors, and both ways of sampling share the sky out without loss.
TEST(Paths, ShowTheSkyInAMirror) {
  Scene scene = scene_of(quad({{-5, 0, -5}}, {{0, 0, 10}}, {{10, 0, 0}}), lambertian(0));
  scene.environment.radiance = {{1, 2, 3}};
  const auto world = world_of(scene);
  for (const float roughness : {0.0f, 0.2f}) {
    Receiver receiver = Receiver::irradiance({}, up);
    receiver.shading.out = normalized(Vec3f{{1, 2, 0}});
    receiver.shading.bsdf = {.gloss = Vec3f::filled(1), .grazing = 1, .roughness = roughness};
    const Vec3d light = mean_light(*world, receiver, 0, 20000)[0];
    // Facets of alpha up to 0.04 hide less than 0.1 % of each other. Samples of the sky meet the lobe one in hundreds
    // and weigh little.
    EXPECT_NEAR(light[0], 1, 0.01) << roughness;
    EXPECT_NEAR(light[2] / light[0], 3, 1e-4) << roughness;
  }
}

Scene scene_of_three_sources() {
  Scene scene = scene_of(room({{0, 0, 0}}, {{2, 2, 2}}), lambertian({{0.7f, 0.5f, 0.3f}}));
  add(scene, quad({{0.5f, 1.9f, 0.5f}}, {{0.3f, 0, 0}}, {{0, 0, 0.3f}}), lambertian(0, 5));
  scene.lamps = {point_lamp({{1.5f, 1, 1.5f}}, {{1, 2, 3}}), spot_lamp({{0.5f, 1.5f, 1}}, 4, 0.3f, 0.6f)};
  return scene;
}

// However the light is told apart, its portions are those of the same paths and add up to the same whole.
TEST(Paths, PortionsAddUpToTheWhole) {
  const Scene scene = scene_of_three_sources();
  const auto world = world_of(scene);
  const Receiver receiver = Receiver::irradiance({{0.6f, 0, 1}}, up);
  ASSERT_EQ(world->lights().luminaires().size(), 3u);
  LuminaireSet second;
  second.insert(1);
  const LuminaireSet none;
  DirectAndIndirect whole(none), without_second(second);
  LightByLuminaire by_luminaire(world->lights());
  for (uint64_t i = 0; i < 2000; i++) {
    for (ReceivedLight* light : std::initializer_list<ReceivedLight*>{&whole, &without_second, &by_luminaire}) {
      Random random(2, i);
      trace_path(*world, receiver, 10, random, *light);
    }
  }
  Vec3f direct{}, indirect{};
  for (const LightByLuminaire::Sums& sums : by_luminaire.sums) {
    EXPECT_GT(sums.direct[0], 0);
    EXPECT_GT(sums.indirect[0], 0);
    direct += sums.direct;
    indirect += sums.indirect;
  }
  for (int c = 0; c < 3; c++) {
    // Thousands of roundings in another order.
    EXPECT_NEAR(direct[c] / whole.direct[c], 1, 1e-4f);
    EXPECT_NEAR(indirect[c] / whole.indirect[c], 1, 1e-4f);
    EXPECT_NEAR((without_second.direct[c] + by_luminaire.sums[1].direct[c]) / whole.direct[c], 1, 1e-4f);
    EXPECT_EQ(without_second.indirect[c], whole.indirect[c]);
  }
}

// In a world that some luminaires light, what others' surfaces and the sky send is not met.
TEST(Paths, WorldsOfSomeLuminairesAddUp) {
  Scene scene = scene_of(quad({{-1, 1, -1}}, {{2, 0, 0}}, {{0, 0, 1}}), lambertian(0, 1));
  add(scene, quad({{-1, 1, 1}}, {{2, 0, 0}}, {{0, 1, 1}}), lambertian(0, 2));
  scene.environment.radiance = {{0.5f, 1, 2}};
  const auto world = world_of(scene);
  ASSERT_EQ(world->lights().luminaires().size(), 3u);
  const Receiver receiver = Receiver::irradiance({}, up);
  constexpr int paths = 200'000;
  const Vec3d all = mean_light(*world, receiver, 0, paths)[0];
  Vec3d sum{};
  for (int i = 0; i < 3; i++) {
    LuminaireSet one;
    one.insert(i);
    sum += mean_light(*world->lit_by(one), receiver, 0, paths)[0];
  }
  // The standard errors of so many paths are below 0.5 %.
  for (int c = 0; c < 3; c++) EXPECT_NEAR(sum[c], all[c], 0.015 * all[c]);
}

TEST(Paths, CountTheirRaysAndTakeNoneInTheDark) {
  const Scene dark = scene_of(room({{0, 0, 0}}, {{1, 1, 1}}), lambertian(0.5f));
  const Scene lit = scene_of_three_sources();
  const auto dark_world = world_of(dark), lit_world = world_of(lit);
  const Receiver receiver = Receiver::irradiance({{0.6f, 0, 0.5f}}, up);
  LightByBounces light;
  Random random(3, 0);
  EXPECT_EQ(trace_path(*dark_world, receiver, 5, random, light), 0);
  EXPECT_TRUE(light.by_bounces.empty());
  // A vertex takes a ray to the lights where they may be seen, and one onwards.
  for (const int max_bounces : {0, 4}) {
    const int rays = trace_path(*lit_world, receiver, max_bounces, random, light);
    EXPECT_GE(rays, 1);
    EXPECT_LE(rays, 2 * (max_bounces + 1));
  }
}

}  // namespace
}  // namespace lightwell
