// SPDX-License-Identifier: Apache-2.0
#include "lightwell/base/file_blocks.h"

#include <gtest/gtest.h>

#include "lightwell/base/random.h"

namespace lightwell {
namespace {

std::vector<uint8_t> random_bytes(size_t size) {
  Random random(1, size);
  std::vector<uint8_t> bytes(size);
  for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(random.bits());
  return bytes;
}

TEST(FileBlocks, MakeUpFilesOfEverySize) {
  for (const size_t size : {size_t(1), file_block_bytes - 1, file_block_bytes, file_block_bytes + 1, size_t(100000)}) {
    const auto file = random_bytes(size);
    FileBlocks blocks(static_cast<uint32_t>(size));
    for (const Bytes block : file_blocks(file)) {
      EXPECT_FALSE(blocks.complete());
      ASSERT_TRUE(blocks.append(block));
    }
    EXPECT_TRUE(blocks.complete());
    EXPECT_EQ(blocks.file(), file);
  }
}

TEST(FileBlocks, ThatDoNotFitAreRefused) {
  const auto file = random_bytes(file_block_bytes + 10);
  const Bytes bytes(file);
  FileBlocks blocks(static_cast<uint32_t>(file.size()));
  EXPECT_FALSE(blocks.append({}));
  EXPECT_FALSE(blocks.append(bytes));
  EXPECT_FALSE(blocks.append(bytes.first(file_block_bytes - 1)));
  ASSERT_TRUE(blocks.append(bytes.first(file_block_bytes)));
  EXPECT_FALSE(blocks.append(bytes.first(file_block_bytes)));
  ASSERT_TRUE(blocks.append(bytes.subspan(file_block_bytes)));
  EXPECT_FALSE(blocks.append(bytes.first(1)));
  EXPECT_EQ(blocks.file(), file);
}

}  // namespace
}  // namespace lightwell
