// SPDX-License-Identifier: Apache-2.0
#include "lightwell/server/pack_folder.h"

#include <algorithm>

#include "tests/server/running_server.h"

namespace lightwell {
namespace {

namespace fs = std::filesystem;

class PackFolderTest : public testing::Test {
 protected:
  PackFolderTest() {
    scratch_.write("packs/room.glb", pack_);
    scratch_.write("outside.glb", pack_);
  }

  /// The names of the list, in order. Those that cannot be opened by their names fail the test.
  std::vector<std::string> listed() {
    std::vector<std::string> names;
    const auto packs = folder_.packs();
    EXPECT_TRUE(packs);
    for (const ServedPack& pack : packs.value_or(std::vector<ServedPack>())) {
      names.push_back(pack.name);
      const auto file = folder_.open(pack.name);
      EXPECT_TRUE(file && file->length() == pack.bytes) << pack.name;
    }
    std::sort(names.begin(), names.end());
    return names;
  }
  bool opens(const std::string& name) { return folder_.open(name).has_value(); }

  using Names = std::vector<std::string>;
  const std::string pack_ = pack_of(1000);
  TemporaryFolder scratch_;
  PackFolder folder_{scratch_.path() / "packs"};
};

TEST_F(PackFolderTest, GivesPacksAndNothingElse) {
  scratch_.write("packs/scene.glb", "glTF, but no pack");
  scratch_.write("packs/notes.txt", pack_);
  scratch_.write("packs/.hidden.glb", pack_);
  scratch_.write("packs/below/deep.glb", pack_);
  fs::create_directories(scratch_.path() / "packs/folder.glb");
  EXPECT_EQ(listed(), Names{"room.glb"});
  for (const char* name : {"scene.glb", "notes.txt", ".hidden.glb", "below/deep.glb", "folder.glb", "absent.glb",
                           "../outside.glb", "", "."}) {
    const auto file = folder_.open(name);
    ASSERT_FALSE(file) << name;
    EXPECT_EQ(file.error().kind, ErrorKind::io) << name;
  }
}

TEST_F(PackFolderTest, FollowsLinksWithinTheFolderOnly) {
  const auto link = [&](const fs::path& target, const char* name) {
    fs::create_symlink(target, scratch_.path() / "packs" / name);
  };
  link("room.glb", "inside.glb");
  link("../outside.glb", "outside.glb");
  link(scratch_.path() / "outside.glb", "absolute.glb");
  link("absolute.glb", "twice.glb");
  link("nowhere.glb", "dangling.glb");
  link("circle.glb", "circle.glb");
  link("..", "up");
  EXPECT_EQ(listed(), (Names{"inside.glb", "room.glb"}));
  for (const char* name : {"outside.glb", "absolute.glb", "twice.glb", "dangling.glb", "circle.glb", "up/outside.glb"})
    EXPECT_FALSE(opens(name)) << name;
}

TEST_F(PackFolderTest, ThatIsALinkItselfIsLookedInto) {
  fs::create_directory_symlink("packs", scratch_.path() / "link");
  PackFolder link(scratch_.path() / "link");
  EXPECT_EQ(link.packs()->size(), 1u);
  EXPECT_TRUE(link.open("room.glb"));
}

TEST_F(PackFolderTest, SeesWhatChanges) {
  EXPECT_EQ(listed(), Names{"room.glb"});
  scratch_.write("packs/growing.glb", pack_.substr(0, 20));
  EXPECT_EQ(listed(), Names{"room.glb"});
  scratch_.write("packs/growing.glb", pack_);
  EXPECT_EQ(listed(), (Names{"growing.glb", "room.glb"}));
  scratch_.write("packs/growing.glb", "no pack any more");
  EXPECT_FALSE(opens("growing.glb"));
  EXPECT_EQ(listed(), Names{"room.glb"});
  fs::remove(scratch_.path() / "packs/room.glb");
  EXPECT_FALSE(opens("room.glb"));
  EXPECT_EQ(listed(), Names{});
  fs::remove_all(scratch_.path() / "packs");
  EXPECT_EQ(listed(), Names{});
}

// Only what can have been changed is read again: a file of the same place, length and time is taken to be the same.
TEST_F(PackFolderTest, RemembersWhatItHasRead) {
  const fs::path path = scratch_.path() / "packs/room.glb";
  const auto time = fs::last_write_time(path);
  EXPECT_EQ(listed(), Names{"room.glb"});
  scratch_.write("packs/room.glb", std::string(pack_.size(), 'x'));
  fs::last_write_time(path, time);
  EXPECT_EQ(listed(), Names{"room.glb"});
  fs::last_write_time(path, time + std::chrono::nanoseconds(1));
  EXPECT_EQ(listed(), Names{});
}

TEST_F(PackFolderTest, ListsThousands) {
  for (int i = 0; i < 2000; i++) scratch_.write("packs/" + std::to_string(i) + ".glb", i % 2 ? pack_ : "no pack");
  EXPECT_EQ(listed().size(), 1001u);
  EXPECT_EQ(listed().size(), 1001u);
}

}  // namespace
}  // namespace lightwell
