// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/lamps.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/trace/luminaires.h"

namespace lightwell {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

Material emitter(const Vec3f& radiance) {
  Material material;
  material.emission = radiance;
  return material;
}

// A rectangle of half-sides a and b round the origin, facing +z, of n by n quads.
Mesh rectangle(float a, float b, uint32_t n = 1) {
  Mesh mesh;
  for (uint32_t j = 0; j <= n; j++)
    for (uint32_t i = 0; i <= n; i++)
      mesh.positions.push_back({{a * (2 * static_cast<float>(i) / static_cast<float>(n) - 1),
                                 b * (2 * static_cast<float>(j) / static_cast<float>(n) - 1), 0}});
  for (uint32_t j = 0; j < n; j++)
    for (uint32_t i = 0; i < n; i++) {
      const uint32_t k = j * (n + 1) + i;
      mesh.faces.push_back({k, k + 1, k + n + 2});
      mesh.faces.push_back({k, k + n + 2, k + n + 1});
    }
  return mesh;
}

// A sphere of latitude and longitude; `turned` makes its faces look inwards.
Mesh sphere(float radius, bool turned) {
  Mesh mesh;
  constexpr uint32_t rings = 32, sectors = 64;
  for (uint32_t i = 0; i <= rings; i++)
    for (uint32_t j = 0; j < sectors; j++) {
      const float t = pi * static_cast<float>(i) / rings, p = 2 * pi * static_cast<float>(j) / sectors;
      mesh.positions.push_back(Vec3f{{std::sin(t) * std::cos(p), std::cos(t), -std::sin(t) * std::sin(p)}} * radius);
    }
  for (uint32_t i = 0; i < rings; i++)
    for (uint32_t j = 0; j < sectors; j++) {
      const uint32_t a = i * sectors + j, b = i * sectors + (j + 1) % sectors, c = b + sectors, d = a + sectors;
      const Face first = {a, d, c}, second = {a, c, b};
      for (Face face : {first, second}) {
        if (turned) std::swap(face[1], face[2]);
        mesh.faces.push_back(face);
      }
    }
  return mesh;
}

void add(Scene& scene, Mesh mesh, const Material& material, const Transform& to_scene = {}) {
  scene.materials.push_back(material);
  Primitive primitive;
  primitive.mesh = std::move(mesh);
  primitive.material = static_cast<int>(scene.materials.size()) - 1;
  scene.primitives.push_back(std::move(primitive));
  scene.instances.push_back({static_cast<int>(scene.primitives.size()) - 1, to_scene, -1});
}

LampPlan plan(const Scene& scene, size_t most = 16) {
  auto world = World::build(scene);
  EXPECT_TRUE(world);
  return plan_lamps(**world, most);
}

TEST(PlanLamps, FindsARectangleHoweverItIsCutAndTurned) {
  const float angle = 0.3f;
  const Transform turned =
      Transform::translation({{1, 2, 3}}) * Transform::rotation({{0, 0, std::sin(angle / 2), std::cos(angle / 2)}});
  for (uint32_t cuts : {1u, 5u}) {
    Scene scene;
    add(scene, rectangle(0.75f, 0.25f, cuts), emitter({{4, 2, 1}}), turned);
    scene.instances[0].node = 3;
    scene.primitives[0].source_primitive = 2;
    const LampPlan lamps = plan(scene);
    ASSERT_EQ(lamps.client.size(), 1u);
    const ClientLamp& lamp = lamps.client[0];
    EXPECT_EQ(lamp.kind, ClientLamp::Kind::rectangle);
    // Single precision over coordinates of a few metres.
    EXPECT_LT(length(lamp.center - Vec3f{{1, 2, 3}}), 1e-5f);
    EXPECT_LT(length(lamp.normal - Vec3f{{0, 0, 1}}), 1e-5f);
    const Vec3f expected = turned.vector(Vec3f{{0.75f, 0, 0}});
    EXPECT_LT(std::min(length(lamp.half_u - expected), length(lamp.half_u + expected)), 1e-4f);
    EXPECT_NEAR(length(lamp.half_v), 0.25f, 1e-4f);
    EXPECT_LT(length(lamp.radiance - Vec3f{{4, 2, 1}}), 1e-4f);
    EXPECT_NEAR(lamp.power, 7.0f / 3 * pi * 0.75f, 1e-3f);
    EXPECT_EQ(lamp.luminaire, (LuminaireId{LuminaireId::Kind::surface, 3, 0, 2, 0}));
    EXPECT_EQ(lamps.contained, luminaires({0}));
  }
}

// A regular polygon of radius 1 round the origin, facing +z, from its middle or as a ring with a hole.
Mesh polygon(uint32_t sides, float hole = 0) {
  Mesh mesh;
  for (uint32_t i = 0; i < sides; i++) {
    const float angle = 2 * pi * static_cast<float>(i) / static_cast<float>(sides);
    const Vec3f corner{{std::cos(angle), std::sin(angle), 0}};
    mesh.positions.insert(mesh.positions.end(), {corner * hole, corner});
  }
  for (uint32_t i = 0; i < 2 * sides; i += 2) {
    const uint32_t next = (i + 2) % (2 * sides);
    mesh.faces.push_back({i, i + 1, next + 1});
    if (hole > 0) mesh.faces.push_back({i, next + 1, next});
  }
  return mesh;
}

// Its area, and so its power, is the surface's, however many sides that has.
TEST(PlanLamps, FindsADisc) {
  const Transform placed = Transform::translation({{1, 2, 3}}) *
                           Transform::rotation({{std::sqrt(0.5f), 0, 0, std::sqrt(0.5f)}}) *
                           Transform::scaling({{0.3, 0.3, 0.3}});
  for (const uint32_t sides : {6u, 8u, 32u}) {
    Scene scene;
    add(scene, polygon(sides), emitter({{4, 2, 1}}), placed);
    scene.materials.back().double_sided = sides == 8;
    const LampPlan lamps = plan(scene);
    ASSERT_EQ(lamps.client.size(), 1u);
    const ClientLamp& lamp = lamps.client[0];
    EXPECT_EQ(lamp.kind, ClientLamp::Kind::disc);
    EXPECT_LT(length(lamp.center - Vec3f{{1, 2, 3}}), 1e-5f);
    EXPECT_LT(length(lamp.normal - Vec3f{{0, -1, 0}}), 1e-5f);
    const float n = static_cast<float>(sides), area = 0.09f * n / 2 * std::sin(2 * pi / n);
    // Single precision.
    EXPECT_NEAR(pi * lamp.radius * lamp.radius, area, 1e-5f);
    EXPECT_LT(length(lamp.radiance - Vec3f{{4, 2, 1}}), 1e-4f);
    EXPECT_EQ(lamp.two_sided, sides == 8);
    EXPECT_NEAR(lamp.power, 7.0f / 3 * pi * area * (lamp.two_sided ? 2 : 1), 1e-4f);
  }
}

// Squares, pentagons, ellipses and rings are rectangles of the same area.
TEST(PlanLamps, TakesOnlyDiscsForDiscs) {
  Scene scene;
  add(scene, polygon(4), emitter({{1, 1, 1}}));
  add(scene, polygon(5), emitter({{1, 1, 1}}));
  add(scene, polygon(32), emitter({{1, 1, 1}}), Transform::scaling({{1, 0.9, 1}}));
  add(scene, polygon(32, 0.2f), emitter({{1, 1, 1}}));
  const LampPlan lamps = plan(scene);
  ASSERT_EQ(lamps.client.size(), 4u);
  for (const ClientLamp& lamp : lamps.client) EXPECT_EQ(lamp.kind, ClientLamp::Kind::rectangle);
}

// A node that mirrors turns the winding of its faces, not the side that shines.
TEST(PlanLamps, AMirroredLampShinesToTheSameSide) {
  Scene scene;
  add(scene, rectangle(1, 1), emitter({{1, 1, 1}}), Transform::scaling({{-1, 1, 1}}));
  add(scene, sphere(0.5f, false), emitter({{1, 1, 1}}), Transform::scaling({{1, -1, 1}}));
  const LampPlan lamps = plan(scene);
  ASSERT_EQ(lamps.client.size(), 2u);
  EXPECT_EQ(lamps.client[0].kind, ClientLamp::Kind::rectangle);
  EXPECT_LT(length(lamps.client[0].normal - Vec3f{{0, 0, 1}}), 1e-5f);
  EXPECT_EQ(lamps.client[1].kind, ClientLamp::Kind::sphere);
}

// Of what it sends out a double-sided sphere keeps half inside; its radiance is the material's.
TEST(PlanLamps, ADoubleSidedSphereHasItsMaterialsRadiance) {
  Scene scene;
  add(scene, sphere(0.5f, false), emitter({{5, 5, 5}}));
  scene.materials.back().double_sided = true;
  const LampPlan lamps = plan(scene);
  ASSERT_EQ(lamps.client.size(), 1u);
  EXPECT_NEAR(lamps.client[0].radiance[0], 5, 1e-3f);
}

// A fluorescent tube and a dome are no spheres, though all of them looks away from their middle: the grid takes them.
TEST(PlanLamps, LeavesTubesAndDomesToTheGrid) {
  Scene scene;
  add(scene, sphere(0.5f, false), emitter({{1, 1, 1}}), Transform::scaling({{0.05, 2, 0.05}}));
  Mesh dome = sphere(0.5f, false);
  dome.faces.resize(dome.faces.size() / 2);
  add(scene, dome, emitter({{1, 1, 1}}));
  const LampPlan lamps = plan(scene);
  EXPECT_TRUE(lamps.client.empty());
  EXPECT_EQ(lamps.contained, luminaires({1, 1}));
}

TEST(PlanLamps, TakesASphereAndLeavesAnInwardOneToTheGrid) {
  Scene scene;
  add(scene, sphere(0.5f, false), emitter({{1, 1, 1}}));
  add(scene, sphere(3, true), emitter({{1, 1, 1}}));
  const LampPlan lamps = plan(scene);
  ASSERT_EQ(lamps.client.size(), 1u);
  EXPECT_EQ(lamps.client[0].kind, ClientLamp::Kind::sphere);
  EXPECT_NEAR(lamps.client[0].radius, 0.5f, 0.005f);  // the polyhedron lies inside the sphere
  EXPECT_EQ(lamps.contained, luminaires({0, 1}));
}

TEST(PlanLamps, KeepsTheStrongest) {
  Scene scene;
  add(scene, rectangle(1, 1), Material{});
  for (int i = 0; i < 20; i++) {
    Lamp lamp;
    lamp.intensity = Vec3f::filled(static_cast<float>(1 + i));
    scene.lamps.push_back(lamp);
  }
  const LampPlan lamps = plan(scene, 16);
  ASSERT_EQ(lamps.client.size(), 16u);
  EXPECT_EQ(lamps.client.front().intensity[0], 20);
  EXPECT_EQ(lamps.client.back().intensity[0], 5);
  for (int i = 0; i < 20; i++) EXPECT_EQ(lamps.contained.contains(i), i < 4);
}

// A sliver without area and a face below a black texel give no light: no lamp, though there is room for more.
// A picture in sRGB that is white inside of rectangles of texels, and black elsewhere; `cut_at`: the first texel and
// the one behind the last.
struct Lit {
  std::array<int, 2> first, last;
};
Image picture(int width, int height, std::initializer_list<Lit> lit) {
  Image image{width, height, 3, {}};
  image.pixels.assign(static_cast<size_t>(width * height * 3), 0);
  for (const Lit& part : lit)
    for (int y = part.first[1]; y < part.last[1]; y++)
      for (int x = part.first[0]; x < part.last[0]; x++)
        std::fill_n(image.pixels.begin() + 3 * (y * width + x), 3, uint8_t{255});
  return image;
}

// A screen of 2 by 1 m round the origin that shows a picture, in quads of 4 by 4.
Scene screen(Image image) {
  Scene scene;
  scene.images.push_back(std::move(image));
  Material material = emitter({{3, 2, 1}});
  material.emission_texture.image = 0;
  Mesh mesh = rectangle(1, 0.5f, 4);
  for (const Vec3f& p : mesh.positions) mesh.texcoords[0].push_back({{(p[0] + 1) / 2, 0.5f - p[1]}});
  add(scene, std::move(mesh), material);
  return scene;
}

float power_of(const std::vector<ClientLamp>& lamps) {
  float power = 0;
  for (const ClientLamp& lamp : lamps)
    power += mean_of_channels(lamp.radiance) * 4 * length(lamp.half_u) * length(lamp.half_v) * pi;
  return power;
}

TEST(PlanLamps, AScreenShinesWhereItsPictureDoes) {
  // The left quarter of the upper half.
  const LampPlan found = plan(screen(picture(64, 32, {{{0, 0}, {16, 16}}})));
  ASSERT_EQ(found.client.size(), 1u);
  const ClientLamp& lamp = found.client[0];
  // Lookups fade over a texel, 3 cm, at the part's edges.
  EXPECT_LT(length(lamp.center - Vec3f{{-0.75f, 0.25f, 0}}), 0.02f);
  EXPECT_NEAR(length(lamp.half_u) * length(lamp.half_v), 0.25f * 0.25f, 0.006f);
  // 1/8 of the area, half a texel more to the right and below.
  EXPECT_NEAR(power_of(found.client), pi * 2 * (16.f * 16.f) / (64 * 32) * 2, 0.01f * pi * 2);
  EXPECT_EQ(found.contained, LuminaireSet());
}

TEST(PlanLamps, PartsOfAPictureThatLieApartAreLampsOfTheirOwn) {
  const Image image = picture(256, 128, {{{16, 16}, {48, 48}}, {{160, 80}, {240, 112}}, {{176, 8}, {200, 24}}});
  const LampPlan found = plan(screen(image));
  ASSERT_EQ(found.client.size(), 3u);
  EXPECT_GE(found.client[0].power, found.client[1].power);
  EXPECT_NEAR(found.client[0].center[0], 2 * 200 / 256.f - 1, 0.02f);
  EXPECT_NEAR(found.client[0].center[1], 0.5f - 96 / 128.f, 0.02f);
  for (const ClientLamp& lamp : found.client) EXPECT_EQ(lamp.luminaire, found.client[0].luminaire);
  const float lit = 32 * 32 + 80 * 32 + 24 * 16;
  EXPECT_NEAR(power_of(found.client), pi * 2 * 2 * lit / (256 * 128), 0.01f * pi * 4 * lit / (256 * 128));
}

TEST(PlanLamps, APictureTakesNoMoreLampsThanThereAre) {
  Image image = picture(64, 32, {});
  Random random(5, 0);
  for (uint8_t& code : image.pixels) code = static_cast<uint8_t>(255 * random.uniform());
  const LampPlan found = plan(screen(image), 5);
  EXPECT_GE(found.client.size(), 1u);
  EXPECT_LE(found.client.size(), 5u);
  double sum = 0;
  for (const uint8_t code : image.pixels) sum += std::pow((code / 255.0 + 0.055) / 1.055, 2.4);
  // Codes below 0.04 are linear: nothing of the power.
  EXPECT_NEAR(power_of(found.client), 2 * pi * 2 * sum / static_cast<double>(image.pixels.size()), 0.05);
}

TEST(PlanLamps, LeavesOutWhatGivesNoLight) {
  Scene scene;
  add(scene, rectangle(1, 1), emitter({{1, 1, 1}}));
  Mesh sliver;
  sliver.positions = {{{0, 0, 1}}, {{1, 0, 1}}, {{2, 0, 1}}};
  sliver.faces = {{0, 1, 2}};
  add(scene, sliver, emitter({{1, 1, 1}}));
  scene.images.push_back({1, 1, 3, {0, 0, 0}});
  Material black = emitter({{1, 1, 1}});
  black.emission_texture.image = 0;
  add(scene, rectangle(2, 2), black);
  const LampPlan lamps = plan(scene);
  ASSERT_EQ(lamps.client.size(), 1u);
  EXPECT_EQ(lamps.client[0].radiance, (Vec3f{{1, 1, 1}}));
}

TEST(PlanLamps, GivesTheEnvironmentToTheGrid) {
  Scene scene;
  add(scene, rectangle(1, 1), Material{});
  scene.environment.radiance = Vec3f::filled(1);
  const LampPlan lamps = plan(scene);
  EXPECT_TRUE(lamps.client.empty());
  EXPECT_EQ(lamps.contained, luminaires({1}));
}

}  // namespace
}  // namespace lightwell
