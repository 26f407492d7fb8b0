// SPDX-License-Identifier: Apache-2.0
#include "lightwell/render/render.h"

#include <gtest/gtest.h>

#include "lightwell/render/camera.h"
#include "lightwell/render/folds.h"
#include "lightwell/render/grid_integrator.h"
#include "tests/render/find_integrator.h"
#include "tests/trace/chi_square.h"
#include "tests/trace/scenes.h"
#include "tests/trace/truth.h"

namespace lightwell {
namespace {

Picture take(const World& world, const Camera& camera, const RenderOptions& options) {
  Progress silent;
  RenderStatistics statistics;
  auto picture = render(world, camera, options, silent, statistics);
  LW_ASSERT(picture.has_value());
  LW_ASSERT(statistics.rays > 0);
  return std::move(*picture);
}

RenderOptions small(LightPart part, std::string_view integrator = "path") {
  RenderOptions options;
  options.integrator = &find_integrator(integrator);
  options.light.part = part;
  options.width = 16;
  options.height = 12;
  options.samples = 256;
  return options;
}

double mean(const Picture& picture) {
  double sum = 0;
  for (const float value : picture.pixels) sum += static_cast<double>(value);
  return sum / static_cast<double>(picture.pixels.size());
}

/// A grid of the same light in all directions everywhere.
LightGrid uniform_grid(float irradiance) {
  LightGrid grid;
  grid.shape = {.lo = Vec3f::filled(-10), .cell = Vec3f::filled(20), .nodes = {{2, 2, 2}}};
  Moments moments;
  for (size_t i = 0; i < 6; i++) moments.m[i] = Vec3f::filled(irradiance);
  grid.moments.assign(8, moments);
  grid.valid.assign(8, 1);
  return grid;
}

Camera camera_at(const Vec3d& eye) {
  Camera camera;
  camera.to_scene = Transform::translation(eye);
  return camera;
}

TEST(Camera, LooksAlongItsNegativeZ) {
  Camera camera = camera_at({{1, 2, 3}});
  camera.yfov = pi / 2;
  const Ray middle = camera_ray(camera, 2, 0.5f, 0.5f);
  EXPECT_EQ(middle.origin, (Vec3f{{1, 2, 3}}));
  EXPECT_EQ(middle.direction, (Vec3f{{0, 0, -1}}));
  const Ray corner = camera_ray(camera, 2, 1, 0);  // top right: 45 degrees up, twice as far to the side
  EXPECT_NEAR(length(corner.direction - normalized(Vec3f{{2, 1, -1}})), 0, 1e-6f);
}

// Emitted radiance 1, direct irradiance pi and indirect pi times albedo 0.5 / pi: 1 + 0.5 + 0.5 in every pixel.
/// Where the rays of a picture's pixels met something.
std::vector<Vec3f>& places() {
  static std::vector<Vec3f> all;
  return all;
}

/// An integrator that only takes down what it is asked for.
struct Witness : public Integrator {
  ReflectedLight sample(const Receiver& receiver, Random&) const override {
    places().push_back(receiver.position);
    return {};
  }
};

// Rays are spread over the area of a picture evenly: over each pixel of a wall 2 m away, in 16 by 16 parts.
TEST(Render, SamplesPixelsEvenly) {
  const Scene scene = scene_of(quad({{-50, -50, 0}}, {{100, 0, 0}}, {{0, 100, 0}}), lambertian(0.5f));
  const IntegratorKind kind{
      "witness", "",
      true,      false,
      false,     [](const World&, const IntegratorOptions&) {
                              return std::unique_ptr<Integrator>(new Witness); }};
  RenderOptions options;
  options.integrator = &kind;
  options.width = options.height = 2;
  options.samples = 25000;
  options.threads = 1;
  Camera camera = camera_at({{0, 0, 2}});
  camera.yfov = pi / 2;  // the picture is a square of 4 m
  places().clear();
  take(*world_of(scene), camera, options);
  ASSERT_EQ(places().size(), 4u * 25000);
  std::vector<int> counts(4 * 256);
  for (const Vec3f& place : places()) {
    const auto part = [](float x) { return static_cast<size_t>(std::clamp((x + 2) * 8, 0.0f, 31.0f)); };
    counts[32 * part(place[1]) + part(place[0])]++;
  }
  EXPECT_GT(chi_square_of_equal_bins(counts), least_probability);
}

TEST(Render, OfTheFurnaceIsTwo) {
  const Scene scene = truth_scene("c_furnace");
  const auto world = world_of(scene);
  const Camera& camera = scene.cameras.at(0);
  // 192 pixels of 256 samples, each of which scatters by less than 1 (its path's number of bounces): 0.5 %, three
  // times.
  EXPECT_NEAR(mean(take(*world, camera, small(LightPart::total))), 2, 0.015);
  EXPECT_NEAR(mean(take(*world, camera, small(LightPart::direct))), 0.5, 0.004);
  EXPECT_NEAR(mean(take(*world, camera, small(LightPart::indirect))), 0.5, 0.015);
  EXPECT_NEAR(mean(take(*world, camera, small(LightPart::total, "direct"))), 1.5, 0.004);
}

TEST(Render, CountsBouncesBetweenSourceAndSurface) {
  const Scene scene = truth_scene("c_furnace");
  const auto world = world_of(scene);
  RenderOptions options = small(LightPart::indirect);
  options.light.max_bounces = 0;
  EXPECT_EQ(mean(take(*world, scene.cameras.at(0), options)), 0);
  options.light.max_bounces = 1;  // pi * 0.5 arrives
  EXPECT_NEAR(mean(take(*world, scene.cameras.at(0), options)), 0.25, 0.003);
  options.light.max_bounces = 2;
  EXPECT_NEAR(mean(take(*world, scene.cameras.at(0), options)), 0.375, 0.004);
}

TEST(Render, LooksUpTheGrid) {
  const Scene scene = truth_scene("c_furnace");
  const auto world = world_of(scene);
  const LightField grid({{uniform_grid(pi), {}, 0}});
  RenderOptions options = small(LightPart::indirect, "ivg");
  options.light.field = &grid;
  for (const float value : take(*world, scene.cameras.at(0), options).pixels) EXPECT_NEAR(value, 0.5f, 1e-4f);
  options.light.part = LightPart::total;
  EXPECT_NEAR(mean(take(*world, scene.cameras.at(0), options)), 2, 0.004);
  // What the grid contains is not lit again.
  options.light.held = LuminaireSet::all(world->lights().luminaires().size());
  EXPECT_NEAR(mean(take(*world, scene.cameras.at(0), options)), 1.5, 1e-4);
}

/// A surface that faces up, seen by who looks from `out`.
Receiver metal_floor(const Vec3f& out) {
  const Bsdf metal{.gloss = Vec3f::filled(0.5f), .grazing = 0.5f, .roughness = 0};
  const Vec3f up{{0, 1, 0}};
  return {.position = {}, .shading = {.bsdf = metal, .normal = up, .shading_normal = up, .out = normalized(out)}};
}

/// What it reflects of light from all directions alike.
float reflectance(const Receiver& receiver) {
  return receiver.shading.bsdf.albedo(dot(receiver.shading.normal, receiver.shading.out)).total()[0];
}

TEST(Render, GivesMetalsTheGridsLightOfTheMirroredDirection) {
  LightGrid grid = uniform_grid(0);
  for (Moments& moments : grid.moments) moments.m[0] = Vec3f::filled(2);  // light from +x
  const LightField field({{grid, {}, 0}});
  const Receiver opposite = metal_floor({{-1, 0.001f, 0}});
  EXPECT_NEAR(reflected_from_field(field, opposite)[0], reflectance(opposite) * 2 / pi, 0.005f);
  EXPECT_LT(reflected_from_field(field, metal_floor({{1, 0.001f, 0}}))[0], 0.005f);
}

// Whichever way a metal is looked at, it is lit by the light in front of it: the lookup is moved along the surface's
// normal, not along the mirrored direction, which at a grazing angle would find the light of the place itself.
TEST(Render, LooksUpMetalsAtTheSamePlaceFromEverywhere) {
  LightGrid grid;
  grid.shape = {.lo = Vec3f::filled(-10), .cell = {{20, 1, 20}}, .nodes = {{2, 21, 2}}};
  grid.normal_offset = 0.5f;
  for (size_t node = 0; node < grid.shape.count(); node++) {
    Moments& moments = grid.moments.emplace_back();  // the same from everywhere, as much as its height
    for (size_t i = 0; i < 6; i++) moments.m[i] = Vec3f::filled(grid.shape.position(grid.shape.node(node))[1] + 10);
  }
  grid.valid.assign(grid.shape.count(), 1);
  const LightField field({{grid, {}, 0}});
  // Half a cell of 1 m above the floor at 0 the irradiance is 10.5.
  for (const Vec3f& out : {Vec3f{{0, 1, 0}}, Vec3f{{1, 1, 0}}, Vec3f{{1, 0.01f, 0}}, Vec3f{{0, 0.01f, -1}}})
    EXPECT_NEAR(reflected_from_field(field, metal_floor(out))[0], reflectance(metal_floor(out)) * 10.5f / pi, 1e-3f);
}

// An integrating sphere: a ball whose inside reflects a share `albedo`, with a hole that is a part `open` of it, under
// a uniform sky. Every place of the inside gets open pi straight from the sky and, with what goes to and fro, open pi /
// (1 - albedo (1 - open)). The grids know of no ball: the sky is whole in them, and nothing is reflected.
TEST(Render, FindsWhatIsReflectedInFoldsThatTheGridDoesNotKnow) {
  Mesh ball = sphere(1, 5);
  const auto area = [&] {
    double sum = 0;
    for (const Face& face : ball.faces) {
      const Vec3f &a = ball.positions[face[0]], &b = ball.positions[face[1]], &c = ball.positions[face[2]];
      sum += static_cast<double>(length(cross(b - a, c - a)));
    }
    return sum;
  };
  const double all = area();
  std::erase_if(ball.faces, [&](const Face& face) {
    return std::ranges::all_of(face, [&](uint32_t corner) { return ball.positions[corner][1] > 0.3f; });
  });
  // A part of a ball takes as much of each place's hemisphere, by cosine, as of the ball's surface.
  const double open = 1 - area() / all;
  for (const float albedo : {0.2f, 0.5f, 0.8f}) {
    Scene scene = scene_of(ball, lambertian(albedo));
    scene.environment.radiance = Vec3f::filled(1);
    const auto world = world_of(scene);
    const LightField reflected({{uniform_grid(0), {}, 0}}), sky({{uniform_grid(pi), {}, 0}});
    const auto options_of = [&](LightPart part) {
      return IntegratorOptions{.part = part, .field = &reflected, .sky = &sky};
    };
    const Vec3f up{{0, 1, 0}};
    const Receiver floor{
        .position = {{0, -0.999f, 0}},
        .shading = {.bsdf = Bsdf::lambertian(Vec3f::filled(albedo)), .normal = up, .shading_normal = up, .out = up}};
    const auto mean_of = [&](const char* name, LightPart part) {
      const IntegratorOptions options = options_of(part);
      const auto made = find_integrator(name).make(*world, options);
      const Integrator& integrator = *made;
      Random random(1, 2);
      double sum = 0;
      constexpr int samples = 20'000;
      for (int i = 0; i < samples; i++) {
        const ReflectedLight light = integrator.sample(floor, random);
        sum += static_cast<double>((light.radiance + integrator.known(floor))[0]) / samples;
      }
      return sum;
    };
    const double whole = static_cast<double>(albedo) * open / (1 - static_cast<double>(albedo) * (1 - open));
    // The standard error of so many samples is below 1 % of it.
    EXPECT_NEAR(mean_of("path", LightPart::total), whole, 0.03 * whole) << albedo;
    EXPECT_NEAR(mean_of("ivg", LightPart::total), whole, 0.03 * whole) << albedo;
    // What comes straight is that, and what goes to and fro is indirect.
    const double straight = static_cast<double>(albedo) * open;
    EXPECT_NEAR(mean_of("ivg", LightPart::direct), straight, 0.03 * whole) << albedo;
    EXPECT_NEAR(mean_of("ivg", LightPart::indirect), whole - straight, 0.03 * whole) << albedo;
  }
}

// Red: the cells know the place as it is. Green: it is more open than they have it, by more light than is reflected.
// Blue: nothing of this colour comes from where it faces.
TEST(Folds, LeaveTheSkysOwnLightAndWhatSharesDoNotTell) {
  const SkyInFold shares{
      .open = {{2, 2, 0.01f}}, .mean = {{2, 2, 2}}, .in_cells = {{1, 0, 1}}, .share = {{0.5f, 1, 0}}};
  const Vec3f irradiance = irradiance_in_fold(Vec3f::filled(0.8f), {{1, 2, 0}}, {{0.3f, 0.1f, 0.4f}}, shares);
  EXPECT_FLOAT_EQ(irradiance[0], 1.3f);
  EXPECT_FLOAT_EQ(irradiance[1], 2);
  EXPECT_FLOAT_EQ(irradiance[2], 0.4f);
}

TEST(Render, ShowsTheEnvironmentOnlyInTheTotal) {
  Scene scene = scene_of(quad({{50, 50, 50}}, {{1, 0, 0}}, {{0, 1, 0}}), lambertian(0.5f));
  scene.environment.radiance = {{1, 2, 3}};
  const auto world = world_of(scene);
  EXPECT_NEAR(mean(take(*world, camera_at({}), small(LightPart::total))), 2, 1e-6);
  EXPECT_EQ(mean(take(*world, camera_at({}), small(LightPart::direct))), 0);
}

TEST(Render, GivesTheSameBytesForAnyNumberOfThreads) {
  const Scene scene = truth_scene("a_cornell");
  const auto world = world_of(scene);
  RenderOptions options = small(LightPart::total);
  options.samples = 8;
  options.threads = 1;
  const Picture one = take(*world, scene.cameras.at(0), options);
  options.threads = 3;
  EXPECT_EQ(take(*world, scene.cameras.at(0), options).pixels, one.pixels);
}

// Passes that time ends are right at whatever number of samples they reached: the very picture of as many.
TEST(Render, EndsInTimeWithThePictureOfAsManySamples) {
  const Scene scene = truth_scene("a_cornell");
  const auto world = world_of(scene);
  Progress silent;
  const auto taken = [&](int most, std::optional<double> seconds, RenderStatistics& statistics) {
    RenderOptions options = small(LightPart::total);
    options.samples = most;
    options.seconds = seconds;
    return render(*world, scene.cameras.at(0), options, silent, statistics).value().pixels;
  };
  RenderStatistics timed, counted;
  const std::vector<float> picture = taken(1'000'000, 0.2, timed);
  // A pass takes less than a millisecond.
  EXPECT_GT(timed.samples, 2);
  EXPECT_LT(timed.samples, 1'000'000);
  EXPECT_EQ(taken(timed.samples, {}, counted), picture);
  EXPECT_EQ(counted.samples, timed.samples);
  EXPECT_EQ(counted.rays, timed.rays);
  // Without time there is a picture, too, and with a year no more than is asked for.
  taken(1'000'000, 0, timed);
  EXPECT_EQ(timed.samples, 1);
  taken(3, 3e7, timed);
  EXPECT_EQ(timed.samples, 3);
}

TEST(Render, RefusesWhatItCannotDo) {
  const Scene scene = truth_scene("c_furnace");
  const auto world = world_of(scene);
  Progress silent;
  RenderStatistics statistics;
  RenderOptions options = small(LightPart::total, "ivg");
  EXPECT_EQ(render(*world, {}, options, silent, statistics).error().message(),
            "picture: there is no light grid to look up");
  options = small(LightPart::total);
  options.width = 0;
  EXPECT_EQ(render(*world, {}, options, silent, statistics).error().message(), "picture: its size must be positive");
}

// Its colour, whatever the light: in the whole picture, and in no part of the light.
TEST(Render, ShowsWhatIsUnlitAsItIs) {
  Scene scene = scene_of(quad({{-5, -5, -1}}, {{10, 0, 0}}, {{0, 10, 0}}), lambertian({{0.2f, 0.4f, 0.9f}}));
  scene.materials[0].unlit = true;
  scene.environment.radiance = Vec3f::filled(3);
  const auto world = world_of(scene);
  Camera camera;
  const Picture picture = take(*world, camera, small(LightPart::total));
  for (size_t i = 0; i < picture.pixels.size(); i++)
    ASSERT_NEAR(picture.pixels[i], (std::array{0.2f, 0.4f, 0.9f}[i % 3]), 1e-5f);
  EXPECT_EQ(mean(take(*world, camera, small(LightPart::indirect))), 0);
  // However the picture is exposed, its bytes are those of the colour.
  for (const float exposure : {-5.0f, 0.0f, 4.0f})
    for (const ToneCurve tone : {ToneCurve::none, ToneCurve::neutral}) {
      RenderOptions options = small(LightPart::total);
      options.display = {.exposure = exposure, .tone = tone};
      const Image image = displayed(take(*world, camera, options), options.display);
      // Linear 0.2, 0.4 and 0.9 in sRGB; rounding may move a byte by one.
      for (size_t i = 0; i < image.pixels.size(); i++)
        ASSERT_NEAR(image.pixels[i], (std::array{124, 170, 243}[i % 3]), 1);
    }
}

// The tone curve and its inverse, for all but bright saturated colours, which no light is shown as.
TEST(Picture, ColoursAreShownAsTheyAreByTheRadianceThatIsFoundForThem) {
  Random random(7, 0);
  for (int i = 0; i < 10'000; i++) {
    const float grey = random.uniform(), spread = grey < 0.7f ? 1.0f : 0.1f;
    Vec3f colour;
    for (float& channel : colour.e)
      channel = std::clamp(grey + spread * (random.uniform() - 0.5f), 0.0f, grey < 0.7f ? 0.75f : 0.99f);
    const Display display{.exposure = 6 * random.uniform() - 3, .tone = ToneCurve::neutral};
    const Vec3f shown = display(display.radiance_of(colour));
    for (int c = 0; c < 3; c++)
      ASSERT_NEAR(shown[c], colour[c], 2e-4f) << colour[0] << " " << colour[1] << " " << colour[2];
  }
}

}  // namespace
}  // namespace lightwell
