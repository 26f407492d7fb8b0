// SPDX-License-Identifier: Apache-2.0
#include "lightwell/gltf/resource.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/gltf/samples.h"
#include "tests/temporary_folder.h"

namespace lightwell {
namespace {

namespace fs = std::filesystem;

/// A folder with a file inside, a file beside it and links that lead in and out.
class Resource : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder_ / "sub dir");
    std::ofstream(folder_ / "sub dir" / "a+b%.bin") << "inside";
    std::ofstream(root_ / "secret.bin") << "outside";
    fs::create_symlink(root_ / "secret.bin", folder_ / "out.bin");
    fs::create_symlink(folder_ / "sub dir" / "a+b%.bin", folder_ / "in.bin");
    fs::create_directory_symlink(root_, folder_ / "up");
  }

  std::string read(const std::string& uri) const {
    const auto bytes = read_uri(uri, folder_);
    return bytes ? std::string(bytes->begin(), bytes->end()) : "error: " + bytes.error().reason;
  }

  const TemporaryFolder temporary_;
  const fs::path root_ = temporary_.path();
  const fs::path folder_ = root_ / "folder";
};

TEST_F(Resource, FilesBelowTheFolderAreRead) {
  EXPECT_EQ(read("sub%20dir/a+b%25.bin"), "inside");
  EXPECT_EQ(read("sub dir/a+b%.bin"), "inside");  // not encoded, as some exporters write it
  EXPECT_EQ(read("./sub%20dir/./a%2Bb%.bin"), "inside");
  EXPECT_EQ(read("in.bin"), "inside");
}

TEST_F(Resource, NothingElseIs) {
  const std::string outside = "error: its URI does not lead to a file below the document's folder";
  EXPECT_EQ(read("../secret.bin"), outside);
  EXPECT_EQ(read("sub dir/../../secret.bin"), outside);
  EXPECT_EQ(read("%2e%2e/secret.bin"), outside);
  EXPECT_EQ(read("..%2Fsecret.bin"), outside);
  EXPECT_EQ(read((root_ / "secret.bin").string()), outside);
  EXPECT_EQ(read(""), outside);
  EXPECT_EQ(read("in.bin%00.png"), outside);
  EXPECT_EQ(read("out.bin"), "error: its URI leads out of the document's folder by a link");
  EXPECT_EQ(read("up/secret.bin"), "error: its URI leads out of the document's folder by a link");
  EXPECT_EQ(read("file:///etc/passwd"), "error: its URI has a scheme, only files beside the document are read");
  EXPECT_EQ(read("https://example.org/a.bin"), "error: its URI has a scheme, only files beside the document are read");
  EXPECT_EQ(read("sub dir"), "error: the file sub dir cannot be found");
  EXPECT_EQ(read("nothing.bin"), "error: the file nothing.bin cannot be found");
}

TEST_F(Resource, DataUrisAreDecoded) {
  EXPECT_EQ(read("data:application/octet-stream;base64,TGlnaHR3ZWxs"), "Lightwell");
  EXPECT_EQ(read("data:;base64,TGlnaHR3ZWxsLg=="), "Lightwell.");
  EXPECT_EQ(read("data:;base64,TGlnaHR3ZWxsLg"), "Lightwell.");
  EXPECT_EQ(read("data:,a%20b"), "a b");
  EXPECT_EQ(read("data:;base64,TGlnaA=a"), "error: its data URI holds a character that is not base64");
  EXPECT_EQ(read("data:;base64,TGlna"), "error: its data URI ends within a byte");
  EXPECT_EQ(read("data:;base64"), "error: its data URI has no data");
}

TEST_F(Resource, BuffersOfADocumentComeFromFiles) {
  const Document document = document_of(square());
  Json json = document.json;
  json["buffers"][0]["uri"] = "square.bin";
  std::ofstream(folder_ / "square.bin", std::ios::binary)
      .write(reinterpret_cast<const char*>(document.buffers[0].data()),
             static_cast<std::streamsize>(document.buffers[0].size()));
  Report report;
  const auto read = read_document(bytes_of(json.dump()), folder_, report);
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_EQ(read->buffers, document.buffers);
  EXPECT_EQ(read_primitive(*read, 0, 0, report)->positions, square().positions);
}

}  // namespace
}  // namespace lightwell
