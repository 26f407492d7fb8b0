// SPDX-License-Identifier: Apache-2.0
//
// What streams promise is held against what there is before a client makes room for it.
#include "lightwell/client/refiner.h"

#include <gtest/gtest.h>

#include "lightwell/pack/opening.h"
#include "tests/client/sample_pack.h"
#include "tests/pack/pack_samples.h"

namespace lightwell {
namespace {

constexpr uint64_t plenty = uint64_t(1) << 30;

struct Opened {
  std::vector<uint8_t> file = sample_pack(sample_scene(500, 8));
  PackReader reader = PackReader::open(from_memory(file), file.size()).value();

  Result<std::unique_ptr<Refiner>> refiner(uint32_t stream, uint64_t& budget) const {
    return make_refiner(reader.directory(), stream, glb_chunks(reader.opening()).bin, Fill::none, budget);
  }
};

TEST(Refiner, StreamsShareABudgetOfBytes) {
  const Opened pack;
  uint64_t budget = plenty;
  for (uint32_t stream = 0; stream < pack.reader.directory().streams.size(); stream++) {
    const uint64_t before = budget;
    ASSERT_TRUE(pack.refiner(stream, budget));
    const uint64_t needed = before - budget;
    EXPECT_GT(needed, 0u);
    uint64_t exact = needed, short_of_one = needed - 1;
    EXPECT_TRUE(pack.refiner(stream, exact));
    EXPECT_EQ(exact, 0u);
    EXPECT_FALSE(pack.refiner(stream, short_of_one));
  }
}

TEST(Refiner, IsCompleteWithTheLastBlock) {
  const Opened pack;
  uint64_t budget = plenty;
  for (uint32_t stream = 0; stream < pack.reader.directory().streams.size(); stream++) {
    auto refiner = std::move(pack.refiner(stream, budget).value());
    for (uint32_t block = 0; block < pack.reader.directory().streams[stream].blocks; block++) {
      EXPECT_FALSE(refiner->complete());
      ASSERT_TRUE(refiner->append(pack.reader.block(stream, block).value()));
    }
    EXPECT_TRUE(refiner->complete());
  }
}

}  // namespace
}  // namespace lightwell
