// SPDX-License-Identifier: Apache-2.0
//
// Whatever a network does, a client ends with exactly the scene of the pack, or says clearly why it cannot.
#include <gtest/gtest.h>

#include <cstdlib>

#include "lightwell/pack/opening.h"
#include "tests/client/sample_pack.h"
#include "tests/client/simulated_network.h"
#include "tests/pack/pack_samples.h"

namespace lightwell {
namespace {

using Reason = FailureUpdate::Reason;

struct Sample {
  std::vector<uint8_t> file, other;  ///< two packs of the same layout
  ReceivedScene scene, other_scene;
  OnTheWay on_the_way;  ///< of both
};

const Sample& sample() {
  static const Sample made = [] {
    const SampleScene scene = sample_scene(12000, 12);
    Sample packs{sample_pack(scene), sample_pack(scene, 1), {}, {}, {}};
    packs.scene = decode_directly(packs.file);
    packs.other_scene = decode_directly(packs.other);
    packs.on_the_way = on_the_way(packs.file);
    return packs;
  }();
  return made;
}

ClientOptions options_of(uint64_t seed) {
  ClientOptions options;
  options.strategy = static_cast<Strategy>(seed % 3);
  options.fill = static_cast<Fill>(seed / 3 % 3);
  options.seed = seed;
  return options;
}

/// What was shown is of one of the two packs, whatever else went wrong.
void expect_nothing_wrong_shown(const ReceivedScene& scene) {
  EXPECT_TRUE(scene.shows_only(sample().scene, sample().on_the_way) ||
              scene.shows_only(sample().other_scene, sample().on_the_way));
}

TEST(ReceivedScene, OneWrongFaceIsSeen) {
  EXPECT_TRUE(sample().scene.shows_only(sample().scene, sample().on_the_way));
  ReceivedScene wrong = sample().scene;
  std::vector<uint8_t>& indices = wrong.meshes.begin()->second.buffers.back();
  std::swap_ranges(indices.begin(), indices.begin() + 4, indices.begin() + 4);
  EXPECT_FALSE(wrong.shows_only(sample().scene, sample().on_the_way));
}

/// How many seeds a test tries: the environment's LIGHTWELL_TEST_SCALE times as many as usual.
uint64_t scaled(uint64_t seeds) {
  const char* scale = std::getenv("LIGHTWELL_TEST_SCALE");
  return seeds * (scale ? std::strtoull(scale, nullptr, 10) : 1);
}

/// Runs some seeds; each must end with the pack's scene.
void expect_exact(const Weather& weather, uint64_t seeds, double patience = 3600) {
  for (uint64_t seed = 0; seed < scaled(seeds); seed++) {
    SimulatedNetwork network(weather, seed, sample().file);
    const ReceivedScene scene = network.run(options_of(seed), patience);
    ASSERT_EQ(network.complaint(), "") << "seed " << seed;
    ASSERT_EQ(scene.failure, "") << "seed " << seed;
    ASSERT_TRUE(scene.complete) << "seed " << seed << ", " << network.now() << " s";
    ASSERT_TRUE(scene == sample().scene) << "seed " << seed;
    EXPECT_LE(network.most_in_flight(), 4u);
  }
}

/// Runs some seeds; each must end with the pack's scene, or with a failure of this reason and nothing wrong shown.
/// Gives the share of failures.
double expect_exact_or(Reason reason, const Weather& weather, uint64_t seeds) {
  double failures = 0;
  for (uint64_t seed = 0; seed < scaled(seeds); seed++) {
    SimulatedNetwork network(weather, seed, sample().file, sample().other);
    const ReceivedScene scene = network.run(options_of(seed));
    EXPECT_EQ(network.complaint(), "") << "seed " << seed;
    if (scene.failure.empty()) {
      EXPECT_TRUE(scene == sample().scene || scene == sample().other_scene) << "seed " << seed;
      continue;
    }
    failures++;
    EXPECT_EQ(scene.reason, reason) << "seed " << seed << ": " << scene.failure;
    expect_nothing_wrong_shown(scene);
  }
  return failures / static_cast<double>(scaled(seeds));
}

TEST(Network, Good) { expect_exact({}, 3); }

TEST(Network, SlowAndFar) {
  expect_exact({.latency = 0.6, .rate = 4000}, 3);
  expect_exact({.latency = 2, .jitter = 3, .rate = 1e8}, 3);
}

TEST(Network, AnswersOvertakeEachOther) { expect_exact({.jitter = 0.5, .rate = 2e5}, 3); }

TEST(Network, RequestsAreLost) { expect_exact({.lost = 0.3}, 3); }

TEST(Network, PauseEndsWhileTheDriverIsBusy) { expect_exact({.lost = 0.5, .busy = 0.5}, 3); }

TEST(Network, ServerFallsSilent) { expect_exact({.silent = 0.1}, 3); }

TEST(Network, BodiesEndEarly) {
  expect_exact({.truncated = 0.4}, 3);
  expect_exact({.broken = 0.4}, 3);
}

// The headers that tell the lengths of the file, the opening and the directory lie in these bytes.
TEST(Network, FirstBodyBreaksAnywhereInTheHeaders) {
  const std::vector<uint8_t> file = sample_pack(sample_scene(100, 2));
  const ReceivedScene whole = decode_directly(file);
  for (size_t length = 0; length <= 100; length++) {
    SimulatedNetwork network({.first_body_bytes = length}, 1, file);
    EXPECT_TRUE(network.run({}, 60) == whole) << length << " bytes";
  }
}

TEST(Network, ServerIsOverloaded) { expect_exact({.overloaded = 0.3}, 3); }

TEST(Network, AnswersAreRepeated) { expect_exact({.repeated = 0.5}, 3); }

TEST(Network, HeadersAreNotReadable) { expect_exact({.lost = 0.1, .truncated = 0.1, .readable_headers = false}, 3); }

TEST(Network, ServerWithoutRanges) {
  expect_exact({.ranges = false}, 3);
  expect_exact({.lost = 0.2, .broken = 0.2, .ranges = false}, 3);
}

// Blocks are longer than what comes at once, and are put together (RFC 9110, 15.3.7).
TEST(Network, ServerGivesLessThanItIsAskedFor) {
  expect_exact({.longest_range = 700}, 3);
  expect_exact({.lost = 0.2, .broken = 0.2, .longest_range = 2000}, 3);
}

/// Within 30 s, as a visitor waits.
TEST(Network, ServersWhoseRangesAreOfNoUseAreAskedForAll) {
  for (const Weather& weather : {Weather{.wrong_ranges = true}, Weather{.nonsense = true}, Weather{.undecodable = true},
                                 Weather{.undecodable = true, .readable_headers = false}})
    expect_exact(weather, 3, 30);
}

TEST(Network, ServerThatSendsTheBeginningForAnythingIsNamed) {
  for (const uint64_t bytes : {uint64_t(10), sample().file.size() / 2}) {
    SimulatedNetwork network({.whole_bytes = bytes, .ranges = false}, 1, sample().file);
    const ReceivedScene scene = network.run(options_of(1), 30);
    EXPECT_EQ(network.complaint(), "");
    EXPECT_FALSE(scene.failure.empty()) << network.now();
    EXPECT_TRUE(scene.failure.find("(Range)") != std::string::npos ||
                scene.failure.find("should have") != std::string::npos)
        << scene.failure;
  }
}

TEST(Network, ServerGoesAndComesBack) {
  expect_exact({.rate = 1e5, .gone_from = 0.5, .gone_until = 300}, 3);
  expect_exact({.gone_from = 0, .gone_until = 1000}, 3);
}

TEST(Network, EqualFilesOnSeveralServers) { expect_exact({.servers = 3}, 3); }

TEST(Network, EverythingAtOnce) {
  expect_exact({.latency = 0.1,
                .jitter = 0.3,
                .rate = 1e5,
                .lost = 0.1,
                .silent = 0.02,
                .truncated = 0.1,
                .broken = 0.1,
                .overloaded = 0.1,
                .repeated = 0.1},
               9);
}

TEST(Network, CorruptedBytes) {
  // The chance that one place is hit twice is small but not zero: then the failure names it.
  EXPECT_LE(expect_exact_or(Reason::unreadable, {.corrupted = 0.1}, 6), 1.0 / 3);
}

TEST(Network, EveryBodyIsCorrupted) {
  for (uint64_t seed = 0; seed < scaled(4); seed++) {
    SimulatedNetwork network({.corrupted = 1}, seed, sample().file);
    const ReceivedScene scene = network.run(options_of(seed));
    EXPECT_NE(scene.failure, "");
    EXPECT_FALSE(scene.complete);
    expect_nothing_wrong_shown(scene);
  }
}

TEST(Network, DamagedFileIsNamed) {
  std::vector<uint8_t> damaged = sample().file;
  damaged[damaged.size() - 1000] ^= 1;  // in the last stream, the texture's
  SimulatedNetwork network({}, 1, damaged);
  const ReceivedScene scene = network.run({});
  EXPECT_NE(scene.failure.find("stream 3, block"), std::string::npos) << scene.failure;
}

// A pack whose streams keep no promise but those of the container: the blocks that are there are good.
TEST(Network, IncompleteStreamIsNamed) {
  const PackReader reader = PackReader::open(from_memory(sample().file), sample().file.size()).value();
  const std::vector<StreamEntry>& entries = reader.directory().streams;
  for (size_t cut = 0; cut < entries.size(); cut++)
    for (const bool all : {false, true}) {
      if (entries[cut].blocks == 0) continue;  // the walls are complete from the start
      std::vector<PackStream> streams = streams_of(reader);
      streams[cut].blocks.resize(all ? 0 : entries[cut].blocks - 1);
      const Bytes bin = glb_chunks(reader.opening()).bin;
      const std::vector<uint8_t> file = make_pack({bin.begin(), bin.end()}, std::move(streams));
      SimulatedNetwork network({}, 1, file);
      const ReceivedScene scene = network.run({});
      EXPECT_FALSE(scene.complete);
      EXPECT_NE(scene.failure.find("stream " + std::to_string(cut)), std::string::npos) << scene.failure;
    }
}

TEST(Network, UnknownCodecIsNamed) {
  const PackReader reader = PackReader::open(from_memory(sample().file), sample().file.size()).value();
  for (size_t stream = 0; stream < reader.directory().streams.size(); stream++) {
    const std::vector<uint8_t> file = with_codec(reader, stream, 7);
    SimulatedNetwork network({}, 1, file);
    const ReceivedScene scene = network.run({});
    EXPECT_EQ(scene.failure, "stream " + std::to_string(stream) + ": codec: the " +
                                 to_text(reader.directory().streams[stream].kind) +
                                 " codec 7 is not known to this program");
    EXPECT_EQ(scene.reason, Reason::unreadable);
    EXPECT_EQ(scene.kind, ErrorKind::unsupported);
    EXPECT_FALSE(scene.complete);
  }
}

TEST(Network, FileIsReplaced) {
  double failures = 0;
  const std::vector<double> times = {0.01, 0.05, 0.1, 0.2, 0.4};
  for (const double time : times)
    for (const bool headers : {true, false})
      failures += expect_exact_or(Reason::replaced, {.rate = 3e5, .readable_headers = headers, .replaced_at = time}, 2);
  EXPECT_GT(failures, static_cast<double>(times.size())) << "most of these times are in the middle of the stream";
}

TEST(Network, FileIsCutShort) {
  const size_t length = sample().file.size();
  for (const size_t cut : {size_t(1), size_t(11), size_t(5000), length / 2, length - 10})
    for (const bool ranges : {true, false})
      for (const bool headers : {true, false}) {
        SimulatedNetwork network({.ranges = ranges, .readable_headers = headers, .serves_bytes = cut}, 1,
                                 sample().file);
        const ReceivedScene scene = network.run({}, 100);
        EXPECT_EQ(network.complaint(), "");
        EXPECT_FALSE(scene.complete) << cut;
        expect_nothing_wrong_shown(scene);
        // What is missing at the end of a body looks like a bad line, and is tried again, unless the length can be read
        // or something lies wholly behind the cut.
        const bool known = ranges && (headers || cut != length - 10);
        EXPECT_TRUE(!known || !scene.failure.empty()) << cut << " of " << length;
      }
}

}  // namespace
}  // namespace lightwell
