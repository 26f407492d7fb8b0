// SPDX-License-Identifier: Apache-2.0
#include "lightwell/light/atlas.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "lightwell/light/record.h"
#include "tests/light/atlas_lookup.h"
#include "tests/light/brick_fields.h"

namespace lightwell {
namespace {

// Coefficients are rounded to halves (2^-11 each); a sum of nine that partly cancel errs by a few times that of the
// largest.
constexpr float half_rounding = 4 * 0x1p-11f;

float largest_irradiance(const LightGrid& grid) { return 1024 / light_scale(grid); }

// A grid with solids, filled as a baker leaves it.
LightGrid some_grid(uint64_t seed) {
  Random random(seed, 9);
  LightGrid grid = lamp_grid(random_shape(random, 6), seed, 0, true);
  grid.normal_offset = 0.5f;
  fill_invalid(grid);
  return grid;
}

Vec3f somewhere(Random& random, const GridShape& shape) {
  return shape.lo + (shape.hi() - shape.lo) * (random_colour(random) * 1.2f - Vec3f::filled(0.1f));
}

TEST(SphericalHarmonics, AreTheMomentsExactly) {
  Random random(1, 0);
  for (int i = 0; i < 200; i++) {
    const Moments m = uniform_light(random_colour(random)) * 0.1f;
    Moments lit = m;
    lit += parallel_light(random_direction(random), random_colour(random));
    LightAtlas atlas(GridShape{}, 0, 1);
    LightGrid grid;
    grid.moments.assign(8, lit);
    grid.valid.assign(8, 1);
    atlas.update(grid);
    const Vec3f n = random_direction(random);
    const Vec3f a = AtlasLookup(atlas).irradiance({}, n), b = lit.irradiance(n);
    for (int c = 0; c < 3; c++) EXPECT_NEAR(a[c], b[c], half_rounding);
  }
}

TEST(LightAtlas, LooksUpWhatTheGridDoes) {
  for (uint64_t seed = 0; seed < 20; seed++) {
    const LightGrid grid = some_grid(seed);
    LightAtlas atlas(grid.shape, grid.normal_offset, light_scale(grid));
    atlas.update(grid);
    EXPECT_EQ(atlas.halves().size(), static_cast<size_t>(atlas.width() * atlas.height() * atlas.depth() * 4));
    Random random(seed, 1);
    for (int i = 0; i < 100; i++) {
      const Vec3f p = somewhere(random, grid.shape), n = random_direction(random);
      const Vec3f node = (p - grid.shape.lo) / grid.shape.cell + n * grid.normal_offset;
      const Vec3f a = AtlasLookup(atlas).irradiance(node, n), b = grid.irradiance(p, n);
      for (int c = 0; c < 3; c++) EXPECT_NEAR(a[c], b[c], half_rounding * largest_irradiance(grid));
    }
  }
}

TEST(LightAtlas, LooksUpWhatAGridWithBricksDoes) {
  for (uint64_t seed = 0; seed < 20; seed++) {
    const LightGrid grid = bricked_grid(seed, 1 + 3 * static_cast<int>(seed));
    LightAtlas atlas(grid.shape, grid.normal_offset, light_scale(grid), grid.tree);
    EXPECT_EQ(atlas.halves().size(), 4 * LightAtlas::texels(grid.shape, grid.tree));
    atlas.update(grid);
    Random random(seed, 1);
    for (int i = 0; i < 200; i++) {
      const Vec3f p = somewhere(random, grid.shape), n = random_direction(random);
      const Vec3f place = (p - grid.shape.lo) / grid.shape.cell;
      const Vec3f a = AtlasLookup(atlas).irradiance_of_bricks(place, n), b = grid.irradiance(p, n);
      for (int c = 0; c < 3; c++) EXPECT_NEAR(a[c], b[c], half_rounding * largest_irradiance(grid)) << "at " << i;
    }
  }
}

// Bricks that have not come yet show the coarser cells around them.
TEST(LightAtlas, LooksUpWhatHasComeOfTheBricks) {
  const LightGrid whole = bricked_grid(4, 40);
  LightAtlas atlas(whole.shape, whole.normal_offset, light_scale(whole), whole.tree);
  for (size_t count = 1; count <= whole.bricks.size(); count++) {
    LightGrid grid = whole;
    grid.tree = BrickTree(whole.shape.cells());
    for (size_t brick = 0; brick < count; brick++) grid.tree.add(whole.tree.bricks()[brick]);
    grid.bricks.resize(count);
    atlas.update(grid);
    Random random(count, 1);
    for (int i = 0; i < 20; i++) {
      const Vec3f p = somewhere(random, grid.shape), n = random_direction(random);
      const Vec3f place = (p - grid.shape.lo) / grid.shape.cell;
      const Vec3f a = AtlasLookup(atlas).irradiance_of_bricks(place, n), b = grid.irradiance(p, n);
      for (int c = 0; c < 3; c++) EXPECT_NEAR(a[c], b[c], half_rounding * largest_irradiance(grid)) << count;
    }
  }
}

// Even where the brightest light is as bright as a grid can hold, the weight of no node is a subnormal half.
TEST(LightAtlas, WeightsAreNormalHalves) {
  LightGrid grid = some_grid(3);
  std::fill(grid.valid.begin(), grid.valid.end(), uint8_t(0));
  for (const float scale : {0x1p-11f, 1.0f, 0x1p15f}) {
    LightAtlas atlas(grid.shape, grid.normal_offset, scale);
    atlas.update(grid);
    const int weights = 6 * (grid.shape.nodes[2] + 2);
    for (int slice = weights; slice < atlas.depth(); slice++)
      for (int y = 0; y < atlas.height(); y++)
        for (int x = 0; x < atlas.width(); x++) EXPECT_GE(AtlasLookup(atlas).texel(x, y, slice)[3], 0x1p-14f);
  }
}

// tests/data/light/lookup.json is what the page's shader is tested against in a browser: a regular grid and one with
// bricks, each an atlas, placements as uniforms, world points and normals, and the irradiance that they must give,
// trilinear and tricubic. LIGHTWELL_UPDATE_TEST_DATA=1 writes it anew.
std::string lookup_fixture(const LightGrid& grid) {
  const GridShape& shape = grid.shape;
  LightGrid spline = grid;
  spline.lookup = LightLookup::tricubic;
  LightAtlas atlas(shape, grid.normal_offset, light_scale(grid), grid.tree);
  atlas.update(grid);

  std::ostringstream json;
  json.precision(9);
  const auto list = [&](const auto& values) {
    json << "[";
    for (size_t i = 0; i < values.size(); i++) json << (i ? "," : "") << values[i];
    json << "]";
  };
  json << "{\"nodes\":";
  list(shape.nodes.e);
  json << ",\"width\":" << atlas.width() << ",\"height\":" << atlas.height() << ",\"depth\":" << atlas.depth()
       << ",\n\"halves\":";
  list(atlas.halves());
  const float half = std::sqrt(0.5f);
  const std::array<GridPlacement, 4> placements{{{{}, {{0, 0, 0, 1}}, {{1, 1, 1}}},
                                                 {{{5, -2, 1}}, {{0, half, 0, half}}, {{2, 2, 2}}},
                                                 {{{1, 2, 3}}, {{0.48f, 0.6f, 0, 0.64f}}, {{1, 3, 0.5f}}},
                                                 {{{1, 2, 3}}, {{0, 0.6f, 0, -0.8f}}, {{-1, 1, 1}}}}};
  json << ",\n\"placements\":[";
  for (size_t k = 0; k < placements.size(); k++) {
    const GridPlacement& placement = placements[k];
    json << (k ? ",\n" : "\n") << "{\"min\":";
    list(placement.uniform_min(shape).e);
    json << ",\"max\":";
    list(placement.uniform_max().e);
    json << ",\"resolution\":";
    list(placement.uniform_resolution(shape).e);
    json << ",\n\"samples\":[";
    Random random(12, k);
    for (int i = 0; i < 12; i++) {
      const Vec3f p = shape.lo + (shape.hi() - shape.lo) * random_colour(random), n = random_direction(random);
      json << (i ? ",\n" : "\n") << "{\"point\":";
      list(placement.point(p).e);
      json << ",\"normal\":";
      list(placement.normal(n).e);
      json << ",\"irradiance\":";
      list(grid.irradiance(p, n).e);
      json << ",\"tricubic\":";
      list(spline.irradiance(p, n).e);
      json << "}";
    }
    json << "]}";
  }
  json << "]}";
  return json.str();
}

std::string lookup_fixtures() {
  GridShape shape{{{-1, 0, 2}}, {{0.5f, 0.75f, 0.25f}}, {{3, 2, 4}}};
  LightGrid grid = lamp_grid(shape, 11);
  grid.normal_offset = 0.375f;
  grid.valid[shape.index({{1, 1, 2}})] = 0;
  fill_invalid(grid);
  std::ostringstream json;
  json << "[" << lookup_fixture(grid) << ",\n" << lookup_fixture(bricked_grid(6, 6)) << "]\n";
  return json.str();
}

TEST(LightAtlas, ThePagesFixtureIsCurrent) {
  const std::string path = LIGHTWELL_TEST_DATA "/light/lookup.json";
  const std::string current = lookup_fixtures();
  if (std::getenv("LIGHTWELL_UPDATE_TEST_DATA")) std::ofstream(path) << current;
  std::ostringstream stored;
  stored << std::ifstream(path).rdbuf();
  EXPECT_EQ(stored.str(), current) << "LIGHTWELL_UPDATE_TEST_DATA=1 writes " << path << " anew";
}

}  // namespace
}  // namespace lightwell
