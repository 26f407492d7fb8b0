// SPDX-License-Identifier: Apache-2.0
#include "lightwell/pack/reader.h"

#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <thread>

#include "lightwell/base/file.h"
#include "tests/pack/pack_samples.h"
#include "tests/temporary_folder.h"

namespace lightwell {
namespace {

// Four threads read all blocks of one file many times, each in another order. With a shared place in the file, each
// would read where another has moved it to.
TEST(PackReader, IsReadByThreadsAtTheSameTime) {
  const std::vector<PackStream> streams = random_streams(3);
  Random random(4, 0);
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "pack.glb";
  ASSERT_TRUE(write_file(path, make_pack(random_bytes(random, 999), streams)));
  const auto reader = PackReader::open_file(path);
  ASSERT_TRUE(reader) << reader.error().message();
  std::atomic<int> wrong = 0;
  std::vector<std::thread> threads;
  for (uint64_t thread = 0; thread < 4; thread++)
    threads.emplace_back([&, thread] {
      Random order(5, thread);
      for (int i = 0; i < 5000; i++) {
        const size_t stream = order.below(static_cast<uint32_t>(streams.size()));
        if (streams[stream].blocks.empty()) continue;
        const uint32_t block = order.below(static_cast<uint32_t>(streams[stream].blocks.size()));
        const auto payload = reader->block(stream, block);
        if (!payload || *payload != streams[stream].blocks[block].payload) wrong++;
      }
    });
  for (std::thread& thread : threads) thread.join();
  std::filesystem::remove(path);
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace lightwell
