// SPDX-License-Identifier: Apache-2.0
//
// --sky, the physical sky of a scene's sun, as its users meet it.
#include <cmath>

#include "lightwell/scene/physical_sky.h"
#include "lightwell/scene/sky_map.h"
#include "tests/cli/commands.h"

namespace lightwell {
namespace {

/// A ground of 8 by 8 metres with a wall across its middle, one metre high, and a sun of irradiance 2 at 45 degrees,
/// over +z, which is in front of the wall.
std::string courtyard(bool with_sun = true) {
  json gltf = {
      {"asset", {{"version", "2.0"}}},
      {"scene", 0},
      {"scenes", {{{"nodes", {0}}}}},
      {"nodes", {{{"mesh", 0}}}},
      {"materials",
       {{{"doubleSided", true},
         {"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.5, 0.5, 1}}, {"metallicFactor", 0}}},
         {"extensions", {{"KHR_materials_specular", {{"specularFactor", 0}}}}}}}},
      {"extensionsUsed", {"KHR_materials_specular", "KHR_lights_punctual"}},
  };
  const std::vector<float> corners = {-4, 0, -4, -4, 0, 4, 4, 0, 4, 4, 0, -4, -4, 0, 0, 4, 0, 0, 4, 1, 0, -4, 1, 0};
  const std::vector<uint16_t> faces = {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7};
  std::string bytes(reinterpret_cast<const char*>(corners.data()), 4 * corners.size());
  bytes.append(reinterpret_cast<const char*>(faces.data()), 2 * faces.size());
  std::string uri = "data:application/octet-stream,";
  for (const char c : bytes) {
    char code[4];
    std::snprintf(code, sizeof code, "%%%02x", static_cast<uint8_t>(c));
    uri += code;
  }
  gltf["buffers"] = {{{"byteLength", bytes.size()}, {"uri", uri}}};
  gltf["bufferViews"] = {{{"buffer", 0}, {"byteLength", 96}}, {{"buffer", 0}, {"byteOffset", 96}, {"byteLength", 24}}};
  gltf["accessors"] = {{{"bufferView", 0},
                        {"componentType", 5126},
                        {"count", 8},
                        {"type", "VEC3"},
                        {"min", {-4, 0, -4}},
                        {"max", {4, 1, 4}}},
                       {{"bufferView", 1}, {"componentType", 5123}, {"count", 12}, {"type", "SCALAR"}}};
  gltf["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}, {"material", 0}}}}}};
  if (with_sun) {
    gltf["extensions"] = {{"KHR_lights_punctual", {{"lights", {{{"type", "directional"}, {"intensity", 2}}}}}}};
    gltf["nodes"].push_back({{"rotation", {-std::sin(M_PI / 8), 0, 0, std::cos(M_PI / 8)}},
                             {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    gltf["scenes"][0]["nodes"].push_back(1);
  }
  return gltf.dump();
}

Lamp sun_of_courtyard() {
  Lamp sun;
  sun.kind = Lamp::Kind::sun;
  sun.direction = normalized(Vec3f{{0, -1, -1}});
  sun.intensity = Vec3f::filled(2);
  return sun;
}

class Sky : public Commands {
 protected:
  std::string scene(const std::string& text = courtyard()) const {
    write("courtyard.gltf", text);
    return path("courtyard.gltf");
  }
};

constexpr const char* up_high = "x,y,z,nx,ny,nz\n0,3,0,0,1,0\n";

// What the path tracer finds facing the whole sky is the integral of the picture, and the sun's share.
TEST_F(Sky, LightsTheGroundByItsIntegral) {
  const std::vector<double> found = probed(scene() + " --sky 4 --spp 4000 --quantity direct", up_high);
  const RadianceImage map = *physical_sky(sun_of_courtyard(), 4).map;
  for (int c = 0; c < 3; c++) {
    double expected = 2 * std::sqrt(0.5);
    for (size_t i = 0; i < map.pixels.size() / 6; i++)
      expected += static_cast<double>(pixel_radiance(map, i)[c] * pixel_direction(map, i)[1]) *
                  solid_angle(static_cast<int>(i / static_cast<size_t>(map.width)), map);
    EXPECT_NEAR(found[static_cast<size_t>(c)], expected, 0.02 * expected);  // 4000 samples: 0.6 % and less of noise
  }
}

// On the ground before and behind the wall, and on its front: the pack, which keeps its sky, against the path tracer.
// The wall has no thickness, so that its back is left out.
TEST_F(Sky, OfABakeIsThatOfThePathTracer) {
  const std::string points = "x,y,z,nx,ny,nz\n0,0,1.5,0,1,0\n1,0,-2,0,1,0\n-1,0.6,0,0,0,1\n";
  const std::string file = scene(), pack = path("courtyard.lw.glb");
  const Outcome baked = run("bake " + file + " --sky -o " + pack + " --quiet");
  ASSERT_EQ(baked.status, 0) << baked.err;
  const std::vector<double> truth = probed(file + " --sky --spp 4000 --quantity total", points);
  const std::vector<double> found = probed(pack + " --integrator ivg --quantity total", points);
  ASSERT_EQ(truth.size(), found.size());
  // A grid of few cells beside a wall, whose nine moments a node do not hold a bright spot to better than a tenth.
  for (size_t i = 0; i < truth.size(); i++) EXPECT_NEAR(found[i], truth[i], 0.1 * truth[i]) << i;
}

TEST_F(Sky, StaysInThePackUntilItIsReplaced) {
  const std::string pack = path("courtyard.lw.glb");
  ASSERT_EQ(run("bake " + scene() + " --sky=6 --preview -o " + pack + " --quiet").status, 0);
  const Outcome rendered = run("render " + pack + " --spp 4 --size 32x32 -o " + path("a.pfm"));
  EXPECT_EQ(rendered.status, 0) << rendered.err;
  EXPECT_EQ(rendered.err.find("give it with --environment"), std::string::npos) << rendered.err;
  ASSERT_EQ(run("render " + scene() + " --sky 6 --spp 4 --size 32x32 -o " + path("b.pfm")).status, 0);
  ASSERT_EQ(run("render " + pack + " --environment 0,0,0 --spp 4 --size 32x32 -o " + path("c.pfm")).status, 0);
  const auto mean = [&](const std::string& other) {
    return json::parse(run("diff --json " + path("a.pfm") + " " + path(other)).out)["mean"].get<double>();
  };
  EXPECT_LT(mean("b.pfm"), 0.05 * mean("c.pfm"));
}

TEST_F(Sky, TakesAValueOnlyWhereThereIsOne) {
  const std::string file = scene(), rest = " --spp 1 --size 8x8 --quiet -o " + path("sky.pfm");
  for (const std::string& arguments : {"--sky " + file, "--sky 3 " + file, file + " --sky", "--sky=3 " + file}) {
    const Outcome rendered = run("render " + arguments + rest);
    EXPECT_EQ(rendered.status, 0) << arguments << rendered.err;
  }
}

TEST_F(Sky, SaysWhatIsWrong) {
  const std::string file = scene(), out = " -o " + path("out.lw.glb");
  for (const auto& [arguments, status, words] : std::vector<std::tuple<std::string, int, std::string>>{
           {"bake " + file + " --sky 0.5" + out, 2, "--sky: 0.5: is not a number from 1 to 10"},
           {"bake " + file + " --sky=hazy" + out, 2, "--sky: hazy: is not a number from 1 to 10"},
           {"bake " + file + " --sky --environment 1,1,1" + out, 2, "--environment excludes --sky"},
           {"bake " + scene(courtyard(false)) + " --sky" + out, 1, "--sky: the scene has no sun"},
           {"render box-small --sky -o " + path("box.png"), 1, "--sky: the scene has no sun"}}) {
    const Outcome refused = run(arguments);
    EXPECT_EQ(refused.status, status) << arguments;
    EXPECT_EQ(refused.lines(), 1u) << refused.err;
    EXPECT_NE(refused.err.find(words), std::string::npos) << refused.err;
  }
}

}  // namespace
}  // namespace lightwell
