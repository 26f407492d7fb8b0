// SPDX-License-Identifier: Apache-2.0
//
// The program as its users meet it: what it prints, its exit status, and what it leaves behind.
#include "tests/cli/commands.h"

#include <array>
#include <functional>
#include <numeric>

#include "lightwell/render/picture.h"

namespace lightwell {
namespace {

std::vector<std::string> keys_of(const json& object) {
  std::vector<std::string> keys;
  for (const auto& item : object.items()) keys.push_back(item.key());
  return keys;
}

TEST_F(Commands, HelpNamesEveryCommandAndGivesExamples) {
  const Outcome help = run("--help");
  EXPECT_EQ(help.status, 0);
  for (const char* command :
       {"scenes", "bake", "info", "verify", "serve", "fetch", "render", "probe", "export", "diff"}) {
    EXPECT_NE(help.out.find(command), std::string::npos) << command;
    const Outcome own = run(std::string(command) + " --help");
    EXPECT_EQ(own.status, 0);
    EXPECT_NE(own.out.find("Example"), std::string::npos) << command;
  }
}

TEST_F(Commands, BadInputIsOneLineAndOneAndLeavesNothing) {
  write("broken.glb", "glTF but not really");
  write("empty.ply", "");
  write("text.obj", "v 1 2\nf 1 2 3\n");
  for (const std::string file : {"broken.glb", "empty.ply", "text.obj", "missing.glb"}) {
    const Outcome outcome = run("bake " + path(file) + " -o " + path("out.glb") + " --quiet");
    EXPECT_EQ(outcome.status, 1) << file;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_EQ(outcome.err.rfind("lightwell: " + path(file), 0), 0u) << outcome.err;
    EXPECT_FALSE(fs::exists(path("out.glb")));
  }
}

TEST_F(Commands, ScenesAreListedAndWritten) {
  const json listed = json::parse(run("scenes --json").out);
  ASSERT_EQ(listed["scenes"].size(), 4u);
  EXPECT_EQ(keys_of(listed["scenes"][0]), (std::vector<std::string>{"lights", "name", "triangles"}));
  EXPECT_NE(run("scenes").out.find("box-small     20030 triangles  the same room, the knot less finely carved\n"),
            std::string::npos);
  EXPECT_EQ(run("scenes furnace -o " + path("furnace.glb")).status, 0);
  EXPECT_EQ(read(path("furnace.glb")).substr(0, 4), "glTF");
}

TEST_F(Commands, ASceneWithoutLightIsAnError) {
  write("dark.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const Outcome outcome = run("bake " + path("dark.obj") + " -o " + path("dark.glb") + " --quiet");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(outcome.err, "lightwell: " + path("dark.obj") +
                             ": nothing shines: the scene has no emissive material, no lamp and no environment; "
                             "--environment 1,1,1 lights it from all around\n");
  EXPECT_EQ(
      run("bake " + path("dark.obj") + " -o " + path("lit.glb") + " --environment 1,1,1 --photons 10k --grid 3 --quiet")
          .status,
      0);
}

TEST_F(Commands, BakeReportsTheContractedKeys) {
  const Outcome baked = run("bake box-small -o " + path("a.glb") + " --photons 20k --grid 6 --json");
  ASSERT_EQ(baked.status, 0) << baked.err;
  const json figures = json::parse(baked.out);
  for (const char* key : {"triangles", "vertices", "nodes", "photons", "rays", "seconds", "rays_per_second",
                          "expected_memory", "peak_memory", "pack_bytes", "bytes", "estimated_error", "warnings"})
    EXPECT_TRUE(figures.contains(key)) << key;
  EXPECT_EQ(keys_of(figures["seconds"]), (std::vector<std::string>{"geometry", "import", "light", "write"}));
  EXPECT_EQ(keys_of(figures["bytes"]), (std::vector<std::string>{"geometry", "light", "opening", "texture"}));
  EXPECT_EQ(keys_of(figures["estimate"]), (std::vector<std::string>{"free", "surface"}));
  EXPECT_EQ(figures["pack_bytes"], fs::file_size(path("a.glb")));
  EXPECT_EQ(figures["photons"], 20000);
}

// What was chosen for a grid is said by `bake`, and is what `info` finds.
TEST_F(Commands, GridsAreDescribed) {
  const json baked = json::parse(run("bake box-small -o " + path("a.glb") + " --budget 12k --quiet --json").out);
  const json found = json::parse(run("info " + path("a.glb") + " --json").out)["grids"][0];
  const json& grid = baked["grids"][0];
  EXPECT_EQ(keys_of(grid), (std::vector<std::string>{"bricks", "cell", "contains", "levels", "nodes"}));
  EXPECT_GT(grid["bricks"], 0);
  EXPECT_EQ(grid["nodes"], baked["nodes"]);
  EXPECT_EQ(found["all_nodes"], grid["nodes"]);
  EXPECT_EQ(found["bricks"], grid["bricks"]);
  EXPECT_EQ(found["levels"], grid["levels"]);
  for (const char* where : {"surface", "free"}) EXPECT_NEAR(found["estimate"][where], baked["estimate"][where], 1e-6);
  EXPECT_NEAR(found["bytes_per_node"], baked["bytes"]["light"].get<double>() / grid["nodes"].get<double>(), 0.01);
}

TEST_F(Commands, EveryKindOfGridIsPackedAndRead) {
  for (const std::string options : {"--grid auto", "--grid 6 --order slices", "--grid 6 --order lattice",
                                    "--method tracks", "--order slices", "--preview"}) {
    const std::string pack = path("kind.glb");
    ASSERT_EQ(run("bake box-small -o " + pack + " --photons 20k --quiet " + options).status, 0) << options;
    EXPECT_EQ(run("verify " + pack).status, 0) << options;
    EXPECT_EQ(run("render " + pack + " --integrator ivg --spp 1 --size 16x9 -o " + path("k.png")).status, 0) << options;
  }
  const Outcome refused = run("bake box-small --grid 6 --budget 20k -o " + path("no.glb"));
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.err.find("go with --grid auto"), std::string::npos) << refused.err;
  for (const std::string options :
       {"--order slices --stop-after 1", "--order slices --preview", "--method tracks --budget 5k",
        "--method faces --preview", "--order slices --record floats"}) {
    const Outcome outcome = run("bake box-small " + options + " -o " + path("no.glb"));
    EXPECT_EQ(outcome.status, 1) << options;
    EXPECT_EQ(outcome.lines(), 1u) << outcome.err;
  }
  EXPECT_FALSE(fs::exists(path("no.glb")));
  EXPECT_EQ(run("bake box-small --grid 6 --preview --resume -o " + path("no.glb")).status, 1);
  EXPECT_FALSE(fs::exists(path("no.glb.journal"))) << "what is refused leaves nothing";
}

TEST_F(Commands, ALightThatIsFullLongBeforeItsTargetIsSaid) {
  const std::string bake = "bake box-small --photons 20k --budget 12k -o " + path("a.glb");
  const std::string advice = "the light grid reached its --budget of 12";
  EXPECT_NE(run(bake + " --target-error 1").err.find(advice), std::string::npos);
  EXPECT_EQ(run(bake + " --target-error 60").err.find(advice), std::string::npos);
}

TEST_F(Commands, AdaptiveGridsKeepToBudgetTargetAndTime) {
  const std::string bake = "bake box-small --photons 20k --quiet --json -o " + path("a.glb");
  const auto figures = [&](const std::string& options) { return json::parse(run(bake + options).out); };
  const json small = figures(" --target-error 0 --budget 12k");
  EXPECT_EQ(small["refined_to"], "budget");
  EXPECT_LE(small["bytes"]["light"], 12'000);
  // A few bytes a block were not counted once: they show where there are many.
  const json large = figures(" --target-error 0 --budget 64k");
  EXPECT_EQ(large["refined_to"], "budget");
  EXPECT_LE(large["bytes"]["light"], 64 * 1024);
  EXPECT_EQ(figures(" --target-error 60 --budget 12k")["refined_to"], "target error");
  EXPECT_EQ(figures(" --target-error 0 --stop-after 0 --budget 12k")["refined_to"], "time");
  EXPECT_FALSE(figures(" --grid 6").contains("refined_to"));
}

// What a killed bake has gathered is taken up by the next one, which ends in the same bytes.
TEST_F(Commands, AnInterruptedBakeIsResumedToTheSameBytes) {
  const std::string options = " --photons 20k --quiet --json --budget 12k";
  ASSERT_EQ(run("bake box-small -o " + path("whole.glb") + options).status, 0);
  const std::string journal = path("a.glb.journal");
  ASSERT_EQ(run("bake box-small --resume --stop-after 0 -o " + path("a.glb") + options).status, 0);
  ASSERT_TRUE(fs::exists(journal)) << "a bake that the clock ended can be continued";
  const std::string kept = read(journal);
  ASSERT_GT(kept.size(), 128u * 100);
  // The last record is cut, one before it is damaged: what comes after is forgotten.
  std::string damaged = kept.substr(0, kept.size() - 50);
  damaged[damaged.size() / 2] ^= 1;
  for (const std::string& left : {std::string(), damaged, kept, std::string("no journal at all")}) {
    std::ofstream(journal, std::ios::binary) << left;
    const Outcome resumed = run("bake box-small --resume -o " + path("a.glb") + options);
    ASSERT_EQ(resumed.status, 0) << resumed.err;
    EXPECT_EQ(json::parse(resumed.out)["resumed_nodes"].get<size_t>() > 0, left.size() > 1000);
    EXPECT_EQ(read(path("a.glb")), read(path("whole.glb")));
    EXPECT_FALSE(fs::exists(journal)) << "nothing is left of a complete bake";
  }
  EXPECT_EQ(run("bake box-small --resume -o -" + options).status, 1);
}

TEST_F(Commands, TheSameSeedGivesTheSameBytesForAnyThreads) {
  const std::string one = read(small_pack("--threads 1"));
  EXPECT_EQ(read(small_pack("--threads 3")), one);
  EXPECT_NE(read(small_pack("--seed 2")), one);
}

TEST_F(Commands, VerifyFindsADamagedByte) {
  const std::string pack = small_pack();
  const Outcome good = run("verify " + pack + " --json");
  EXPECT_EQ(good.status, 0) << good.err;
  EXPECT_TRUE(json::parse(good.out)["ok"]);
  std::string bytes = read(pack);
  bytes[bytes.size() - 1000] = static_cast<char>(bytes[bytes.size() - 1000] ^ 4);
  write("damaged.glb", bytes);
  const Outcome bad = run("verify " + path("damaged.glb") + " --json");
  EXPECT_EQ(bad.status, 1);
  EXPECT_FALSE(json::parse(bad.out)["ok"]);
  EXPECT_NE(bad.err.find("block"), std::string::npos);
}

// A closed room with a lamp, at the coordinates of a survey; lamps shine by their material.
std::string room_at(double x, double y, double z) {
  std::string text = "mtllib room.mtl\n";
  const auto vertex = [&](double dx, double dy, double dz) {
    std::ostringstream line;
    line.precision(15);
    line << "v " << x + dx << ' ' << y + dy << ' ' << z + dz << '\n';
    text += line.str();
  };
  for (const double dz : {0.0, 3.0})
    for (const auto& [dx, dy] : {std::pair(0.0, 0.0), std::pair(4.0, 0.0), std::pair(4.0, 2.5), std::pair(0.0, 2.5)})
      vertex(dx, dy, dz);
  for (const auto& [dx, dz] : {std::pair(1.5, 1.0), std::pair(2.5, 1.0), std::pair(2.5, 2.0), std::pair(1.5, 2.0)})
    vertex(dx, 2.4, dz);
  return text +
         "usemtl wall\nf 1 2 3 4\nf 8 7 6 5\nf 1 5 6 2\nf 4 3 7 8\nf 1 4 8 5\nf 2 6 7 3\nusemtl lamp\nf 9 10 11 12\n";
}

// The text of an OBJ file with its positions changed.
std::string moved(const std::string& text, const std::function<std::array<double, 3>(double, double, double)>& move) {
  std::string changed;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream numbers(line);
    std::string keyword;
    double x = 0, y = 0, z = 0;
    if (numbers >> keyword >> x >> y >> z && keyword == "v") {
      line = "v";
      for (const double coordinate : move(x, y, z)) line += ' ' + std::to_string(coordinate);
    }
    changed += line + '\n';
  }
  return changed;
}

TEST_F(Commands, BakeAdvisesOnUnitAndUpAxis) {
  const std::string text = room_at(0, 0, 0);
  write("room.mtl", "newmtl wall\nKd 0.5 0.5 0.5\nnewmtl lamp\nKd 0 0 0\nKe 10 10 10\n");
  write("room.obj", text);
  const std::string bake = "bake " + path("room.obj") + " --grid 4 --photons 20k -o " + path("room.lw.glb");
  const std::string said = run(bake).err;
  EXPECT_EQ(said.find("--unit"), std::string::npos);
  EXPECT_EQ(said.find("--up"), std::string::npos);
  EXPECT_EQ(run(bake + " --unit 1000").err.find("--unit"), std::string::npos);  // it has been said
  write("room.obj", moved(text, [](double x, double y, double z) { return std::array{1000 * x, 1000 * y, 1000 * z}; }));
  EXPECT_NE(run(bake).err.find("4,000 m long: if the file's unit is the millimetre, --unit 0.001"), std::string::npos);
  write("room.obj", moved(text, [](double x, double y, double z) { return std::array{x, -z, y}; }));
  EXPECT_NE(run(bake).err.find("if the file's z axis points up, --up z says so"), std::string::npos);
  EXPECT_EQ(run(bake + " --up z").err.find("--up"), std::string::npos);
}

// Packs and scenes come by a pipe as they come by a file.
TEST_F(Commands, StdinIsReadWhereFilesAre) {
  const std::string pack = small_pack();
  const auto piped = [&](const std::string& file, const std::string& arguments) {
    return run_in_shell("cat " + file + " | timeout 300 " LIGHTWELL_PROGRAM " " + arguments + redirected());
  };
  EXPECT_EQ(piped(pack, "info - --json").out, run("info " + pack + " --json").out);
  EXPECT_EQ(piped(pack, "verify -").status, 0);
  EXPECT_EQ(piped(pack, "export - --quiet -o " + path("a.ply")).status, 0);
  ASSERT_EQ(run("export " + pack + " --quiet -o " + path("b.ply")).status, 0);
  EXPECT_TRUE(read(path("a.ply")) == read(path("b.ply")));
  const std::string render = " --spp 1 --size 16x9 --quiet -o ";
  EXPECT_EQ(piped(pack, "render -" + render + path("a.png")).status, 0);
  ASSERT_EQ(run("render " + pack + render + path("b.png")).status, 0);
  EXPECT_TRUE(read(path("a.png")) == read(path("b.png")));
  ASSERT_EQ(run("scenes box-small -o " + path("scene.glb")).status, 0);
  EXPECT_EQ(
      piped(path("scene.glb"), "bake - --grid 4 --photons 20k --target-error 4 --quiet -o " + path("c.lw.glb")).status,
      0);
  EXPECT_EQ(run("verify " + path("c.lw.glb")).status, 0);
  const Outcome empty = run_in_shell(LIGHTWELL_PROGRAM " info - </dev/null" + redirected());
  EXPECT_EQ(empty.status, 1);
  EXPECT_EQ(empty.err.find("lightwell: stdin: "), 0u) << empty.err;
  EXPECT_EQ(empty.err.find("/proc"), std::string::npos) << empty.err;
}

// The same places, however the file has them: the room turned and given back by --rotate, --up and --front.
TEST_F(Commands, FilesAreTurnedAsTheyAreSaidToStand) {
  const std::string text = room_at(0, 0, 0);
  write("room.mtl", "newmtl wall\nKd 0.5 0.5 0.5\nnewmtl lamp\nKd 0 0 0\nKe 10 10 10\n");
  const auto vertices = [&](const std::string& obj, const std::string& options) {
    write("room.obj", obj);
    EXPECT_EQ(run("bake " + path("room.obj") + " --grid 2 --photons 20k --target-error 4 --quiet -o " +
                  path("r.lw.glb") + options)
                  .status,
              0);
    EXPECT_EQ(run("export " + path("r.lw.glb") + " --quiet -o " + path("r.ply")).status, 0);
    return read(path("r.ply"));
  };
  const std::string straight = vertices(text, "");
  // x to the right, -y ahead, z up; then on its side, and with the front towards x.
  const auto z_up = [](double x, double y, double z) { return std::array{x, -z, y}; };
  EXPECT_TRUE(vertices(moved(text, z_up), " --up z") == straight);
  EXPECT_TRUE(vertices(moved(text, z_up), " --rotate -90,0,0") == straight);
  const auto front_x = [](double x, double y, double z) { return std::array{z, y, -x}; };
  EXPECT_TRUE(vertices(moved(text, front_x), " --front x") == straight);
  const Outcome along = run("bake " + path("room.obj") + " --front -y -o " + path("r.lw.glb"));
  EXPECT_EQ(along.status, 1);
  EXPECT_NE(along.err.find("--front"), std::string::npos) << along.err;
  EXPECT_NE(run("bake box-small --rotate 0,90,0 -o " + path("b.lw.glb")).err.find("are for files of other programs"),
            std::string::npos);
}

// What is far away is lit as at the origin; points are asked for and meshes are written in the file's coordinates.
TEST_F(Commands, APlaceFarAwayIsKept) {
  const double x = 500000, y = 4649776, z = 1024;
  write("room.mtl", "newmtl wall\nKd 0.5 0.5 0.5\nnewmtl lamp\nKd 0 0 0\nKe 10 10 10\n");
  write("near.obj", room_at(0, 0, 0));
  write("far.obj", room_at(x, y, z));
  std::vector<double> light;
  for (const auto& [name, dx, dy, dz] : {std::tuple("near", 0.0, 0.0, 0.0), std::tuple("far", x, y, z)}) {
    const std::string pack = path(std::string(name) + ".lw.glb");
    const Outcome baked = run("bake " + path(std::string(name) + ".obj") + " --grid 8 --json -o " + pack);
    ASSERT_EQ(baked.status, 0) << baked.err;
    EXPECT_GT(json::parse(baked.out)["estimated_error"].get<double>(), 0);
    EXPECT_EQ(run("verify " + pack).status, 0);
    std::ostringstream points;
    points.precision(15);
    points << "x,y,z,nx,ny,nz\n" << dx + 1 << ',' << dy + 1 << ',' << dz + 1.5 << ",0,1,0\n";
    write("points.csv", points.str());
    for (const std::string integrator : {"ivg", "path --spp 4096"}) {
      const Outcome probed =
          run("probe " + pack + " --points " + path("points.csv") + " --json --integrator " + integrator);
      ASSERT_EQ(probed.status, 0) << probed.err;
      light.push_back(json::parse(probed.out)["points"][0]["rgb"][0].get<double>());
    }
    const json origin = json::parse(run("info " + pack + " --json").out)["origin"];
    EXPECT_LE(std::abs(origin[0].get<double>() - dx) + std::abs(origin[1].get<double>() - dy), dx > 0 ? 10 : 0);
    ASSERT_EQ(run("export " + pack + " -o " + path("back.ply")).status, 0);
    const std::string ply = read(path("back.ply"));
    EXPECT_EQ(ply.find("property double x") != std::string::npos, dx > 0);
  }
  // Grids lie differently in both, hence a tenth; paths have a noise of some per cent.
  EXPECT_NEAR(light[2], light[0], 0.1 * light[0]);
  EXPECT_NEAR(light[3], light[1], 0.1 * light[1]);
}

TEST_F(Commands, InfoTellsWhatIsInside) {
  const json info = json::parse(run("info " + small_pack() + " --blocks --json").out);
  for (const char* key : {"scene", "streams", "meshes", "grids", "lamps"}) EXPECT_TRUE(info.contains(key)) << key;
  EXPECT_EQ(info["streams"][0]["kind"], "light");
  EXPECT_EQ(info["streams"][0]["rows"].size(), info["streams"][0]["blocks"]);
  EXPECT_NEAR(info["meshes"][0]["faces"].get<int>(), 20000, 100);
  EXPECT_EQ(info["grids"][0]["contains"][0], "indirect");
  EXPECT_EQ(info["lamps"][0]["kind"], "rectangle");
}

TEST_F(Commands, ExportWritesALevel) {
  const std::string pack = small_pack();
  const json whole = json::parse(run("export " + pack + " -o " + path("whole.glb") + " --json").out);
  const json coarse = json::parse(run("export " + pack + " -o " + path("coarse.ply") + " --level 0.1 --json").out);
  // A level is a whole number of blocks: a tenth of the faces, and at most one block of a thousand vertices more.
  EXPECT_GE(coarse["faces"].get<double>(), 0.1 * whole["faces"].get<double>());
  EXPECT_LE(coarse["faces"].get<double>(), 0.1 * whole["faces"].get<double>() + 2100);
  EXPECT_EQ(run("bake " + path("whole.glb") + " -o " + path("again.glb") + " --photons 10k --grid 4 --quiet").status,
            0);
  EXPECT_EQ(run("bake " + path("coarse.ply") + " -o " + path("again.glb") +
                " --environment 1,1,1 --photons 10k --grid 4 --quiet")
                .status,
            0);
}

TEST_F(Commands, RenderProbeAndDiffAgree) {
  const std::string pack = small_pack();
  const std::string options = " --size 40x30 --spp 4 --quiet";
  ASSERT_EQ(run("render " + pack + " --integrator ivg --only indirect -o " + path("a.pfm") + options).status, 0);
  ASSERT_EQ(run("render " + pack + " --integrator ivg --only indirect -o " + path("b.exr") + options).status, 0);
  const json same = json::parse(run("diff " + path("a.pfm") + " " + path("b.exr") + " --metric rmse --json").out);
  EXPECT_EQ(same["max"], 0.0);
  write("points.csv", "x,y,z,nx,ny,nz\n0,1,0,0,1,0\n0.5,1,0.5,1,0,0\n");
  const Outcome csv = run("probe " + pack + " --integrator ivg --quiet --points " + path("points.csv"));
  EXPECT_EQ(csv.out.substr(0, csv.out.find('\n')), "x,y,z,nx,ny,nz,r,g,b,stderr");
  EXPECT_EQ(std::count(csv.out.begin(), csv.out.end(), '\n'), 3);
  const json points = json::parse(
      run("probe " + pack + " --integrator path --spp 16 --json --quiet --points " + path("points.csv")).out);
  EXPECT_EQ(points["points"].size(), 2u);
  EXPECT_GT(points["points"][0]["stderr"], 0.0);
}

// The figures tell how many samples time allowed for; one, where there is none.
TEST_F(Commands, RenderTakesAsManySamplesAsThereIsTimeFor) {
  const auto samples = [&](const std::string& options) {
    const Outcome outcome = run("render box-small --size 16x12 --json --quiet -o " + path("a.pfm") + options);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return json::parse(outcome.out)["spp"].get<int>();
  };
  EXPECT_EQ(samples(" --time 0"), 1);
  // More than without --time, though a sample of 192 pixels takes a millisecond.
  EXPECT_GT(samples(" --time 1"), 64);
  EXPECT_EQ(samples(""), 64);
}

// By points of lamps as by random samples of luminaires, from a scene and from its pack, where the grid holds what no
// lamp stands for.
TEST_F(Commands, RenderHasTheSameDirectLightByPointsOfLamps) {
  const std::string pack = small_pack();
  const auto mean = [&](const std::string& what) {
    const Outcome outcome = run("render " + what + " --only direct --size 64x48 --quiet -o " + path("a.pfm"));
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    const std::vector<float> pixels = read_picture(path("a.pfm")).value().pixels;
    return std::accumulate(pixels.begin(), pixels.end(), 0.0) / static_cast<double>(pixels.size());
  };
  const double wanted = mean("box-small --integrator direct --spp 256");
  // 3,072 pixels of 256 samples err by less than 0.2 % in the mean.
  for (const std::string& what :
       {std::string("box-small --integrator direct"), pack + " --integrator direct", pack + " --integrator ivg"})
    EXPECT_NEAR(mean(what + " --spp 16 --direct-samples 64"), wanted, 0.006 * wanted) << what;
}

// A pack says what its grid holds. A sky that it lacks would give no bounced light, so the grid cannot answer for it;
// of one that it holds as a map it keeps the picture, so that nobody who follows paths need name it again.
TEST_F(Commands, AGridAnswersForTheSkyItWasBakedUnderOnly) {
  write("points.csv", "x,y,z,nx,ny,nz\n0.3,0.3,0.3,0,1,0\n");
  const std::string points = " --points " + path("points.csv") + " --quiet ";
  const std::string dark = small_pack();
  const Outcome refused = run("probe " + dark + points + "--integrator ivg --environment 1,1,1");
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.err.find("was baked without an environment"), std::string::npos) << refused.err;
  EXPECT_EQ(run("probe " + dark + points + "--integrator path --spp 1 --environment 1,1,1").status, 0);

  // A map of one row of four pixels of radiance 1 (mantissa 128, exponent 129), of which one becomes the sun.
  write("sky.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 4\n" +
                       std::string("\x80\x80\x80\x81\x80\x80\x80\x81\x80\x80\x80\x81\x80\x80\x80\x81", 16));
  const std::string lit = small_pack("--environment " + path("sky.hdr"));
  const std::string paths = "--integrator path --spp 64";
  const Outcome kept = run("probe " + lit + points + paths),
                given = run("probe " + lit + points + paths + " --environment " + path("sky.hdr"));
  EXPECT_EQ(kept.status, 0);
  EXPECT_EQ(kept.err, "");
  EXPECT_EQ(kept.out, given.out);  // its radiances, 0 and 1, are kept exactly
  EXPECT_EQ(run("probe " + lit + points + "--integrator ivg --environment " + path("sky.hdr")).status, 0);
}

// In a furnace of albedo rho and emission Le every point receives pi Le rho / (1 - rho) of bounced light: pi here.
TEST_F(Commands, APointFromWhichNoRayGoesIsRefused) {
  write("points.csv", "x,y,z,nx,ny,nz\n0,1,0,0,1,0\n1e19,1,0.5,1,0,0\n");
  const Outcome refused = run("probe box-small --spp 4 --quiet --points " + path("points.csv"));
  EXPECT_EQ(refused.status, 1);
  EXPECT_EQ(refused.err, "lightwell: " + path("points.csv") + ": line 3: lies farther than 1e12 m away\n");
}

TEST_F(Commands, ProbeMeasuresTheFurnace) {
  write("points.csv", "x,y,z,nx,ny,nz\n1,1,1,0,1,0\n0.7,0.6,1.3,1,0,0\n1.2,1.1,0.4,0.6,0,-0.8\n");
  for (const std::string integrator : {"path --spp 400", "ivg --photons 2M --grid 8"}) {
    const Outcome outcome =
        run("probe furnace --json --quiet --points " + path("points.csv") + " --integrator " + integrator);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    // Four standard errors of 400 paths of relative deviation 0.8; the grid's noise is below that.
    const json figures = json::parse(outcome.out);
    ASSERT_EQ(figures["points"].size(), 3u);
    for (const json& point : figures["points"])
      for (const json& channel : point["rgb"])
        EXPECT_NEAR(channel.get<double>(), 3.14159, 0.16 * 3.14159) << integrator;
  }
}

TEST_F(Commands, AnInterruptedBakeLeavesNothing) {
  for (const auto& [signal, status] : {std::pair("INT", 130), std::pair("TERM", 143)}) {
    // Once the import is over the light is traced, for minutes if nobody interrupts.
    const Outcome cut = interrupt("bake box-small -o " + path("cut.glb") + " --photons 1G", "importing", signal);
    EXPECT_EQ(cut.status, status);
    EXPECT_TRUE(cut.err.ends_with("\nlightwell: cancelled, nothing written\n")) << cut.err;
    EXPECT_FALSE(fs::exists(path("cut.glb")));
    for (const auto& entry : fs::directory_iterator(folder()))
      EXPECT_EQ(entry.path().string().find(".part"), std::string::npos) << entry.path();
  }
}

// Two lamps in a closed room: with one of them switched off a pack gives the other's light alone, direct and bounced.
/// A room of 4 m, seen from inside, `nodes` are more of them, each on a line of its own after a comma.
std::string room_gltf(const std::string& lights, const std::string& nodes, const std::string& more_meshes = "") {
  const size_t count = static_cast<size_t>(std::count(nodes.begin(), nodes.end(), '\n'));
  std::string list = "0";
  for (size_t i = 1; i <= count; i++) list.append(",").append(std::to_string(i));
  return R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_lights_punctual"],"scene":0,
    "extensions":{"KHR_lights_punctual":{"lights":[)" +
         lights + R"(]}},"scenes":[{"nodes":[)" + list + R"(]}],"nodes":[{"mesh":0})" + nodes + R"(],
    "meshes":[{"name":"room","primitives":[{"attributes":{"POSITION":0},"indices":1}]})" +
         more_meshes + R"(],
    "buffers":[{"uri":"room.bin","byteLength":168}],
    "bufferViews":[{"buffer":0,"byteLength":96},{"buffer":0,"byteOffset":96,"byteLength":36},
                   {"buffer":0,"byteOffset":132,"byteLength":36}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":8,"type":"VEC3","min":[0,0,0],"max":[4,4,4]},
                 {"bufferView":1,"componentType":5121,"count":36,"type":"SCALAR"},
                 {"bufferView":2,"componentType":5121,"count":36,"type":"SCALAR"}]})";
}

/// Its buffer: the corners of a cube, its faces seen from inside, and from outside.
std::string room_bin() {
  std::string bin;
  for (int corner = 0; corner < 8; corner++)
    for (int axis = 0; axis < 3; axis++) {
      const float x = corner >> axis & 1 ? 4 : 0;
      bin.append(reinterpret_cast<const char*>(&x), 4);
    }
  const std::string outside{0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                            2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
  std::string inside = outside;
  for (size_t i = 0; i < inside.size(); i += 3) std::swap(inside[i], inside[i + 1]);
  return bin + inside + outside;
}

TEST_F(Commands, GroupsOfLightAreSwitched) {
  std::string gltf = room_gltf(R"({"type":"point","color":[1,0,0],"intensity":100},
                                  {"type":"point","color":[0,0,1],"intensity":100})",
                               R"(,
      {"name":"Red.001","translation":[1,2,1],"extensions":{"KHR_lights_punctual":{"light":0}}},
      {"name":"Blue.001","translation":[3,2,3],"extensions":{"KHR_lights_punctual":{"light":1}}})");
  write("lamps.gltf", gltf);
  write("one_group.gltf", gltf.replace(gltf.find("Blue.001"), 8, "Red.0002"));
  write("room.bin", room_bin());
  const std::string points = "x,y,z,nx,ny,nz\n2,1,2,0,1,0\n0.5,2,0.5,1,0,0\n";
  const std::string pack = path("groups.lw.glb"), options = " --photons 50k --grid 6 --target-error 4 --quiet";
  ASSERT_EQ(run("bake " + path("lamps.gltf") + " --groups name -o " + pack + options).status, 0);
  EXPECT_EQ(run("verify " + pack).status, 0);
  for (const std::string ivg : {"", " --integrator ivg"}) {
    const std::vector<double> all = probed(pack + ivg, points),
                              red = probed(pack + " --light-group Blue=0" + ivg, points),
                              halved = probed(pack + " --light-group Blue=0 --light-group Red=0.5,1,1" + ivg, points);
    for (size_t i = 0; i < all.size(); i++) {
      // Rays and nodes are the same ones: no noise.
      EXPECT_NEAR(red[i], i % 3 == 0 ? all[i] : 0, 1e-5 * all[0]) << ivg;
      EXPECT_NEAR(halved[i], i % 3 == 0 ? all[i] / 2 : 0, 1e-5 * all[0]) << ivg;
    }
    EXPECT_GT(all[2], 0);
  }
  const std::string one = path("one_group.lw.glb");
  ASSERT_EQ(run("bake " + path("one_group.gltf") + " --groups name -o " + one + options).status, 0);
  EXPECT_EQ(run("verify " + one).status, 0);
  for (const std::string ivg : {"", " --integrator ivg"})
    for (const double value : probed(one + " --light-group Red=0" + ivg, points)) EXPECT_EQ(value, 0) << ivg;
  EXPECT_EQ(run("probe " + pack + " --points " + path("points.csv") + " --light-group Green=1").err,
            "lightwell: " + pack + ": --light-group Green: is no group of the scene's light: Red, Blue\n");
  EXPECT_EQ(run("probe " + path("lamps.gltf") + " --points " + path("points.csv") + " --light-group Red=1").err,
            "lightwell: " + path("lamps.gltf") +
                ": --light-group Red: the scene's light has no groups: bake it with --groups\n");
}

// A closed room and a sun: there is nothing to estimate an error of, and the reason is said.
TEST_F(Commands, ASunThatMeetsOnlyOutsidesIsSaid) {
  write("room.bin", room_bin());
  for (const bool two_sided : {false, true}) {
    std::string gltf = room_gltf(R"({"type":"directional","intensity":3})", R"(,
      {"rotation":[-0.7071,0,0,0.7071],"extensions":{"KHR_lights_punctual":{"light":0}}})");
    if (two_sided) {
      gltf.insert(gltf.find("\"indices\":1"), "\"material\":0,");
      gltf.insert(gltf.find("\"buffers\""), "\"materials\":[{\"doubleSided\":true}],");
    }
    write("dark.gltf", gltf);
    const Outcome outcome =
        run("bake " + path("dark.gltf") + " -o " + path("dark.lw.glb") + " --grid 4 --photons 20k --target-error 4");
    EXPECT_EQ(outcome.status, 0);
    EXPECT_NE(outcome.err.find("black; the sun meets only outsides: the rooms have no opening"), std::string::npos)
        << outcome.err;
    EXPECT_EQ(outcome.out.find("estimated error"), std::string::npos) << outcome.out;
    const std::string json_options = " --grid 4 --photons 20k --quiet --json";
    EXPECT_TRUE(
        json::parse(
            run("bake " + path("dark.gltf") + " -o " + path("dark.lw.glb") + json_options).out)["estimated_error"]
            .is_null());
  }
  write("dark.gltf", room_gltf(R"({"type":"directional","intensity":3})", R"(,
      {"rotation":[-0.7071,0,0,0.7071],"extensions":{"KHR_lights_punctual":{"light":0}}})"));
  const Outcome outcome = run("bake " + path("dark.gltf") + " -o " + path("dark.lw.glb") +
                              " --environment 1,1,1 --grid 6 --photons 20k --json --quiet");
  EXPECT_NE(outcome.out.find("the sun and the sky meet only outsides: the rooms have no opening"), std::string::npos)
      << outcome.out;
}

TEST_F(Commands, ABlackPictureIsSaid) {
  write("room.bin", room_bin());
  write("dark.gltf", room_gltf(R"({"type":"directional","intensity":3})", R"(,
      {"rotation":[-0.7071,0,0,0.7071],"extensions":{"KHR_lights_punctual":{"light":0}}})"));
  write("face.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::string small = " --integrator path --spp 2 --size 8x6 -o " + path("a.png");
  const auto said = [&](const std::string& scene) { return run("render " + path(scene) + small).err; };
  const std::string outside = said("dark.gltf");
  EXPECT_NE(outside.find("the picture is black: no light reaches what the camera sees"), std::string::npos) << outside;
  EXPECT_NE(said("face.obj --exposure 0").find("black: nothing shines; --environment 1,1,1 lights"), std::string::npos);
  EXPECT_EQ(said("face.obj --environment 1,1,1").find("black"), std::string::npos);
}

// A lamp in a closed cupboard: whatever becomes of the cupboard's faces, both are named.
TEST_F(Commands, ALampInACupboardIsNamed) {
  write("room.bin", room_bin());
  for (const std::string size : {"0.15", "0.4"}) {
    write("cupboard.gltf",
          room_gltf(R"({"type":"point","intensity":100})",
                    R"(,
      {"mesh":1,"translation":[1,0.01,1],"scale":[)" +
                        size + "," + size + "," + size + R"(]},
      {"name":"lost","translation":[1.2,0.21,1.2],"extensions":{"KHR_lights_punctual":{"light":0}}})",
                    R"(,{"name":"cupboard","primitives":[{"attributes":{"POSITION":0},"indices":2}]})"));
    const Outcome outcome = run("bake " + path("cupboard.gltf") + " -o " + path("cupboard.lw.glb") +
                                " --grid 4 --photons 20k --target-error 4");
    EXPECT_EQ(outcome.status, 0);
    EXPECT_NE(outcome.err.find("lamp \"lost\" stands inside of \"cupboard\""), std::string::npos) << outcome.err;
  }
}

}  // namespace
}  // namespace lightwell
