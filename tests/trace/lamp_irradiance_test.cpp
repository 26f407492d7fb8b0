// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/lamp_irradiance.h"

#include <gtest/gtest.h>

#include "lightwell/trace/paths.h"
#include "tests/trace/scenes.h"

namespace lightwell {
namespace {

/// By the path tracer.
Vec3f sampled(const World& world, const Vec3f& position, const Vec3f& normal, int samples) {
  Random random(5, 6);
  Vec3d sum{};
  const LuminaireSet none;
  for (int i = 0; i < samples; i++) {
    DirectAndIndirect light(none);
    trace_path(world, Receiver::irradiance(position, normal), 0, random, light);
    sum += light.direct.cast<double>() / samples;
  }
  return sum.cast<float>();
}

/// Before a lamp, nearly beside it, and where the horizon cuts it.
const std::vector<std::pair<Vec3f, Vec3f>> receivers{{{{0, 0, 0}}, {{0, 1, 0}}},
                                                     {{{1, 0, 0.5f}}, {{0, 1, 0}}},
                                                     {{{0.2f, 1, 0.1f}}, {{1, 0.05f, 0}}},
                                                     {{{0.2f, 0.3f, 0.1f}}, {{0.3f, 0.1f, 1}}},
                                                     {{{3, 0, 1}}, {{-1, -0.3f, 0}}}};

void expect_as_sampled(const Scene& scene, const ClientLamp& lamp, int samples) {
  const auto world = world_of(scene);
  for (const auto& [position, direction] : receivers) {
    const Vec3f normal = normalized(direction);
    const Vec3f found = unshadowed_irradiance(lamp, position, normal);
    const Vec3f wanted = sampled(*world, position, normal, samples);
    for (int c = 0; c < 3; c++) EXPECT_NEAR(found[c], wanted[c], 0.005f * wanted[c]) << position[0] << " " << normal[1];
  }
}

// The standard errors of the samples are below 0.15 %, of those of a sphere, half of which look away, too.
constexpr int many = 400'000, of_sphere = 2'500'000;

TEST(LampIrradiance, OfRectanglesIsThatOfThePathTracer) {
  ClientLamp lamp;
  lamp.kind = ClientLamp::Kind::rectangle;
  lamp.center = {{0, 2, 0}};
  lamp.normal = {{0, -1, 0}};
  lamp.half_u = {{0.5f, 0, 0}};
  lamp.half_v = {{0, 0, 0.75f}};
  lamp.radiance = {{1, 2, 3}};
  Material material = lambertian({}, lamp.radiance);
  const Mesh mesh = quad({{-0.5f, 2, -0.75f}}, {{1, 0, 0}}, {{0, 0, 1.5f}});
  expect_as_sampled(scene_of(mesh, material), lamp, many);
  // From behind there is light of two sides only.
  const Vec3f above{{0, 3, 0}}, down{{0, -1, 0}};
  EXPECT_EQ(unshadowed_irradiance(lamp, above, down), Vec3f{});
  material.double_sided = lamp.two_sided = true;
  const Vec3f wanted = sampled(*world_of(scene_of(mesh, material)), above, down, many);
  EXPECT_NEAR(unshadowed_irradiance(lamp, above, down)[0], wanted[0], 0.005f * wanted[0]);
}

TEST(LampIrradiance, OfDiscsIsThatOfThePathTracer) {
  ClientLamp lamp;
  lamp.kind = ClientLamp::Kind::disc;
  lamp.center = {{0, 2, 0}};
  lamp.normal = {{0, -1, 0}};
  lamp.radius = 0.6f;
  lamp.radiance = {{1, 2, 3}};
  // Of so many sides that the area of what is not in both is below 0.02 %.
  constexpr uint32_t sides = 200;
  Mesh fan;
  fan.positions.push_back(lamp.center);
  for (uint32_t i = 0; i < sides; i++) {
    const float turn = 2 * pi * static_cast<float>(i) / sides;
    fan.positions.push_back(lamp.center + Vec3f{{std::cos(turn), 0, std::sin(turn)}} * lamp.radius);
    fan.faces.push_back({0, 1 + i, 1 + (i + 1) % sides});
  }
  expect_as_sampled(scene_of(fan, lambertian({}, lamp.radiance)), lamp, many);
}

TEST(LampIrradiance, OfSpheresIsThatOfThePathTracer) {
  // Its flat faces are within 0.1 % of the sphere's area.
  const Mesh mesh = turned(sphere(0.6f, 5));
  ClientLamp lamp;
  lamp.kind = ClientLamp::Kind::sphere;
  lamp.center = {{0, 2, 0}};
  lamp.radius = 0.6f;
  lamp.radiance = Vec3f::filled(2);
  Scene scene;
  add(scene, mesh, lambertian(0, 2), Transform::translation({{0, 2, 0}}));
  expect_as_sampled(scene, lamp, of_sphere);
}

// No chance is in it.
TEST(LampIrradiance, OfLampsWithoutExtentIsThatOfThePathTracer) {
  for (const Lamp& source : {point_lamp({{0, 2, 0}}, {{1, 2, 3}}, 4), spot_lamp({{0, 2, 0}}, 3, 0.3f, 0.9f),
                             sun_lamp(normalized(Vec3f{{0.3f, -1, 0.2f}}), 2)}) {
    Scene scene;
    scene.lamps.push_back(source);
    // A world needs a surface.
    add(scene, quad({{5, 5, 5}}, {{1, 0, 0}}, {{0, 1, 0}}), lambertian(0.5f));
    expect_as_sampled(scene, describe_lamp(source), 1);
  }
}

}  // namespace
}  // namespace lightwell
