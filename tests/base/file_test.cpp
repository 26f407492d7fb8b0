// SPDX-License-Identifier: Apache-2.0
#include "lightwell/base/file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <set>

#include "tests/base/gzipped.h"
#include "tests/temporary_folder.h"

namespace lightwell {
namespace {

namespace fs = std::filesystem;

class FileTest : public testing::Test {
 protected:
  std::set<std::string> names() const {
    std::set<std::string> all;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_))
      all.insert(entry.path().filename().string());
    return all;
  }
  static std::string text_of(const fs::path& path) {
    const auto bytes = read_file(path);
    return bytes ? std::string(bytes->begin(), bytes->end()) : bytes.error().message();
  }

  const TemporaryFolder temporary_;
  const fs::path folder_ = temporary_.path();
};

using Append = std::function<bool(Bytes)>;

TEST_F(FileTest, IsWrittenAsAWholeOrNotAtAll) {
  const std::filesystem::path path = folder_ / "file";
  ASSERT_TRUE(write_file(path, as_bytes("first")));
  auto failing = write_file(path, [](const std::function<bool(Bytes)>& append) -> Result<void> {
    append(as_bytes("half"));
    return fail("the middle", "failed");
  });
  ASSERT_FALSE(failing);
  EXPECT_EQ(failing.error().message(), path.string() + ": the middle: failed");
  EXPECT_EQ(read_file(path)->size(), 5u);
  std::filesystem::remove(path);
  EXPECT_FALSE(read_file(path));
  EXPECT_FALSE(read_file(folder_));
  EXPECT_FALSE(write_file(folder_, as_bytes("a folder")));
}

// Zeros deflate to a thousandth; what people have does not.
TEST_F(FileTest, GzipIsInflatedToTwoHundredTimesTheFileAtMost) {
  const std::filesystem::path path = folder_ / "bomb";
  ASSERT_TRUE(write_file(path, as_bytes(gzipped(std::string(size_t(40) << 20, '\0')))));
  const auto bomb = read_file(path, true);
  ASSERT_FALSE(bomb);
  EXPECT_EQ(bomb.error().kind, ErrorKind::limit);
  ASSERT_TRUE(write_file(path, as_bytes(gzipped(std::string(size_t(8) << 20, '\0')))));
  EXPECT_TRUE(read_file(path, true)) << "any small content is fine";
  std::filesystem::remove(path);
}

// Tools that pack in parallel or in blocks (bgzip) write many members, the last one empty.
TEST_F(FileTest, IsInflatedMemberByMember) {
  const std::filesystem::path path = folder_ / "packed";
  const auto inflated = [&](const std::string& packed) {
    EXPECT_TRUE(write_file(path, as_bytes(packed)));
    const auto bytes = read_file(path, true, 100);
    return bytes ? std::string(bytes->begin(), bytes->end()) : "error";
  };
  const std::string first = gzipped("v 0 0 0\n"), second = gzipped("v 1 0 0\n");
  EXPECT_EQ(inflated(first + second + gzipped("")), "v 0 0 0\nv 1 0 0\n");
  EXPECT_EQ(inflated(first + second.substr(0, second.size() - 1)), "error");
  EXPECT_EQ(inflated(first + "rubbish"), "error");
  EXPECT_EQ(inflated(first + gzipped(std::string(99, 'v'))), "error") << "beyond the limit together";
  std::filesystem::remove(path);
}

TEST_F(FileTest, ThatIsADeviceIsWrittenToAndNotReplaced) {
  EXPECT_TRUE(write_file("/dev/null", as_bytes("nothing")));
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST_F(FileTest, IsMadeUnderANameThatIsNewEachTimeAndReadableAsUsual) {
  std::set<std::string> seen;
  for (int i = 0; i < 3; i++) {
    auto failing = write_file(folder_ / "pack", [&](const Append& append) -> Result<void> {
      EXPECT_TRUE(append(as_bytes("half")));
      const std::set<std::string> now = names();
      EXPECT_EQ(now.size(), 1u);
      EXPECT_TRUE(now.begin()->ends_with(".part")) << *now.begin();
      seen.insert(now.begin(), now.end());
      return fail("the middle", "failed");
    });
    EXPECT_FALSE(failing);
    EXPECT_TRUE(names().empty()) << "nothing is left of a failure";
  }
  EXPECT_EQ(seen.size(), 3u);
  ASSERT_TRUE(check_writable(folder_ / "pack"));
  EXPECT_TRUE(names().empty());
  ASSERT_TRUE(write_file(folder_ / "pack", as_bytes("whole")));
  EXPECT_EQ(names(), std::set<std::string>{"pack"});
  const mode_t mask = umask(0);
  umask(mask);
  struct stat status {};
  ASSERT_EQ(stat((folder_ / "pack").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0666 & ~mask);
}

// What others write at the same time, and files of similar names, stay.
TEST_F(FileTest, OfAProcessThatWasKilledIsRemovedByTheNext) {
  const std::set<std::string> others = {"pack.0123456789abcdef.part.glb", "pack.0123.part", "a.0123456789abcdef.part"};
  for (const std::string& name : others) ASSERT_TRUE(write_file(folder_ / name, as_bytes("another's")));
  const pid_t writer = fork();
  if (writer == 0) {
    (void)write_file(folder_ / "pack", [](const Append& append) -> Result<void> {
      append(as_bytes("half"));
      raise(SIGKILL);
      return {};
    });
    _exit(1);
  }
  int status = 0;
  ASSERT_EQ(waitpid(writer, &status, 0), writer);
  ASSERT_TRUE(WIFSIGNALED(status));
  ASSERT_EQ(names().size(), others.size() + 1) << "the half file is there";
  ASSERT_TRUE(write_file(folder_ / "pack", [&](const Append& append) -> Result<void> {
    EXPECT_EQ(names().size(), others.size() + 1) << "the half file is gone";
    EXPECT_TRUE(check_writable(folder_ / "pack"));
    EXPECT_EQ(names().size(), others.size() + 1) << "that of this writer is not";
    EXPECT_TRUE(append(as_bytes("whole")));
    return {};
  }));
  EXPECT_EQ(text_of(folder_ / "pack"), "whole");
  EXPECT_EQ(names().size(), others.size() + 1);
}

TEST_F(FileTest, ThatIsALinkStaysOneAndItsTargetIsReplaced) {
  fs::create_directory(folder_ / "packs");
  fs::create_symlink("packs/new", folder_ / "second");
  fs::create_symlink(folder_ / "second", folder_ / "first");
  for (const char* text : {"made", "made again"}) {
    ASSERT_TRUE(check_writable(folder_ / "first"));
    ASSERT_TRUE(write_file(folder_ / "first", as_bytes(text)));
    EXPECT_TRUE(fs::is_symlink(folder_ / "first") && fs::is_symlink(folder_ / "second"));
    EXPECT_FALSE(fs::is_symlink(folder_ / "packs/new"));
    EXPECT_EQ(text_of(folder_ / "packs/new"), text);
  }
}

TEST_F(FileTest, BehindLinksInACircleOrToNowhereIsRefused) {
  fs::create_symlink("left", folder_ / "right");
  fs::create_symlink("right", folder_ / "left");
  fs::create_symlink("no/such/folder", folder_ / "nowhere");
  for (const char* name : {"left", "nowhere"}) {
    const auto written = write_file(folder_ / name, as_bytes("text"));
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().kind, ErrorKind::io);
    EXPECT_EQ(written.error().file, folder_ / name);
    EXPECT_FALSE(check_writable(folder_ / name));
  }
}

TEST_F(FileTest, SaysWhatKindOfFailureItIs) {
  EXPECT_EQ(read_file(folder_ / "none").error().kind, ErrorKind::io);
  EXPECT_EQ(read_file(folder_).error().kind, ErrorKind::io);
  ASSERT_TRUE(write_file(folder_ / "large", std::vector<uint8_t>(200000)));
  EXPECT_EQ(read_file(folder_ / "large", false, 100).error().kind, ErrorKind::limit);
  ASSERT_TRUE(write_file(folder_ / "packed", as_bytes(gzipped("plain") + "rubbish")));
  EXPECT_EQ(read_file(folder_ / "packed", true).error().kind, ErrorKind::bad_input);
}

}  // namespace
}  // namespace lightwell
