// SPDX-License-Identifier: Apache-2.0
//
// `lightwell serve --watch`, which bakes a scene again when it changes; what the page does is tests/e2e's.
#include <chrono>
#include <thread>

#include "tests/cli/commands.h"
#include "tests/server/running_server.h"

namespace lightwell {
namespace {

/// A square whose material has this name; its corners are in a file beside it.
std::string square(const std::string& material) {
  return json{
      {"asset", {{"version", "2.0"}}},
      {"scene", 0},
      {"scenes", {{{"nodes", {0}}}}},
      {"nodes", {{{"mesh", 0}}}},
      {"materials", {{{"name", material}}}},
      {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}, {"material", 0}}}}}}},
      {"buffers", {{{"uri", "square.bin"}, {"byteLength", 60}}}},
      {"bufferViews", {{{"buffer", 0}, {"byteLength", 48}}, {{"buffer", 0}, {"byteOffset", 48}, {"byteLength", 12}}}},
      {"accessors",
       {{{"bufferView", 0},
         {"componentType", 5126},
         {"count", 4},
         {"type", "VEC3"},
         {"min", {-2, 0, -2}},
         {"max", {2, 0, 2}}},
        {{"bufferView", 1}, {"componentType", 5123}, {"count", 6}, {"type", "SCALAR"}}}}}
      .dump();
}

std::string corners(float half_side) {
  const float a = half_side;
  const std::vector<float> places = {-a, 0, -a, -a, 0, a, a, 0, a, a, 0, -a};
  const std::vector<uint16_t> faces = {0, 1, 2, 0, 2, 3};
  return std::string(reinterpret_cast<const char*>(places.data()), 48) +
         std::string(reinterpret_cast<const char*>(faces.data()), 12);
}

class Watch : public Commands {
 protected:
  void SetUp() override {
    fs::create_directories(path("temporary"));
    write("square.gltf", square("red"));
    write("square.bin", corners(1));
  }
  void TearDown() override {
    if (!ended_) stop();
  }

  /// Begins to watch the square, and waits until the server tells its address.
  void begin() {
    ended_ = false;
    const std::string options = " --quiet --watch " + path("square.gltf") + " --bake '--environment 1,1,1 --grid 3'";
    write("watch.sh", "echo $$ >" + path("process") + "\nexport TMPDIR=" + path("temporary") +
                          "\nexec " LIGHTWELL_PROGRAM " serve --port 0 --page " + folder().string() + options);
    run_in_shell("(sh " + path("watch.sh") + redirected() + "; echo $? >" + path("status") + ") &");
    ASSERT_TRUE(comes_true([&] { return read(path("stdout")).find('}') != std::string::npos; })) << said();
    const std::string url = json::parse(read(path("stdout")))["url"];
    port_ = static_cast<uint16_t>(std::stoi(url.substr(url.rfind(':') + 1)));
  }
  /// Ends it as Ctrl-C does, and waits until it has ended.
  void stop() {
    run_in_shell("kill -INT " + read(path("process")));
    EXPECT_TRUE(comes_true([&] { return !read(path("status")).empty(); }));
    EXPECT_EQ(read(path("status")), "0\n");
    ended_ = true;
  }
  std::string said() const { return read(path("stderr")); }
  std::string get(const std::string& target) const { return RawConnection(port_).get(target).body; }
  std::string pack() const { return get("/packs/square.lw.glb"); }
  bool serves(const std::string& word) const { return pack().find(word) != std::string::npos; }
  /// Whether something comes true within a minute: a bake of two triangles takes a blink, but machines may be busy.
  template <typename Condition>
  static bool comes_true(const Condition& condition) {
    constexpr std::chrono::milliseconds pause(50);
    for (int i = 0; i < 1200; i++, std::this_thread::sleep_for(pause))
      if (condition()) return true;
    return false;
  }

 private:
  bool ended_ = true;
  uint16_t port_ = 0;
};

TEST_F(Watch, ASceneThatChangesIsBakedAgain) {
  begin();
  EXPECT_TRUE(serves("red"));
  EXPECT_EQ(json::parse(get("/packs.json"))["change"], true);
  write("square.gltf", square("green"));
  EXPECT_TRUE(comes_true([&] { return serves("green"); })) << said();
  EXPECT_EQ(said(), "");
}

TEST_F(Watch, WhatIsWrongIsSaidAndTheOldPackStays) {
  begin();
  write("square.gltf", "nothing");
  EXPECT_TRUE(comes_true([&] { return !said().empty(); }));
  EXPECT_NE(said().find("square.gltf: is neither glTF, OBJ"), std::string::npos) << said();
  EXPECT_TRUE(serves("red"));
  write("blue.gltf", square("blue"));
  fs::rename(path("blue.gltf"), path("square.gltf"));
  EXPECT_TRUE(comes_true([&] { return serves("blue"); })) << said();
}

TEST_F(Watch, AFileThatTheSceneUsesCountsAndNoOther) {
  begin();
  const std::string before = pack();
  write("other.bin", corners(2));
  std::this_thread::sleep_for(std::chrono::seconds(1));
  EXPECT_EQ(pack(), before);
  fs::remove(path("square.bin"));
  EXPECT_TRUE(comes_true([&] { return said().find("square.bin") != std::string::npos; })) << said();
  fs::copy(path("other.bin"), path("square.bin"));
  EXPECT_TRUE(comes_true([&] { return pack() != before; })) << said();
}

TEST_F(Watch, LeavesNothingBehind) {
  begin();
  EXPECT_FALSE(fs::is_empty(path("temporary")));
  stop();
  EXPECT_TRUE(fs::is_empty(path("temporary")));
}

TEST_F(Watch, WhatCannotBeBakedAtFirstIsRefused) {
  const Outcome gone = run("serve --port 0 --watch " + path("gone.gltf"));
  EXPECT_EQ(gone.status, 1);
  EXPECT_NE(gone.err.find("gone.gltf: no such file"), std::string::npos) << gone.err;
  const Outcome unknown = run("serve --port 0 --watch " + path("square.gltf") + " --bake --unknown");
  EXPECT_EQ(unknown.status, 2);
  EXPECT_NE(unknown.err.find("bake: --unknown: no such option"), std::string::npos) << unknown.err;
  const Outcome nothing = run("serve");
  EXPECT_EQ(nothing.status, 2);
  EXPECT_NE(nothing.err.find("packs, or --watch with a scene, is required"), std::string::npos) << nothing.err;
  EXPECT_EQ(run("serve " + path("square.gltf") + " --bake --sky").status, 2);
}

}  // namespace
}  // namespace lightwell
