// SPDX-License-Identifier: Apache-2.0
//
// How a bake writes the light, as its users meet it: records, and the sky apart.
#include <cmath>

#include "tests/cli/commands.h"

namespace lightwell {
namespace {

class LightOptions : public Commands {
 protected:
  /// The irradiance that a pack's light has at a few places of box-small, 2 m wide.
  std::vector<double> light_of(const std::string& pack) const {
    return probed(pack + " --integrator ivg",
                  "x,y,z,nx,ny,nz\n0.6,0.3,0.6,0,1,0\n-0.5,0.4,0.5,0.6,0.8,0\n0.2,1.5,-0.3,0,0.6,-0.8\n");
  }
};

// The same light by each record, as far as it has steps: those of directions keep one direction for three colours, and
// turn six vectors into as many numbers.
TEST_F(LightOptions, EachRecordHoldsTheSameLight) {
  const std::vector<double> exact = light_of(small_pack("--record floats"));
  ASSERT_GT(*std::min_element(exact.begin(), exact.end()), 0.01);
  const std::vector<std::pair<std::string, double>> records{
      {"moments", 0.03}, {"shared-exponent", 0.01}, {"direction-colour", 0.15}, {"direction-magnitude", 0.3}};
  for (const auto& [record, tolerance] : records) {
    const std::string pack = small_pack("--record " + record);
    EXPECT_EQ(run("verify " + pack).status, 0) << record;
    const std::vector<double> light = light_of(pack);
    for (size_t i = 0; i < exact.size(); i++) EXPECT_NEAR(light[i], exact[i], tolerance * exact[i]) << record;
  }
}

TEST_F(LightOptions, AnUnknownRecordIsNamed) {
  const Outcome baked = run("bake box-small --record hexes -o " + path("box.lw.glb"));
  EXPECT_EQ(baked.status, 2);
  EXPECT_EQ(baked.lines(), 1u);
  EXPECT_NE(baked.err.find("--record: hexes: is not moments, shared-exponent"), std::string::npos) << baked.err;
  EXPECT_FALSE(fs::exists(path("box.lw.glb")));
}

// Two grids over the same nodes, which add up to the one of a bake that does not part them.
TEST_F(LightOptions, TheSkyApartAddsUpToTheWhole) {
  const std::string sky = "--environment 0.5,1,2 --record floats";
  const std::vector<double> whole = light_of(small_pack(sky));
  const std::string pack = small_pack(sky + " --sky-apart always");
  EXPECT_EQ(run("verify " + pack).status, 0);
  const json info = json::parse(run("info --json " + pack).out);
  ASSERT_EQ(info["grids"].size(), 2u);
  EXPECT_EQ(info["grids"][0]["contains"], json({"indirect"}));
  EXPECT_EQ(info["grids"][1]["contains"], json({"environment"}));
  const std::vector<double> parted = light_of(pack);
  // Each part has noise of its own, up to 1.5 % of a node's light and more where it is dark.
  for (size_t i = 0; i < whole.size(); i++) EXPECT_NEAR(parted[i], whole[i], 0.05 * whole[i]);
}

}  // namespace
}  // namespace lightwell
