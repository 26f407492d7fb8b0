// SPDX-License-Identifier: Apache-2.0
//
// The samplers of sources of light, by chi-square tests: which source, which place on it, which direction.
#include <gtest/gtest.h>

#include "lightwell/trace/lights.h"
#include "tests/trace/chi_square.h"
#include "tests/trace/direction_bins.h"
#include "tests/trace/scenes.h"

namespace lightwell {
namespace {

constexpr int samples = 50000;
const Vec3f up{{0, 1, 0}};

size_t part(float x, float lo, float hi, size_t count) {
  return static_cast<size_t>(std::clamp((x - lo) / (hi - lo), 0.0f, 0.999999f) * static_cast<float>(count));
}

/// The chi-square of samples whose bin among equally probable ones `place` tells.
template <typename Place>
double chi_square_of(size_t bins, const Place& place) {
  std::vector<int> counts(bins);
  Random random(1, 0);
  for (int i = 0; i < samples; i++) counts[place(random)]++;
  return chi_square_of_equal_bins(counts);
}

/// A bin of 16 by 16 of a direction that is uniform between two heights over the plane of a frame.
size_t bin_between(const Frame& frame, const Vec3f& direction, float lowest) {
  const Vec3f v = frame.to_local(direction);
  return 16 * part(v[2], lowest, 1, 16) + part(std::atan2(v[1], v[0]), -pi, pi, 16);
}

/// Two walls of a corner that shine, one half as bright and of both sides, with a floor that does not.
Scene corner() {
  Scene scene = scene_of(quad({{-1, 0, -1}}, {{0, 0, 2}}, {{2, 0, 0}}), lambertian(0.5f));
  add(scene, quad({{-1, 0, -1}}, {{2, 0, 0}}, {{0, 1, 0}}), lambertian(0, 2));
  add(scene, quad({{-1, 0, -1}}, {{0, 0, 1.5f}}, {{0, 2, 0}}), lambertian(0, 1));
  scene.materials.back().double_sided = true;
  return scene;
}

// Directions from a point to sources that nothing hides, against the density that lights state for them.
double chi_square_of_directions(const Scene& scene, const Vec3f& point) {
  const auto world = world_of(scene);
  const Lights& lights = world->lights();
  Random unused(2, 0);
  const auto shares = DirectionBins::shares([&](const Vec3f& direction) {
    Hit hit;
    float density = lights.environment().black() ? 0 : lights.environment_density(direction);
    if (world->surfaces().intersect({point, direction}, unused, hit) &&
        max_component(world->surfaces().emission(hit, world->surfaces().surface(hit))) > 0)
      density += lights.density(point, hit);
    return density;
  });
  std::vector<int> counts(shares.size());
  Random random(3, 0);
  for (int i = 0; i < samples; i++) {
    const Arrival arrival = lights.sample(point, random);
    const bool arrives = arrival.density > 0 && max_component(arrival.radiance) > 0;
    counts[arrives ? DirectionBins::of(arrival.direction) : DirectionBins::without()]++;
  }
  return chi_square(counts, shares);
}

TEST(LightSamplers, ChooseDirectionsToFacesWithTheirDensity) {
  EXPECT_GT(chi_square_of_directions(corner(), {{0.5f, 0.5f, 0.2f}}), least_probability);
  Material lamp = lambertian(0, 1);
  lamp.double_sided = true;
  const Scene pane = scene_of(quad({{-1, 0, -1}}, {{2, 0, 0}}, {{0, 1, 0}}), lamp);
  for (const float side : {1.0f, -1.0f})
    EXPECT_GT(chi_square_of_directions(pane, {{0.3f, 0.5f, side - 1}}), least_probability);
}

// A screen whose picture is nearly black but for a spot: its faces are chosen by 64 samples of what they shine, which
// are far from their power, and the density tells what was made of them.
TEST(LightSamplers, ChooseDirectionsToAPictureWithTheirDensity) {
  Scene scene = corner();
  Mesh screen = quad({{0.95f, 0.1f, -0.4f}}, {{0, 0, 0.9f}}, {{0, 0.7f, 0}});
  screen.texcoords[0] = {{{0, 0}}, {{1, 0}}, {{1, 1}}, {{0, 1}}};
  add(scene, screen, lambertian(0, 60));
  scene.materials.back().emission_texture.image = 0;
  scene.images = {{8, 8, 1, std::vector<uint8_t>(64, 4)}};
  scene.images[0].pixels[8 * 2 + 5] = 255;
  EXPECT_GT(chi_square_of_directions(scene, {{0.5f, 0.5f, 0.2f}}), least_probability);
}

/// A sky of pixels that differ by up to four decades, none of them black. Twenty columns and two rows have their edges
/// where those of DirectionBins are.
Environment patchy_sky(int width, int height) {
  RadianceImage map{width, height, {}};
  Random random(6, 0);
  for (int pixel = 0; pixel < width * height; pixel++) {
    const float grey = std::pow(10.0f, 4 * random.uniform() - 2);
    map.pixels.insert(map.pixels.end(), {grey, 2 * grey, 3 * grey});
  }
  Environment environment;
  environment.radiance = Vec3f::filled(0.05f);
  environment.map = std::make_shared<const RadianceImage>(std::move(map));
  return environment;
}

TEST(LightSamplers, ShareSamplesOutToFacesAndSky) {
  Scene scene = corner();
  scene.environment.radiance = {{0.1f, 0.2f, 0.3f}};
  EXPECT_GT(chi_square_of_directions(scene, {{0.5f, 0.5f, 0.2f}}), least_probability);
  scene.environment = patchy_sky(20, 2);
  EXPECT_GT(chi_square_of_directions(scene, {{0.5f, 0.5f, 0.2f}}), least_probability);
}

// In proportion to power: pi area radiance, of a double-sided one twice that, and 4 pi intensity of a point.
TEST(LightSamplers, ChooseSourcesByTheirPower) {
  Scene scene = corner();
  scene.lamps = {point_lamp({{0, 1, 0}}, Vec3f::filled(0.5f)), point_lamp({{0, 2, 0}}, {{0, 0, 3}})};
  const std::vector<double> powers = {4 * 0.5, 4.0, 2 * 2, 2 * 3 * 1};  // over pi: lamps, then walls in their order
  const auto world = world_of(scene);
  std::vector<double> shares;
  for (const double power : powers) shares.push_back(power / (2 + 4 + 4 + 6));
  std::vector<int> sampled(powers.size()), emitted(powers.size());
  Random random(4, 0);
  for (int i = 0; i < samples; i++) {
    sampled[static_cast<size_t>(world->lights().sample({{0.5f, 0.5f, 0.2f}}, random).luminaire)]++;
    emitted[static_cast<size_t>(world->lights().emit(random).luminaire)]++;
  }
  EXPECT_GT(chi_square(sampled, shares), least_probability);
  EXPECT_GT(chi_square(emitted, shares), least_probability);
}

// A mesh of faces of very unlike areas: each photon starts at a place in proportion to what shines there.
TEST(LightSamplers, ChooseFacesByWhatTheyShine) {
  Mesh fan;
  fan.positions = {{{0, 0, 0}}};
  for (int i = 0; i <= 12; i++) {
    fan.positions.push_back({{std::pow(1.4f, static_cast<float>(i)), 0, 1}});
    if (i > 0) fan.faces.push_back({0, static_cast<uint32_t>(i + 1), static_cast<uint32_t>(i)});
  }
  const Scene scene = scene_of(fan, lambertian(0, 1));
  const auto world = world_of(scene);
  std::vector<double> shares;
  for (int i = 1; i <= 12; i++) shares.push_back((std::pow(1.4, i) - std::pow(1.4, i - 1)) / (std::pow(1.4, 12) - 1));
  std::vector<int> counts(shares.size());
  Random random(5, 0);
  for (int i = 0; i < samples; i++) {
    const Vec3f from = world->lights().emit(random).ray.origin;
    const float along = from[0] / from[2];
    const double face = std::log(static_cast<double>(std::max(along, 1.0f))) / std::log(1.4);
    counts[std::min(static_cast<size_t>(face), counts.size() - 1)]++;
  }
  EXPECT_GT(chi_square(counts, shares), least_probability);
}

// From everywhere on a face alike, and from both sides where it has two; in directions of a cosine's density.
TEST(LightSamplers, EmitFromFacesEvenlyInADiffuseWay) {
  for (const bool double_sided : {false, true}) {
    Material lamp = lambertian(0, 1);
    lamp.double_sided = double_sided;
    const Scene scene = scene_of(quad({{0, 0, 0}}, {{0, 0, 4}}, {{2, 0, 0}}), lamp);
    const auto world = world_of(scene);
    const Frame frame(up);
    const size_t sides = double_sided ? 2 : 1;
    EXPECT_GT(chi_square_of(sides * 256,
                            [&](Random& random) {
                              const Emission emission = world->lights().emit(random);
                              const Vec3f& from = emission.ray.origin;
                              const size_t side = emission.ray.direction[1] < 0 ? 1 : 0;
                              return side * 256 + 16 * part(from[0], 0, 2, 16) + part(from[2], 0, 4, 16);
                            }),
              least_probability);
    EXPECT_GT(chi_square_of(sides * 256,
                            [&](Random& random) {
                              const Vec3f v = frame.to_local(world->lights().emit(random).ray.direction);
                              const size_t side = v[2] < 0 ? 1 : 0;
                              return side * 256 + 16 * part(v[2] * v[2], 0, 1, 16) +
                                     part(std::atan2(v[1], v[0]), -pi, pi, 16);
                            }),
              least_probability);
  }
}

TEST(LightSamplers, EmitFromLampsEvenlyIntoTheirCones) {
  const Mesh floor = quad({{-1, 0, -1}}, {{0, 0, 2}}, {{2, 0, 0}});
  Scene scene = scene_of(floor, lambertian(0.5f));
  scene.lamps = {point_lamp({{0, 1, 0}}, Vec3f::filled(1))};
  const auto point = world_of(scene);
  EXPECT_GT(
      chi_square_of(
          256, [&](Random& random) { return bin_between(Frame(up), point->lights().emit(random).ray.direction, -1); }),
      least_probability);
  Scene with_spot = scene_of(floor, lambertian(0.5f));
  with_spot.lamps = {spot_lamp({{0, 1, 0}}, 1, 0.3f, 0.8f)};
  const auto spot = world_of(with_spot);
  EXPECT_GT(chi_square_of(256,
                          [&](Random& random) {
                            return bin_between(Frame(-up), spot->lights().emit(random).ray.direction, std::cos(0.8f));
                          }),
            least_probability);
}

// How far photons of a lamp with a range get: a share of 1 - (distance / range)^4 beyond a distance.
TEST(LightSamplers, EndPhotonsByTheWindowOfTheRange) {
  Scene scene = scene_of(quad({{-1, -9, -1}}, {{0, 0, 2}}, {{2, 0, 0}}), lambertian(0.5f));
  scene.lamps = {point_lamp({{0, 1, 0}}, Vec3f::filled(1), 3)};
  const auto world = world_of(scene);
  EXPECT_GT(
      chi_square_of(
          64, [&](Random& random) { return part(std::pow(world->lights().emit(random).ray.far / 3, 4.0f), 0, 1, 64); }),
      least_probability);
}

// A sun's and a sky's photons fill the cross-section of the scene's sphere evenly; the sky's come from everywhere
// alike.
TEST(LightSamplers, FillTheBeamsOfDistantSources) {
  const Mesh box = room({{-1, -1, -1}}, {{1, 1, 1}});
  const Vec3f down = normalized(Vec3f{{1, -2, 0.5f}});
  Scene sunny = scene_of(box, lambertian(0.5f)), cloudy = sunny;
  sunny.lamps = {sun_lamp(down, 1)};
  cloudy.environment.radiance = Vec3f::filled(1);
  for (const Scene* scene : {&sunny, &cloudy}) {
    const auto world = world_of(*scene);
    const float radius = length(world->lights().region().size()) / 2;
    const auto bin_of_disc = [&](Random& random) {
      const Ray ray = world->lights().emit(random).ray;
      const Vec3f across = Frame(ray.direction).to_local(ray.origin) / radius;
      return 16 * part(across[0] * across[0] + across[1] * across[1], 0, 1, 16) +
             part(std::atan2(across[1], across[0]), -pi, pi, 16);
    };
    EXPECT_GT(chi_square_of(256, bin_of_disc), least_probability);
  }
  const auto world = world_of(cloudy);
  EXPECT_GT(
      chi_square_of(
          256, [&](Random& random) { return bin_between(Frame(up), world->lights().emit(random).ray.direction, -1); }),
      least_probability);
}

// From each pixel of a map of the sky in proportion to the light that it sends, all with the same flux, and through
// each part of the beam alike whatever the pixel: the disc is cut in two by its area, and in two halves.
TEST(LightSamplers, EmitFromAMapOfTheSkyByItsLight) {
  constexpr int width = 16, height = 8;
  Scene scene = scene_of(room({{-1, -1, -1}}, {{1, 1, 1}}), lambertian(0.5f));
  scene.environment = patchy_sky(width, height);
  const auto world = world_of(scene);
  const float radius = length(world->lights().region().size()) / 2;
  constexpr size_t parts = 4;
  std::vector<double> shares;
  double total = 0;
  for (size_t pixel = 0; pixel < width * height; pixel++) {
    const double row = static_cast<double>(pixel / width);
    const double solid_angle =
        std::cos(std::numbers::pi * row / height) - std::cos(std::numbers::pi * (row + 1) / height);
    const double light = static_cast<double>(scene.environment.map->pixels[3 * pixel]) * solid_angle;
    shares.insert(shares.end(), parts, light / parts);
    total += light;
  }
  for (double& share : shares) share /= total;
  std::vector<int> counts(shares.size());
  Random random(7, 0);
  const float flux = world->lights().power()[0];
  for (int i = 0; i < 4 * samples; i++) {
    const Emission emission = world->lights().emit(random);
    ASSERT_NEAR(emission.flux[0] / flux, 1, 1e-3f);  // sums of 128 floats
    const Vec3f towards = -emission.ray.direction;
    const float around = 0.5f + std::atan2(towards[0], -towards[2]) / (2 * pi);  // docs/light.md: -z is in the middle
    const size_t pixel =
        width * part(std::acos(std::clamp(towards[1], -1.0f, 1.0f)) / pi, 0, 1, height) + part(around, 0, 1, width);
    const Vec3f across = Frame(emission.ray.direction).to_local(emission.ray.origin) / radius;
    const size_t inner = across[0] * across[0] + across[1] * across[1] < 0.5f ? 1 : 0, upper = across[1] > 0 ? 1 : 0;
    counts[parts * pixel + 2 * inner + upper]++;
  }
  EXPECT_GT(chi_square(counts, shares), least_probability);
}

}  // namespace
}  // namespace lightwell
