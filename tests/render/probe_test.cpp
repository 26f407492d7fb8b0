// SPDX-License-Identifier: Apache-2.0
#include "lightwell/render/probe.h"

#include <gtest/gtest.h>

#include "tests/render/find_integrator.h"
#include "tests/trace/scenes.h"
#include "tests/trace/truth.h"

namespace lightwell {
namespace {

std::vector<ProbeValue> measure(const Scene& scene, std::vector<ProbePoint> points, ProbeOptions options) {
  Progress silent;
  auto values = probe(*world_of(scene), points, options, silent);
  LW_ASSERT(values.has_value());
  return std::move(*values);
}

ProbeOptions paths(LightPart quantity, int samples) {
  ProbeOptions options;
  options.light.part = quantity;
  options.samples = samples;
  return options;
}

const Vec3f up{{0, 1, 0}};

Mesh floor(float half) { return quad({{-half, 0, -half}}, {{0, 0, 2 * half}}, {{2 * half, 0, 0}}); }

// Four standard errors, of which each value brings its own.
void expect_irradiance(const ProbeValue& value, float expected) {
  EXPECT_NEAR(value.irradiance[0], expected, 4 * value.standard_error + 1e-4f * expected);
  EXPECT_LT(value.standard_error, 0.05f * expected);
}

// A square lamp of half side a at height d, parallel to the floor below its centre: pi L times the form factor of
// Howell B-4.
TEST(Probe, ASquareLampOnItsAxis) {
  for (const float height : {0.3f, 1.0f, 4.0f}) {
    Scene scene = scene_of(floor(10), lambertian(0));
    add(scene, quad({{-0.5f, height, -0.5f}}, {{1, 0, 0}}, {{0, 0, 1}}), lambertian(0, 3));
    const float x = 0.5f / height, root = std::sqrt(1 + x * x);
    const float factor = 4 / pi * x / root * std::atan(x / root);
    const auto values = measure(scene, {{{}, up}, {{}, -up}}, paths(LightPart::direct, 4000));
    expect_irradiance(values[0], 3 * pi * factor);
    EXPECT_EQ(values[1].irradiance, Vec3f{});
  }
}

TEST(Probe, LampsWithoutExtent) {
  Scene scene = scene_of(floor(10), lambertian(0.5f));
  scene.lamps = {point_lamp({{3, 4, 0}}, Vec3f::filled(50))};
  expect_irradiance(measure(scene, {{{}, up}}, paths(LightPart::direct, 4))[0], 50 * 0.8f / 25);
  scene.lamps = {spot_lamp({{0, 2, 0}}, 8, 0.3f, 0.5f)};
  expect_irradiance(measure(scene, {{{}, up}}, paths(LightPart::direct, 4))[0], 2);
  scene.lamps = {sun_lamp({{0.6f, -0.8f, 0}}, 5)};
  expect_irradiance(measure(scene, {{{}, up}}, paths(LightPart::direct, 4))[0], 4);
}

TEST(Probe, AConstantSkyAboveAPlane) {
  Scene scene = scene_of(floor(1000), lambertian(0.5f));  // a point 1 m above sees 0.1 % of sky below the horizon
  scene.environment.radiance = Vec3f::filled(2);
  const std::vector<ProbePoint> points = {{{}, up}, {{{0, 1, 0}}, {{1, 0, 0}}}};
  const auto all = measure(scene, points, paths(LightPart::total, 4000));
  expect_irradiance(all[0], 2 * pi);
  const auto direct = measure(scene, points, paths(LightPart::direct, 4000));
  expect_irradiance(direct[1], pi);
  ProbeOptions without = paths(LightPart::direct, 100);
  without.light.left_out = LuminaireSet::all(1);
  EXPECT_EQ(measure(scene, points, without)[0].irradiance, Vec3f{});
}

// The wall of a sphere gets as much from each of its patches: flux / area * rho / (1 - rho) wherever the lamp is.
TEST(Probe, TheIntegratingSphere) {
  Scene scene = scene_of(sphere(1, 5), lambertian(0.5f));
  scene.lamps = {point_lamp({{0.3f, 0.2f, 0}}, Vec3f::filled(2))};
  const auto values =
      measure(scene, {{{{0, -0.999f, 0}}, up}, {{{0.999f, 0, 0}}, {{-1, 0, 0}}}}, paths(LightPart::indirect, 8000));
  // The mesh is up to 0.1 % smaller than the sphere.
  for (const ProbeValue& value : values) expect_irradiance(value, 2 * 4 * pi / (4 * pi) * 1.001f);
}

TEST(Probe, ReadsTheGrid) {
  const Scene scene = scene_of(floor(1), lambertian(0.5f, 0.01f));
  LightGrid grid;
  grid.shape = {.lo = {}, .cell = Vec3f::filled(1), .nodes = {{2, 2, 2}}};
  grid.moments.resize(8);
  for (Moments& moments : grid.moments) moments.m[2] = {{1, 2, 3}};
  grid.valid.assign(8, 1);
  ProbeOptions options = paths(LightPart::indirect, 1);
  const LightField field({{grid, {}, 0}});
  options.integrator = &find_integrator("ivg");
  options.light.field = &field;
  const auto values = measure(scene, {{{{0.5f, 0.5f, 0.5f}}, up}}, options);
  for (int c = 0; c < 3; c++) EXPECT_FLOAT_EQ(values[0].irradiance[c], static_cast<float>(1 + c));
  EXPECT_EQ(values[0].standard_error, 0);
}

TEST(Probe, GivesTheSameBytesForAnyNumberOfThreads) {
  const Scene scene = truth_scene("a_cornell");
  std::vector<ProbePoint> points;
  for (const TruthPoint& p : truth_points("a_cornell.free.indirect")) points.push_back({p.position, p.normal});
  ProbeOptions options = paths(LightPart::total, 4);
  options.threads = 1;
  const auto one = measure(scene, points, options);
  options.threads = 4;
  const auto four = measure(scene, points, options);
  for (size_t i = 0; i < one.size(); i++) EXPECT_EQ(one[i].irradiance, four[i].irradiance);
}

/// Probes the points of a truth file by path tracing.
TruthScore compare(const std::string& scene, const std::string& points, const ProbeOptions& options) {
  const std::vector<TruthPoint> truth = truth_points(points);
  std::vector<ProbePoint> at;
  for (const TruthPoint& p : truth) at.push_back({p.position, p.normal});
  std::vector<Vec3f> computed;
  std::vector<float> errors;
  for (const ProbeValue& value : measure(truth_scene(scene), at, options)) {
    computed.push_back(value.irradiance);
    errors.push_back(value.standard_error);
  }
  return score(truth, computed, errors);
}

// Path tracing against the independent path tracers, within the noise of both: the bias within four standard errors
// (the truth's own is up to 0.1 % besides). The median of |x| is 0.67 standard deviations of a normal x, and less where
// a point's three channels err together or its values scatter with long tails.
TEST(Probe, AgreesWithTheTruth) {
  for (const std::string scene : {"a_cornell", "b_tworooms", "c_furnace", "d_blob"}) {
    for (const std::string points : {"free", "surf"}) {
      const std::string name = scene + "." + points;
      const TruthScore indirect = compare(scene, name + ".indirect", paths(LightPart::indirect, 256));
      EXPECT_NEAR(indirect.bias, 0, 4 * indirect.noise + 0.001) << name;
      EXPECT_NEAR(indirect.sigma, 0.67, 0.25) << name;
      if (scene == "c_furnace") continue;
      const TruthScore direct = compare(scene, name + ".direct", paths(LightPart::direct, 256));
      EXPECT_NEAR(direct.bias, 0, 4 * direct.noise + 0.001) << name;
      EXPECT_LT(direct.sigma, 0.92) << name;
    }
  }
}

}  // namespace
}  // namespace lightwell
