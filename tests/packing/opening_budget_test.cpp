// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/opening_budget.h"

#include <gtest/gtest.h>

#include <numeric>

#include "lightwell/base/random.h"
#include "tests/mesh/shapes.h"

namespace lightwell {
namespace {

using Forms = std::vector<OpeningForm>;

uint64_t bytes_of(const std::vector<Forms>& meshes, const std::vector<size_t>& chosen) {
  uint64_t bytes = 0;
  for (size_t i = 0; i < meshes.size(); i++) bytes += meshes[i][chosen[i]].bytes;
  return bytes;
}

// Forms as meshes have them: to the coarser fewer bytes and no smaller errors; 400 bytes for a stream.
Forms random_forms(Random& random) {
  uint64_t bytes = 200 + random.below(50000);
  Forms forms = {{bytes, 0}};
  const uint32_t rounds = random.below(12);
  for (uint32_t i = 0; i < rounds; i++) {
    bytes = bytes * (50 + random.below(40)) / 100;
    forms.push_back({400 + bytes, forms.back().error + (random.below(3) == 0 ? 0 : random.uniform())});
  }
  return forms;
}

TEST(ShareOpening, GivesALargeMeshTheFinestFormThatFits) {
  const std::vector<Forms> meshes = {{{100000, 0}, {60000, 0.1f}, {30000, 0.2f}, {9000, 0.4f}}};
  EXPECT_EQ(share_opening(meshes, {40000, 40000, 0})[0], 2u);
  EXPECT_EQ(share_opening(meshes, {1000, 1000, 0})[0], 3u);
  EXPECT_EQ(share_opening(meshes, {100000, 100000, 0})[0], 0u);
}

TEST(ShareOpening, ShowsAMeshWholeThatIsSmallerThanItsStream) {
  const std::vector<Forms> meshes = {{{500, 0}, {700, 0.1f}, {600, 5}}};
  EXPECT_EQ(share_opening(meshes, {0, 0, 0})[0], 0u);
}

TEST(ShareOpening, MakesNoStreamsForThousandsOfSmallParts) {
  const std::vector<Forms> meshes(5000, Forms{{1500, 0}, {1100, 0.1f}, {800, 1}});
  EXPECT_EQ(share_opening(meshes, {40960, 262144, 0.1f}), std::vector<size_t>(5000, 0));
}

// A wall that stands off by a metre is seen before a cup that does by a centimetre.
TEST(ShareOpening, GivesBytesWhereTheErrorIsLargest) {
  const std::vector<Forms> meshes = {{{9000, 0}, {5000, 0.005f}, {1000, 0.01f}}, {{9000, 0}, {5000, 0.5f}, {1000, 1}}};
  EXPECT_EQ(share_opening(meshes, {6500, 6500, 0}), (std::vector<size_t>{2, 1}));
  EXPECT_EQ(share_opening(meshes, {10500, 10500, 0}), (std::vector<size_t>{2, 0}));
}

// Bytes that take no error away are not spent.
TEST(ShareOpening, LeavesFlatSheetsCoarse) {
  EXPECT_EQ(share_opening({{{90000, 0}, {40000, 0}, {1000, 0}}}, {60000, 60000, 0})[0], 2u);
}

TEST(ShareOpening, KeepsToTheBudgetAndLeavesNothingThatFits) {
  for (uint64_t seed = 0; seed < 300; seed++) {
    SCOPED_TRACE(seed);
    Random random(seed, 0);
    std::vector<Forms> meshes;
    const uint32_t count = random.below(40);
    for (uint32_t i = 0; i < count; i++) meshes.push_back(random_forms(random));
    std::vector<size_t> coarsest;
    for (const Forms& forms : meshes) coarsest.push_back(forms.size() - 1);
    const uint64_t usual = random.below(200000), most = usual + random.below(200000);
    const OpeningBudget budget{usual, most, random.uniform()};
    const std::vector<size_t> chosen = share_opening(meshes, budget);
    const uint64_t taken = bytes_of(meshes, chosen);
    const uint64_t spared = 1500 * meshes.size();  // what no stream is made for
    EXPECT_LE(taken, std::max(most, bytes_of(meshes, coarsest) + spared));
    for (size_t i = 0; i < meshes.size(); i++)
      for (size_t finer = chosen[i]; finer-- > 0;) {
        if (meshes[i][finer].error >= meshes[i][chosen[i]].error) continue;
        EXPECT_GT(taken - meshes[i][chosen[i]].bytes + meshes[i][finer].bytes,
                  meshes[i][chosen[i]].error > budget.likeness ? most : usual);
        break;
      }
  }
}

TEST(ShareOpening, TakesNothing) { EXPECT_TRUE(share_opening({}, {1000, 1000, 0}).empty()); }

// Beyond the usual bytes nothing is made finer than the likeness asks for.
TEST(ShareOpening, SpendsMoreForALikenessAlone) {
  const std::vector<Forms> meshes = {{{90000, 0}, {20000, 0.1f}, {9000, 0.3f}, {1000, 2}},
                                     {{90000, 0}, {9000, 0.1f}, {1000, 0.2f}}};
  EXPECT_EQ(share_opening(meshes, {2000, 60000, 0.5f}), (std::vector<size_t>{2, 2}));
  EXPECT_EQ(share_opening(meshes, {2000, 60000, 0.25f}), (std::vector<size_t>{1, 2}));
  EXPECT_EQ(share_opening(meshes, {2000, 2000, 0.5f}), (std::vector<size_t>{3, 2}));
}

TEST(OpeningBudget, GrowsWithThePartsWithinBounds) {
  EXPECT_EQ(OpeningBudget::of(0, 0, 10).bytes_for_likeness, 40960u);
  EXPECT_EQ(OpeningBudget::of(1, 0, 10).bytes, 40960u);
  EXPECT_EQ(OpeningBudget::of(100, 0, 10).bytes_for_likeness, 153600u);
  EXPECT_EQ(OpeningBudget::of(100, 0, 10).bytes, 40960u);
  EXPECT_EQ(OpeningBudget::of(5000, 0, 10).bytes_for_likeness, 262144u);
  EXPECT_EQ(OpeningBudget::of(5000, 0, 10).likeness, 0.2f);
  EXPECT_EQ(OpeningBudget::of(10, 50, 10).bytes_for_likeness, 15360u + 55000u);
}

TEST(OpeningForms, CountBytesAndScaleErrors) {
  Progress silent;
  const Mesh mesh = seamed_sphere(24, 32);
  const SimplifiedMesh simplified = simplify(mesh, {{}, 8}, silent).value();
  const Forms forms = opening_forms(mesh, simplified, 1), doubled = opening_forms(mesh, simplified, 2);
  ASSERT_EQ(forms.size(), simplified.order.rounds.size() + 1);
  const size_t vertex = 12 + 12 + 8 + 8;
  EXPECT_EQ(forms[0].bytes, 400 + vertex * mesh.positions.size() + 6 * mesh.faces.size());
  EXPECT_EQ(forms[0].error, 0);
  for (size_t i = 1; i < forms.size(); i++) {
    EXPECT_GE(forms[i].error, forms[i - 1].error);
    EXPECT_EQ(doubled[i].error, 2 * forms[i].error);
  }
}

}  // namespace
}  // namespace lightwell
