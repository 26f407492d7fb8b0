// SPDX-License-Identifier: Apache-2.0
//
// What the program says to those who mistype, and to files and servers that are not what they should be.
#include <regex>

#include "tests/cli/commands.h"

namespace lightwell {
namespace {

struct Case {
  std::string arguments;
  std::string said;  ///< in the one line on stderr
};

TEST_F(Commands, BadUsageIsOneLineThatSaysWhatWasExpected) {
  const std::string out = " -o " + path("x.glb");
  for (const Case& bad : std::vector<Case>{
           {"", "a command is missing"},
           {"bogus", "bogus: no such command"},
           {"--bogus", "--bogus: no such option"},
           {"bake", "--output is required"},
           {"bake box-small", "--output is required"},
           {"bake box-small -o", "--output: takes one value"},
           {"bake box-small more" + out, "more: more than was expected"},
           {"bake box-small --phtons 5" + out, "--phtons 5: no such option"},
           {"bake box-small --grid 1" + out, "--grid: 1: is neither auto nor a whole number from 2 to 256"},
           {"bake box-small --grid many" + out, "neither auto nor"},
           {"bake box-small --order best" + out, "--order: best: is not lattice or slices"},
           {"bake box-small --photons many" + out, "such as 5000, 200k, 8M or 1G"},
           {"bake box-small --photons 0" + out, "is not at least 1"},
           {"bake box-small --photons nan" + out, "such as 5000"},
           {"bake box-small --unit nan" + out, "--unit: nan: is not a number from 1e-09 to"},
           {"bake box-small --unit inf" + out, "--unit: inf: is not a number"},
           {"bake box-small --unit 0" + out, "--unit: 0: is not a number"},
           {"bake box-small --unit 1m" + out, "--unit: 1m: is not a number"},
           {"bake box-small --max-image-megapixels 1000" + out, "1000: is not a whole number from 1 to 512"},
           {"bake box-small --up w" + out, "--up: w: is not x, -x, y, -y, z or -z"},
           {"bake box-small --rotate 90" + out, "--rotate: 90: is not X,Y,Z"},
           {"bake box-small --rotate 0,90,0,0" + out, "is not X,Y,Z"},
           {"bake box-small --rotate 0,90," + out, "is not X,Y,Z"},
           {"bake box-small --rotate 0,nan,0" + out, "--rotate: nan: is not a number from -360 to 360"},
           {"bake box-small --position-error nan" + out, "--position-error: nan"},
           {"bake box-small --position-error -1" + out, "--position-error: -1"},
           {"bake box-small --threads 5000" + out, "--threads: 5000: is not a whole number from 0 to 1024"},
           {"bake box-small --seed 1.5" + out, "--seed: 1.5: is not a whole number"},
           {"bake box-small --environment 1,2" + out, "--environment: 1,2: is neither R,G,B"},
           {"bake box-small --environment red" + out, "--environment: red: no such file, and it is not R,G,B"},
           {"bake box-small --environment nofile.hdr" + out, "--environment: nofile.hdr: no such file"},
           {"bake box-small --environment 1,2,inf" + out, "is neither R,G,B"},
           {"bake box-small -o " + path("x.xyz"), "x.xyz: the name does not end in .glb"},
           {"scenes box", "go together"},
           {"scenes furnace -o " + path("x.obj"), "x.obj: the name does not end in .glb"},
           {"export a.glb -o " + path("x.xyz"), "does not end in .glb or .ply"},
           {"export a.glb", "export: -o FILE or --light FILE: one of them is needed"},
           {"export a.glb --light " + path("x.exr"), "does not end in .json or .ktx2"},
           {"help --man --completion", "one of them at a time"},
           {"render box-small -o " + path("x.jpg"), "does not end in .png, .exr or .pfm"},
           {"render box-small --size 0x5 -o " + path("x.png"), "0: is not a whole number from 1 to 16384"},
           {"render box-small --size 5 -o " + path("x.png"), "--size: 5: is not WIDTHxHEIGHT"},
           {"render box-small --exposure nan -o " + path("x.png"), "--exposure: nan"},
           {"render box-small --level 2 -o " + path("x.png"), "--level: 2: is not a number from 0 to 1"},
           {"render box-small --only all -o " + path("x.png"), "--only: all: is not total, direct or indirect"},
           {"render box-small --direct-samples 0 --integrator direct -o " + path("x.png"),
            "--direct-samples: 0: is not a whole number from 1 to 1000000"},
           {"render box-small --direct-samples 16 -o " + path("x.png"), "the path tracer samples lamps at random"},
           {"render box-small --direct-samples 16 --integrator path -o " + path("x.png"), "--direct-samples"},
           {"render box-small --time soon -o " + path("x.png"), "--time: soon: is not a number from 0 to"},
           {"render box-small --time 1 --spp 4 -o " + path("x.png"), "--spp excludes --time"},
           {"diff a b -o " + path("x.exr"), "does not end in .png"},
           {"diff a b --metric best", "is not rmse, relmse, deltae, lab or flip"},
           {"fetch a --latency inf", "--latency: inf"},
           {"fetch a --timeout nan", "--timeout: nan"},
           {"fetch a --rate fast", "--rate: fast: is not a number of bits a second, such as 500k or 10M"},
           {"serve a --port 70000", "--port: 70000: is not a whole number from 0 to 65535"}}) {
    const Outcome outcome = run(bad.arguments);
    EXPECT_EQ(outcome.status, 2) << bad.arguments;
    EXPECT_EQ(outcome.lines(), 1u) << outcome.err;
    EXPECT_EQ(outcome.err.rfind("lightwell: ", 0), 0u) << outcome.err;
    EXPECT_NE(outcome.err.find(bad.said), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("--help`"), std::string::npos) << outcome.err;
  }
}

TEST_F(Commands, HelpIsForPeople) {
  for (const char* command :
       {"", "scenes", "bake", "info", "verify", "serve", "fetch", "render", "probe", "export", "diff", "help"}) {
    const std::string help = run(std::string(command) + " --help").out;
    for (const char* jargon : {"INT", "FLOAT", "ENUM", "TEXT", "->", "NONNEGATIVE"})
      EXPECT_EQ(help.find(jargon), std::string::npos) << help;
  }
  EXPECT_NE(run("bake --help").out.find("200k, 8M"), std::string::npos);
  EXPECT_NE(run("render --help").out.find("path|direct|ivg"), std::string::npos);
}

TEST_F(Commands, CountsTakeSuffixesOfBothCases) {
  for (const std::string count : {"20k", "20K", "0.02M", "0.02m", "2e4", "20000"}) {
    const Outcome baked = run("bake furnace --grid 2 --json --quiet -o " + path("x.glb") + " --photons " + count);
    EXPECT_EQ(json::parse(baked.out)["photons"], 20000) << count;
  }
}

TEST_F(Commands, OnePhotonIsACount) {
  for (const std::string method : {"gather", "tracks", "faces"}) {
    const Outcome baked = run("bake furnace --grid 2 --quiet --photons 1 -o " + path("x.glb") + " --method " + method);
    EXPECT_EQ(baked.status, 0) << method << ' ' << baked.err;
  }
}

// The work itself would take hours.
TEST_F(Commands, WhatCannotBeWrittenIsNoticedBeforeTheWork) {
  const std::string pack = small_pack();
  write("file", "");
  fs::create_directories(path("folder.glb"));
  for (const std::string place : {"missing/x", "file/x"}) {
    for (const std::string& command :
         {"bake box-small --photons 100G -o " + path(place + ".glb"),
          "render box-small --spp 1000000 -o " + path(place + ".png"), "export " + pack + " -o " + path(place + ".ply"),
          "scenes furnace -o " + path(place + ".glb"), "diff a.png b.png -o " + path(place + ".png"),
          "fetch " + pack + " --rate 1 -o " + path(place + ".glb")}) {
      const Outcome outcome = run(command);
      EXPECT_EQ(outcome.status, 1) << command;
      EXPECT_EQ(outcome.lines(), 1u) << outcome.err;
      EXPECT_NE(outcome.err.find("cannot be written"), std::string::npos) << outcome.err;
    }
  }
  const Outcome folder = run("bake box-small --photons 100G -o " + path("folder.glb"));
  EXPECT_EQ(folder.status, 1);
  EXPECT_NE(folder.err.find("is a folder"), std::string::npos) << folder.err;
}

TEST_F(Commands, WhatIsReadIsNotReplaced) {
  const std::string pack = small_pack(), before = read(pack);
  fs::create_symlink(pack, path("link.glb"));
  fs::create_hard_link(pack, path("other.glb"));
  fs::create_directories(path("folder"));
  for (const std::string& output : {pack, path("folder/../box.lw.glb"), path("link.glb"), path("other.glb")}) {
    for (const std::string& command : {"bake --photons 100G " + pack, "export " + pack, "fetch --rate 1 " + pack,
                                       "bake --photons 100G box-small --environment " + pack}) {
      const Outcome outcome = run(command + " -o " + output);
      EXPECT_EQ(outcome.status, 1) << command;
      EXPECT_EQ(outcome.err, "lightwell: " + output + ": would replace the file that is read; choose another name\n");
    }
  }
  EXPECT_EQ(read(pack), before);
  write("a.png", "");
  fs::create_hard_link(pack, path("pack.png"));
  for (const std::string& command : {"diff missing.png " + path("a.png") + " -o " + path("a.png"),
                                     "render --spp 1000000 " + pack + " -o " + path("pack.png")}) {
    const Outcome outcome = run(command);
    EXPECT_EQ(outcome.status, 1) << command;
    EXPECT_NE(outcome.err.find("would replace the file that is read"), std::string::npos) << outcome.err;
  }
  EXPECT_EQ(run("export " + pack + " -o /dev/null").status, 0);
}

TEST_F(Commands, AFullDeviceIsAnError) {
  const std::string pack = small_pack();
  const Outcome outcome = run("export " + pack + " -o /dev/full");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(outcome.err, "lightwell: /dev/full: No space left on device\n");
  const Outcome baked =
      run_in_shell(LIGHTWELL_PROGRAM " bake furnace --grid 2 --photons 5k --quiet -o - >/dev/full 2>" + path("stderr"));
  EXPECT_EQ(baked.status, 1);
  EXPECT_EQ(baked.err, "lightwell: stdout: No space left on device\n") << "it is not the scene's fault";
  const int status = std::system((LIGHTWELL_PROGRAM " info " + pack + " >/dev/full 2>&1").c_str());
  EXPECT_EQ(WEXITSTATUS(status), 1) << "figures that are lost are no success";
}

TEST_F(Commands, WhatIsNoPackIsCalledSo) {
  const std::string pack = read(small_pack());
  write("junk", "hello");
  write("page.html", "<!doctype html>");
  write("empty", "");
  write("cut.glb", pack.substr(0, pack.size() / 2));
  ASSERT_EQ(run("scenes furnace -o " + path("plain.glb")).status, 0);
  fs::create_directories(path("folder"));
  const std::string to_export = "export -o " + path("x.glb");
  for (const std::string& command : std::vector<std::string>{"info", "verify", "fetch", "serve --port 0", to_export}) {
    for (const auto& [file, said] :
         std::vector<std::pair<std::string, std::string>>{{"junk", "is no pack; `lightwell bake` makes one"},
                                                          {"page.html", "is HTML or XML"},
                                                          {"plain.glb", "is no pack; `lightwell bake` makes one"},
                                                          {"folder", "is a folder"},
                                                          {"empty", "empty"},
                                                          {"cut.glb", command == "fetch" ? "should have" : "cut short"},
                                                          {"missing", "o such file"}}) {
      if (command == "serve --port 0" && file == "folder") continue;  // it serves folders
      const Outcome outcome = run(command + " " + path(file));
      EXPECT_EQ(outcome.status, 1) << command << " " << file;
      EXPECT_EQ(outcome.lines(), 1u) << outcome.err;
      EXPECT_EQ(outcome.err.rfind("lightwell: " + path(file), 0), 0u) << outcome.err;
      EXPECT_NE(outcome.err.find(said), std::string::npos) << command << ": " << outcome.err;
    }
  }
  EXPECT_FALSE(fs::exists(path("x.glb")));
}

TEST_F(Commands, ABuiltInSceneIsNoPack) {
  for (const std::string& command : {std::string("info"), std::string("verify"), std::string("fetch"),
                                     std::string("serve --port 0"), "export -o " + path("x.glb")}) {
    const Outcome outcome = run(command + " furnace");
    EXPECT_EQ(outcome.status, 1) << command;
    EXPECT_EQ(
        outcome.err,
        "lightwell: furnace: is a built-in scene, not a pack; `lightwell bake furnace -o furnace.lw.glb` makes one\n");
  }
}

// As a glTF it would be read at its coarsest level, without a word.
TEST_F(Commands, ADamagedPackIsNotTakenForAnotherGltf) {
  std::string pack = read(small_pack());
  pack[300] = static_cast<char>(pack[300] ^ 1);
  write("damaged.glb", pack);
  for (const std::string& command : {"render --spp 1 -o " + path("x.png"), "bake -o " + path("x.glb")}) {
    const Outcome outcome = run(command + " --quiet " + path("damaged.glb"));
    EXPECT_EQ(outcome.status, 1) << command;
    EXPECT_NE(outcome.err.find("check is wrong"), std::string::npos) << outcome.err;
  }
}

TEST_F(Commands, UpAndUnitAreNotForScenesThatHaveTheirOwn) {
  const std::string pack = small_pack();
  for (const std::string& scene : {std::string("box-small"), pack}) {
    for (const char* option : {" --unit 0.001", " --up z"}) {
      const Outcome outcome = run("bake --quiet " + scene + option + " -o " + path("x.glb"));
      EXPECT_EQ(outcome.status, 1);
      EXPECT_NE(outcome.err.find("--up, --front, --rotate and --unit"), std::string::npos) << outcome.err;
    }
  }
}

TEST_F(Commands, APositionErrorLargerThanTheSceneLeavesItsForm) {
  const std::string pack = small_pack("--position-error 1000");
  const json info = json::parse(run("info --json " + pack).out);
  ASSERT_EQ(info["meshes"].size(), 1u);
  EXPECT_GT(info["meshes"][0]["faces"], 1000);
  EXPECT_EQ(run("verify " + pack).status, 0);
}

TEST_F(Commands, InfoIsReadable) {
  const std::string text = run("info " + small_pack()).out;
  for (const char* part : {"mesh 0: 20,010 faces", "bits a vertex", "grid 0: 5 x 5 x 6 nodes, cells of 1 x 1 x 1 m",
                           "lamp 0: rectangle", "radiance 14 12 9 W/m2/sr", "stream 0: light", " kB"})
    EXPECT_NE(text.find(part), std::string::npos) << text;
}

TEST_F(Commands, FiguresAreReadable) {
  const Outcome baked = run("bake box-small --photons 20k --grid 6 -o " + path("x.glb"));
  const std::string size = R"(\d{1,3}(\.\d+)? [kM]B)";
  for (const std::string& line : std::vector<std::string>{
           "triangles: 20,030", "photons: 20,000", "rays a second: [0-9,]+",
           R"(time: import \d+\.\d\d s, light \d+\.\d\d s, geometry \d+\.\d\d s, write \d+\.\d\d s)",
           "peak memory: " + size, "size of the pack: " + size,
           "size: opening " + size + ", geometry " + size + ", light " + size + ", texture 0 bytes",
           R"(estimated error of the irradiance, root mean square: \d+(\.\d+)? %)"})
    EXPECT_TRUE(std::regex_search(baked.out, std::regex("(^|\n)" + line + "\n"))) << line << "\n" << baked.out;
  EXPECT_EQ(run("verify " + path("x.glb")).out.rfind("ok: yes\nblocks: ", 0), 0u);
  const std::string fetched = run("fetch " + path("x.glb")).out;
  EXPECT_TRUE(std::regex_search(fetched, std::regex("first picture: size " + size + R"(, time \d+\.\d\d s)")))
      << fetched;
  EXPECT_EQ(run("export " + path("x.glb") + " -o " + path("x.ply")).out.rfind("vertices: 10,0", 0), 0u);
}

TEST_F(Commands, OfAStageThatFailsOnlyTheErrorIsTold) {
  write("dark.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  for (const std::string& command :
       {"bake " + path("missing.glb") + " -o " + path("x.glb"), "bake " + path("dark.obj") + " -o " + path("x.glb")})
    EXPECT_EQ(run(command).lines(), 1u) << run(command).err;
}

TEST_F(Commands, DiffSaysWhichPicturesItReads) {
  write("notes.md", "# Notes");
  const Outcome outcome = run("diff " + path("notes.md") + " " + path("notes.md"));
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(outcome.err,
            "lightwell: " + path("notes.md") + ": is no picture: neither PNG, JPEG, WebP, OpenEXR nor PFM\n");
}

TEST_F(Commands, FetchSaysHowAUrlBegins) {
  for (const std::string url : {"localhost:8123/packs/x.glb", "127.0.0.1:80", "[::1]:8080/x.glb",
                                "example.com/packs/x.glb", "my-host.example.com/x.glb", "ftp://example.com/x.glb"})
    EXPECT_EQ(run("fetch " + url).err, "lightwell: " + url + ": no such file; a URL begins with http://\n");
  for (const std::string file : {"x.glb", "folder:/x.glb", "folder/x:1", "12:30 o'clock", "../x.glb", "a/b.c/x.glb"}) {
    const Outcome outcome = run("fetch \"" + file + "\"");
    EXPECT_EQ(outcome.status, 1);
    EXPECT_EQ(outcome.err.find("http"), std::string::npos) << outcome.err;
  }
}

TEST_F(Commands, FetchNamesAServerThatIsNotThereAndGivesUp) {
  const Outcome outcome = run("fetch http://127.0.0.1:1/x.glb --timeout 1");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(outcome.err,
            "lightwell: warning: http://127.0.0.1:1/x.glb: Connection refused; trying again\n"
            "lightwell: http://127.0.0.1:1/x.glb: Connection refused; gave up after 1 s\n");
  const Outcome large = run("fetch HTTP://127.0.0.1:1/x.glb --timeout 1");
  EXPECT_NE(large.err.find("Connection refused; gave up after 1 s\n"), std::string::npos) << large.err;
  for (const char* scheme : {"https", "HTTPS"}) {
    const Outcome secure = run(std::string("fetch ") + scheme + "://127.0.0.1/x.glb");
    EXPECT_EQ(secure.status, 1);
    EXPECT_NE(secure.err.find("https is not spoken"), std::string::npos) << secure.err;
  }
}

TEST_F(Commands, ASignalEndsAFetchInOneLine) {
  for (const auto& [signal, status] : {std::pair("INT", 130), std::pair("TERM", 143)}) {
    const Outcome outcome = interrupt("fetch http://127.0.0.1:1/x.glb --timeout 0", "trying again", signal);
    EXPECT_EQ(outcome.status, status);
    EXPECT_TRUE(outcome.err.ends_with("trying again\nlightwell: cancelled, nothing written\n")) << outcome.err;
  }
}

}  // namespace
}  // namespace lightwell
