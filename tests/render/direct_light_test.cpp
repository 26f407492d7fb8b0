// SPDX-License-Identifier: Apache-2.0
#include "lightwell/render/direct_light.h"

#include <gtest/gtest.h>

#include "lightwell/render/permitted_difference.h"
#include "lightwell/render/render.h"
#include "lightwell/texture/transfer.h"
#include "lightwell/trace/lamp_irradiance.h"
#include "tests/render/find_integrator.h"
#include "tests/render/half_plane.h"

namespace lightwell {
namespace {

const LuminaireSet none;

/// By the lamps' points.
double irradiance(const HalfPlane& scene, const LampSampling& sampling, float offset, int* rays = nullptr) {
  Random random(1, 1);
  const LampLight::Found found =
      LampLight(scene.world(), sampling, none, as_they_are).reflected(scene.receiver(offset), {}, random);
  if (rays) *rays = found.rays;
  return static_cast<double>(found.radiance[0]);
}

/// Edges of all directions, before receivers all over their penumbra.
std::vector<HalfPlane> half_planes() {
  std::vector<HalfPlane> all;
  for (int i = 0; i < 16; i++) all.emplace_back(2 * pi * (static_cast<float>(i) + 0.3f) / 16);
  return all;
}
constexpr int offsets = 24;
float offset_of(int i) { return 0.48f * (2 * (static_cast<float>(i) + 0.5f) / offsets - 1); }

double error(const std::vector<HalfPlane>& scenes, int points) {
  double squares = 0;
  for (const HalfPlane& scene : scenes) {
    LampSampling sampling = scene.sampling();
    sampling.most_points = points;
    for (int i = 0; i < offsets; i++) {
      const double off = irradiance(scene, sampling, offset_of(i)) - scene.irradiance(offset_of(i));
      squares += off * off / (offsets * static_cast<double>(scenes.size()));
    }
  }
  return std::sqrt(squares);
}

// Points of this order leave of an edge n^-0.75 at best (it cuts as many of n cells as a line does); random ones
// n^-0.5.
TEST(DirectLight, ErrsInPenumbrasByLessThanRandomPoints) {
  const std::vector<HalfPlane> scenes = half_planes();
  const double few = error(scenes, 16), many = error(scenes, 1024);
  EXPECT_LT(std::log(many / few) / std::log(1024.0 / 16), -0.7) << few << " " << many;
  // Of the irradiance of the whole lamp, 0.24: after so many points there is neither bias nor noise.
  EXPECT_LT(many, 0.003 * 0.24);
}

/// The mean of random samples of all luminaires.
Vec3f at_random(const World& world, const Receiver& receiver, int samples) {
  const IntegratorOptions options;
  const DirectLight direct(world, options, none);
  Random random(3, 4);
  Vec3d sum{};
  for (int i = 0; i < samples; i++) sum += direct.sample(receiver, {}, random).radiance.cast<double>() / samples;
  return sum.cast<float>();
}

/// The same with points of lamps.
Vec3f by_points(const World& world, const Receiver& receiver, const LampSampling& sampling, int samples = 1) {
  IntegratorOptions options;
  options.sampling = sampling;
  const DirectLight direct(world, options, none);
  Random random(3, 4);
  Vec3d sum{};
  for (int i = 0; i < samples; i++) sum += direct.sample(receiver, {}, random).radiance.cast<double>() / samples;
  return sum.cast<float>();
}

void expect_near(const Vec3f& found, const Vec3f& wanted, float share) {
  for (int c = 0; c < 3; c++) EXPECT_NEAR(found[c], wanted[c], share * wanted[c]);
}

// Gloss over a colour, and a metal; below a lamp whose half is hidden.
TEST(DirectLight, IsRightForWhatShines) {
  const HalfPlane scene(0.4f);
  LampSampling sampling = scene.sampling();
  sampling.most_points = 512;
  for (const bool metal : {false, true}) {
    Material material;
    material.base_color = {{0.8f, 0.4f, 0.2f, 1}};
    material.roughness = 0.4f;
    material.metallic = metal ? 1.0f : 0.0f;
    const Scene floor = scene_of(quad({{-1, 0, -1}}, {{0, 0, 2}}, {{2, 0, 0}}), material);
    const auto floor_world = world_of(floor);
    Hit hit;
    Random random(1, 1);
    const Ray ray{.origin = {{0.1f, 1, 0.8f}}, .direction = normalized(Vec3f{{0, -1, -0.7f}})};
    ASSERT_TRUE(floor_world->surfaces().intersect(ray, random, hit));
    const Receiver receiver =
        Receiver::seen(floor_world->surfaces(), hit, floor_world->surfaces().surface(hit), ray.direction);
    // The standard errors of so many samples are below 0.5 %, of so many points below 0.6 %.
    expect_near(by_points(scene.world(), receiver, sampling, 5'000), at_random(scene.world(), receiver, 200'000),
                0.015f);
  }
}

// A smooth normal that leans, also so far that it looks away from a part of the lamp, or the surface's plane cuts it.
TEST(DirectLight, FoldsUpWhatTheShadingTakesFromBelow) {
  const HalfPlane scene(0.4f);
  LampSampling sampling = scene.sampling();
  sampling.most_points = 4096;
  for (const Vec3f& plane : {Vec3f{{0, 1, 0}}, Vec3f{{1, 0.1f, 0}}, Vec3f{{0, 0, 1}}})
    for (const Vec3f& lean : {Vec3f{{1, 1, 0}}, Vec3f{{0.2f, 0.1f, 1}}, Vec3f{{1, -0.3f, 0.4f}}}) {
      Receiver receiver = Receiver::irradiance({{0.1f, 0, 0.05f}}, normalized(plane));
      receiver.shading.shading_normal = normalized(lean);
      if (dot(plane, lean) <= 0) continue;
      receiver.shading.out = normalized(normalized(plane) + normalized(lean));
      // The standard error of so many samples is below 0.4 %, of so many points below 0.3 %.
      expect_near(by_points(scene.world(), receiver, sampling), at_random(scene.world(), receiver, 400'000), 0.015f);
    }
}

/// Adds what shines, with a node of its own by which it is told from others.
void add_lamp(Scene& scene, const Mesh& mesh, float radiance) {
  add(scene, mesh, lambertian(0, radiance));
  scene.instances.back().node = static_cast<int>(scene.instances.size()) - 1;
}

// Twenty lamps, of which sixteen have points, and a sky: nothing is missing, and nothing is counted twice.
TEST(DirectLight, CountsEveryLuminaireOnce) {
  Scene scene;
  for (int i = 0; i < 20; i++)
    add_lamp(scene, quad({{static_cast<float>(i) - 10, 2, 0}}, {{0.5f, 0, 0}}, {{0, 0, 0.5f}}),
             1 + 0.1f * static_cast<float>(i));
  // Hides three of the sixteen, and no edge is before any.
  add(scene, quad({{-4.7f, 1, -3}}, {{1.55f, 0, 0}}, {{0, 0, 6}}), lambertian(0.5f));
  scene.environment.radiance = {{0.01f, 0.02f, 0.03f}};
  const auto world = world_of(scene);
  ASSERT_EQ(world->lights().luminaires().size(), 21u);
  LampSampling sampling;
  sampling.most_points = 16;
  for (size_t i = 4; i < 20; i++)
    sampling.lamps.push_back(
        rectangle_lamp(*world, i, {{0.25f, 0, 0}}, {{0, 0, 0.25f}}, 1 + 0.1f * static_cast<float>(i)));
  const Receiver receiver = Receiver::irradiance({{-4, 0, 0}}, {{0, 1, 0}});
  // The standard errors of so many samples are below 0.3 %. The faintest lamp is 2 % of all light.
  expect_near(by_points(*world, receiver, sampling, 20'000), at_random(*world, receiver, 400'000), 0.01f);
}

// A panel whose picture is bright on one side and half as bright on the other: two lamps stand for one luminaire, and
// an edge before them hides more of one than of the other.
TEST(DirectLight, CountsALuminaireOfTwoLampsOnce) {
  constexpr int width = 256;
  Image picture{width, 1, 3, {}};
  for (int x = 0; x < width; x++) picture.pixels.insert(picture.pixels.end(), 3, x < width / 2 ? 255 : 188);
  const float half = srgb_to_linear(uint8_t{188});
  Scene scene;
  scene.images.push_back(picture);
  Material material = lambertian(0, 1);
  material.emission_texture.image = 0;
  Mesh panel = quad({{-1, 1, -0.5f}}, {{2, 0, 0}}, {{0, 0, 1}});
  for (const Vec3f& at : panel.positions) panel.texcoords[0].push_back({{(at[0] + 1) / 2, 0.5f}});
  add(scene, panel, material);
  add(scene, quad({{0.2f, 0.5f, -2}}, {{2, 0, 0}}, {{0, 0, 4}}), lambertian(0.5f));
  const auto world = world_of(scene);
  ASSERT_EQ(world->lights().luminaires().size(), 1u);
  LampSampling sampling;
  sampling.most_points = 1024;
  for (const float side : {-1.0f, 1.0f}) {
    sampling.lamps.push_back(rectangle_lamp(*world, 0, {{0.5f, 0, 0}}, {{0, 0, 0.5f}}, side < 0 ? 1 : half));
    sampling.lamps.back().center = {{side / 2, 1, 0}};
  }
  for (const float x : {-0.3f, 0.1f, 0.4f}) {
    const Receiver receiver = Receiver::irradiance({{x, 0, 0.2f}}, {{0, 1, 0}});
    // The picture fades over a texel, 8 mm, between its sides and at its ends: less than 0.4 % of the light. The
    // standard error of so many samples is below 0.2 %, that of so many points 0.1 %.
    expect_near(by_points(*world, receiver, sampling), at_random(*world, receiver, 200'000), 0.01f);
  }
}

TEST(DirectLight, LeavesOutAndMultipliesAsItIsTold) {
  const HalfPlane scene(0.4f);
  IntegratorOptions options;
  options.sampling = scene.sampling();
  options.sampling.most_points = 64;
  const Receiver receiver = scene.receiver(0.2f);
  Random random(1, 1);
  const Vec3f all = DirectLight(scene.world(), options, none).sample(receiver, {}, random).radiance;
  EXPECT_GT(all[0], 0);
  EXPECT_EQ(DirectLight(scene.world(), options, luminaires({1})).sample(receiver, {}, random).radiance, Vec3f{});
  options.factors.set(0, {{2, 1, 0.5f}});
  const Vec3f coloured = DirectLight(scene.world(), options, none).sample(receiver, {}, random).radiance;
  expect_near(coloured, all * Vec3f{{2, 1, 0.5f}}, 1e-5f);
}

// A shining cube has a sphere for a lamp, out of which its corners reach, and a rectangle that is not quite flat; what
// they stand for does not hide them.
TEST(DirectLight, LampsAreNotHiddenByWhatTheyStandFor) {
  Scene scene;
  add_lamp(scene, block({{-0.1f, 1.9f, -0.1f}}, {{0.1f, 2.1f, 0.1f}}), 1);
  Mesh bent = quad({{2, 2, 0}}, {{1, 0, 0}}, {{0, 0, 1}});
  bent.positions[0][1] -= 0.01f;
  add_lamp(scene, bent, 1);
  const auto world = world_of(scene);
  ASSERT_EQ(world->lights().luminaires().size(), 2u);
  ClientLamp ball;
  ball.kind = ClientLamp::Kind::sphere;
  ball.center = {{0, 2, 0}};
  ball.radius = std::sqrt(0.24f / (4 * pi));
  ball.radiance = Vec3f::filled(1);
  ball.luminaire = world->lights().luminaires()[0].id;
  const ClientLamp panel = rectangle_lamp(*world, 1, {{0.5f, 0, 0}}, {{0, 0, 0.5f}}, 1);
  for (const ClientLamp& lamp : {ball, panel})
    for (const Vec3f& place : {Vec3f{{0, 0, 0}}, Vec3f{{1, 1.5f, 0.2f}}}) {
      const LampSampling sampling{.lamps = {lamp}, .most_points = 64, .shown = {}};
      const LampLight light(*world, sampling, none, as_they_are);
      Random random(1, 1);
      const Receiver receiver = Receiver::irradiance(place, {{0, 1, 0}});
      const Vec3f found = light.reflected(receiver, {}, random).radiance;
      expect_near(found, unshadowed_irradiance(lamp, place, {{0, 1, 0}}), 1e-5f);
    }
}

constexpr Display as_it_is{.exposure = 0, .tone = ToneCurve::none};

TEST(DirectLight, EndsWhereMoreIsNotSeen) {
  const HalfPlane scene(0.4f);
  LampSampling sampling = scene.sampling();
  sampling.most_points = 4096;
  sampling.shown = as_it_is;
  int rays = 0;
  // All of the lamp is seen.
  EXPECT_NEAR(irradiance(scene, sampling, 0.9f, &rays), scene.irradiance(0.9f), 1e-5);
  EXPECT_EQ(rays, 16);
  // Nothing is. It takes more points to tell, fewer beside other light, which makes what a point may miss less visible.
  EXPECT_EQ(irradiance(scene, sampling, -0.9f, &rays), 0);
  EXPECT_LT(rays, 1024);
  Random random(1, 1);
  const LampLight light(scene.world(), sampling, none, as_they_are);
  EXPECT_LT(light.reflected(scene.receiver(-0.9f), Vec3f::filled(0.2f), random).rays, rays);
  // A picture without exposure, one of numbers, has all points.
  sampling.shown = {};
  irradiance(scene, sampling, 0.9f, &rays);
  EXPECT_EQ(rays, 4096);
}

// Close to a sphere few of its points face who is there, of the first sixteen none at many places. That these tell
// nothing is no reason to end, nor to be dark where there are no more.
TEST(DirectLight, GoesOnUntilPointsTellOfTheLamp) {
  Scene scene;
  add_lamp(scene, turned(sphere(0.1f, 3)), 1);
  const auto world = world_of(scene);
  ClientLamp ball;
  ball.kind = ClientLamp::Kind::sphere;
  ball.radius = 0.1f;
  ball.radiance = Vec3f::filled(1);
  ball.luminaire = world->lights().luminaires().at(0).id;
  LampSampling sampling{.lamps = {ball}, .most_points = 4096, .shown = as_it_is};
  const auto receiver = [](int i) {
    const float turn = 0.1f * static_cast<float>(i);
    const Vec3f away = normalized(Vec3f{{std::cos(turn), std::sin(3 * turn), std::sin(turn)}});
    return Receiver::irradiance(away * 0.104f, -away);
  };
  const auto found = [&](const World& scene_world, const Receiver& at) {
    Random random(1, 1);
    return LampLight(scene_world, sampling, none, as_they_are).reflected(at, {}, random).radiance;
  };
  for (const int most : {16, 4096}) {
    sampling.most_points = most;
    for (int i = 0; i < 64; i++)
      expect_near(found(*world, receiver(i)),
                  unshadowed_irradiance(ball, receiver(i).position, receiver(i).shading.normal), 1e-5f);
  }
  // And nothing is lit that a shell between the two hides.
  add(scene, turned(sphere(0.102f, 3)), lambertian(0));
  const auto hidden = world_of(scene);
  for (int i = 0; i < 64; i++) EXPECT_EQ(found(*hidden, receiver(i)), Vec3f{});
}

// In penumbras points go on, and then the light errs by little that is seen; in the dark less is seen of them.
TEST(DirectLight, GoesOnInPenumbras) {
  double all_rays = 0, all_rays_in_the_dark = 0, squares = 0;
  const std::vector<HalfPlane> scenes = half_planes();
  for (const HalfPlane& scene : scenes) {
    LampSampling sampling = scene.sampling();
    sampling.most_points = 4096;
    for (int i = 0; i < offsets; i++) {
      int rays = 0;
      sampling.shown = as_it_is;
      const auto encoded = [](double value) { return linear_to_srgb(static_cast<float>(value)); };
      const float off =
          encoded(irradiance(scene, sampling, offset_of(i), &rays)) - encoded(scene.irradiance(offset_of(i)));
      squares += static_cast<double>(off) * static_cast<double>(off);
      all_rays += rays;
      sampling.shown->exposure = -6;
      irradiance(scene, sampling, offset_of(i), &rays);
      all_rays_in_the_dark += rays;
    }
  }
  const double count = offsets * static_cast<double>(scenes.size());
  EXPECT_GT(all_rays / count, 32);
  EXPECT_LT(all_rays_in_the_dark, all_rays);
  // Halves may agree by chance, so that single receivers err by more.
  EXPECT_LT(std::sqrt(squares / count), 1.5 * static_cast<double>(permitted_difference(0)));
}

TEST(DirectLight, IsTheSameForAnyNumberOfThreads) {
  const HalfPlane scene(0.4f);
  RenderOptions options;
  options.integrator = &find_integrator("direct");
  options.light.sampling = scene.sampling();
  options.light.sampling.most_points = 64;
  options.light.sampling.shown = as_it_is;
  options.width = 24;
  options.height = 16;
  options.samples = 2;
  Camera camera;
  camera.to_scene = Transform::translation({{0, 1.5, 4}});
  const auto taken = [&](int threads) {
    options.threads = threads;
    Progress silent;
    RenderStatistics statistics;
    return render(scene.world(), camera, options, silent, statistics).value().pixels;
  };
  const std::vector<float> one = taken(1);
  EXPECT_GT(*std::ranges::max_element(one), 0);
  EXPECT_EQ(taken(3), one);
}

}  // namespace
}  // namespace lightwell
