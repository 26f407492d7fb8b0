// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/scene_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/temporary_folder.h"

namespace lightwell {
namespace {

namespace fs = std::filesystem;

class SceneFiles : public testing::Test {
 protected:
  fs::path write(const std::string& name, const std::string& text) const { return folder_.write(name, text); }
  fs::path in_folder(const std::string& name) const { return folder_.path() / name; }

 private:
  const TemporaryFolder folder_;
};

constexpr const char* gltf = R"({"asset": {"version": "2.0"},
  "buffers": [{"uri": "my%20room.bin"}, {"uri": "data:;base64,AAAA"}, {"byteLength": 4}],
  "images": [{"uri": "walls/brick.png"}, {"bufferView": 0}], "meshes": [{"uri": "other.bin"}]})";

TEST_F(SceneFiles, OfAGltfAreItsBuffersAndImages) {
  const fs::path room = write("room.gltf", gltf);
  EXPECT_THAT(files_of_scene(room), testing::ElementsAre(room, in_folder("my room.bin"), in_folder("walls/brick.png")));
}

TEST_F(SceneFiles, OfAGlbAreNamedInItsFirstChunk) {
  std::string text(gltf);
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const auto word = [](size_t value) {
    std::string bytes;
    for (int i = 0; i < 4; i++) bytes += static_cast<char>(value >> (8 * i) & 255);
    return bytes;
  };
  const fs::path room =
      write("room.glb", "glTF" + word(2) + word(text.size() + 20) + word(text.size()) + "JSON" + text);
  EXPECT_THAT(files_of_scene(room), testing::ElementsAre(room, in_folder("my room.bin"), in_folder("walls/brick.png")));
}

TEST_F(SceneFiles, OfAnObjAreItsMaterialsAndTheirImages) {
  write("my paints.mtl", "newmtl red\r\nKd 1 0 0\r\n\tmap_Kd -s 1 1 1 tiles\\red.png\r\nbump relief.png\r\n");
  const fs::path room = write("room.obj", "mtllib my paints.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_THAT(files_of_scene(room), testing::IsSupersetOf({room, in_folder("my paints.mtl"), in_folder("tiles/red.png"),
                                                           in_folder("relief.png")}));
}

TEST_F(SceneFiles, OfAPlyAreNamedInItsHeader) {
  const fs::path scan = write("scan.ply",
                              "ply\nformat ascii 1.0\ncomment TextureFile skin.png\nelement vertex 0\n"
                              "property float x\nend_header\ncomment TextureFile other.png\n");
  EXPECT_THAT(files_of_scene(scan), testing::ElementsAre(scan, in_folder("skin.png")));
}

TEST_F(SceneFiles, OfWhatCannotBeReadIsTheFileAlone) {
  const fs::path gone = in_folder("gone.gltf");
  EXPECT_THAT(files_of_scene(gone), testing::ElementsAre(gone));
  const fs::path broken = write("broken.gltf", R"({"asset": {"version": "2.0"}, "images": [{"uri": 7}, 3]})");
  EXPECT_THAT(files_of_scene(broken), testing::ElementsAre(broken));
  const fs::path cut = write("cut.glb", "glTF\2");
  EXPECT_THAT(files_of_scene(cut), testing::ElementsAre(cut));
}

// Materials that name each other, as no program writes them.
TEST_F(SceneFiles, EndWhereFilesNameEachOther) {
  write("a.mtl", "mtllib b.mtl\n");
  write("b.mtl", "mtllib a.mtl\n");
  const fs::path room = write("room.obj", "mtllib a.mtl\nv 0 0 0\n");
  EXPECT_THAT(files_of_scene(room), testing::ElementsAre(room, in_folder("a.mtl"), in_folder("b.mtl")));
}

}  // namespace
}  // namespace lightwell
