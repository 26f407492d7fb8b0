// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "lightwell/base/crc32c.h"
#include "lightwell/pack/block_table.h"
#include "lightwell/pack/opening.h"
#include "lightwell/pack/self_contained.h"
#include "tests/pack/pack_samples.h"

namespace lightwell {
namespace {

constexpr uint64_t seed = 7;

std::vector<uint8_t> sample_bin() {
  Random random(seed, 1);
  return random_bytes(random, 1001);
}

std::vector<uint8_t> sample_pack() { return make_pack(sample_bin(), random_streams(seed)); }

/// Reads a file as far as a verifier would. The first error, if any.
Result<void> read_everything(Bytes file) {
  LW_TRY(reader, PackReader::open(from_memory(file), file.size()));
  return reader.verify_id();
}

TEST(Pack, RoundTrip) {
  const std::vector<PackStream> streams = random_streams(seed);
  const std::vector<uint8_t> file = make_pack(sample_bin(), streams);
  const auto reader = PackReader::open(from_memory(file), file.size());
  ASSERT_TRUE(reader) << reader.error().message();
  ASSERT_EQ(reader->directory().streams.size(), streams.size());
  for (size_t i = 0; i < streams.size(); i++) {
    const StreamEntry& entry = reader->directory().streams[i];
    EXPECT_EQ(entry.kind, streams[i].kind);
    EXPECT_EQ(entry.codec, streams[i].codec);
    EXPECT_EQ(entry.error, streams[i].error);
    EXPECT_EQ(entry.parameters, streams[i].parameters);
    ASSERT_EQ(reader->rows(i).size(), streams[i].blocks.size());
    for (uint32_t block = 0; block < entry.blocks; block++) {
      const PackBlock& written = streams[i].blocks[block];
      EXPECT_EQ(reader->rows(i)[block],
                (BlockRow{static_cast<uint32_t>(written.payload.size() + 4), written.adds, written.error}));
      EXPECT_EQ(reader->block(i, block).value(), written.payload);
    }
  }
  EXPECT_TRUE(reader->verify_id());
  std::vector<uint8_t> bin = sample_bin();
  bin.resize(1004);
  const GlbChunks chunks = glb_chunks(reader->opening());
  EXPECT_EQ(std::vector<uint8_t>(chunks.bin.begin(), chunks.bin.end()), bin);
}

TEST(Pack, IsAGlbWhoseThirdChunkReachesTheEnd) {
  const std::vector<uint8_t> file = sample_pack();
  ByteReader reader(file);
  EXPECT_EQ(reader.u32(), glb_magic);
  EXPECT_EQ(reader.u32(), 2u);
  EXPECT_EQ(reader.u32(), file.size());
  for (const uint32_t type : {glb_json_chunk, glb_bin_chunk, chunk_lwst}) {
    const uint32_t length = reader.u32();
    EXPECT_EQ(length % 4, 0u);
    EXPECT_EQ(reader.u32(), type);
    reader.take(length);
  }
  EXPECT_TRUE(reader.ok());
  EXPECT_EQ(reader.remaining(), 0u);
}

TEST(Pack, PlanDoesNotDependOnTheJson) {
  const PackWriter writer = PackWriter::create(sample_bin(), random_streams(seed)).value();
  for (const size_t length : {2, 300, 5001}) {
    const std::vector<uint8_t> file = writer.finish(std::string(length, ' ')).value();
    const auto reader = PackReader::open(from_memory(file), file.size());
    ASSERT_TRUE(reader);
    EXPECT_EQ(reader->directory().id, writer.plan().id);
    EXPECT_EQ(reader->directory().streams, writer.plan().streams);
  }
}

// Whoever keeps packs by their ids never takes one for another that is read differently.
TEST(Pack, TheIdCoversAllThatTheDirectorySaysOfStreams) {
  const auto id_of = [](const std::vector<PackStream>& streams) {
    return to_text(PackWriter::create(sample_bin(), streams)->plan().id);
  };
  const std::vector<PackStream> streams = random_streams(seed);
  std::set<std::string> ids{id_of(streams)};
  const auto expect_another = [&](const auto& change) {
    std::vector<PackStream> changed = streams;
    change(changed[1]);
    EXPECT_TRUE(ids.insert(id_of(changed)).second);
  };
  expect_another(
      [](PackStream& stream) { stream.kind = static_cast<StreamKind>((int(stream.kind) + 1) % stream_kinds); });
  expect_another([](PackStream& stream) { stream.codec++; });
  expect_another([](PackStream& stream) { stream.error++; });
  expect_another([](PackStream& stream) { stream.parameters.push_back(0); });
  expect_another([](PackStream& stream) { stream.blocks[0].adds++; });
  expect_another([](PackStream& stream) { stream.blocks[0].error++; });
}

TEST(Pack, WorksWithoutBinAndWithoutStreams) {
  const std::vector<uint8_t> file = make_pack({}, {});
  EXPECT_TRUE(read_everything(file));
  const auto reader = PackReader::open(from_memory(file), file.size());
  EXPECT_TRUE(glb_chunks(reader->opening()).bin.empty());
}

TEST(Pack, SameContentSameBytes) { EXPECT_EQ(sample_pack(), sample_pack()); }

TEST(Pack, EveryPrefixIsRefused) {
  Random random(seed, 2);
  const std::vector<uint8_t> file =
      make_pack(random_bytes(random, 9),
                {random_stream(random, StreamKind::mesh, 70, 9), random_stream(random, StreamKind::light, 2, 9)});
  for (size_t length = 0; length < file.size(); length++)
    EXPECT_FALSE(read_everything(Bytes(file).first(length))) << length;
}

TEST(Pack, EveryFlippedBitIsFound) {
  Random random(seed, 3);
  // One stream of 66 blocks has a table page as well; no padding follows, which nothing covers.
  std::vector<PackStream> streams = {random_stream(random, StreamKind::mesh, 66, 5)};
  std::vector<uint8_t> file;
  do {
    streams[0].blocks[0].payload.push_back(1);
    file = make_pack(random_bytes(random, 8), streams);
  } while (file.back() == 0);
  for (size_t at = 0; at < file.size(); at++) {
    std::vector<uint8_t> damaged = file;
    damaged[at] ^= static_cast<uint8_t>(1u << random.below(8));
    EXPECT_FALSE(read_everything(damaged)) << at;
  }
}

TEST(Pack, ABlockOfAnotherPackFailsItsCheck) {
  PackId one{}, other{};
  other[15] = 1;
  const std::vector<uint8_t> payload = {1, 2, 3};
  ByteWriter block;
  block.append(payload);
  block.u32(block_check(payload, one));
  EXPECT_EQ(checked_payload(block.bytes(), one).size(), payload.size());
  EXPECT_TRUE(checked_payload(block.bytes(), other).empty());
}

TEST(Pack, LimitsAreErrorsOfTheWriter) {
  const auto refused = [](PackStream stream) { return !PackWriter::create({}, {std::move(stream)}); };
  const PackBlock block{{1}, 1, 0};
  EXPECT_FALSE(refused({StreamKind::mesh, 0, 1, {}, {block}}));
  EXPECT_TRUE(refused({StreamKind::mesh, 0, -1, {}, {block}}));
  EXPECT_TRUE(refused({StreamKind::mesh, 0, 1, {}, {{{}, 1, 0}}}));
  EXPECT_TRUE(refused({StreamKind::mesh, 0, 1, {}, {{{1}, 1, std::numeric_limits<float>::quiet_NaN()}}}));
  EXPECT_TRUE(refused({StreamKind::mesh, 0, 1, {}, {{std::vector<uint8_t>(max_block_bytes), 1, 0}}}));
  EXPECT_TRUE(refused({StreamKind::mesh, 0, 1, std::vector<uint8_t>(max_parameter_bytes + 1), {block}}));
}

/// A directory with one field changed and its check made right again.
std::vector<uint8_t> directory_with(size_t at, uint32_t value, size_t length = 4) {
  Directory directory{{}, 100, 0, {StreamEntry{StreamKind::mesh, 0, 0, 10, 1, 1, {}, {{10, 1, 0}}}}};
  directory.streams[0].first = static_cast<uint32_t>(directory.byte_length());
  std::vector<uint8_t> bytes = directory.write();
  for (size_t i = 0; i < length; i++) bytes[at + i] = static_cast<uint8_t>(value >> 8 * i);
  const uint32_t check = crc32c(Bytes(bytes).first(bytes.size() - 4));
  for (size_t i = 0; i < 4; i++) bytes[bytes.size() - 4 + i] = static_cast<uint8_t>(check >> 8 * i);
  return bytes;
}

TEST(Directory, EveryFieldIsChecked) {
  const size_t length = directory_with(0, 0, 0).size();
  const uint64_t file_length = 100 + length + 10;
  const auto read = [&](size_t at, uint32_t value, size_t bytes = 4) {
    return Directory::read(directory_with(at, value, bytes), file_length);
  };
  ASSERT_TRUE(read(0, 0, 0)) << read(0, 0, 0).error().message();
  EXPECT_FALSE(read(0, static_cast<uint32_t>(length) - 1));
  EXPECT_FALSE(read(24, 96)) << "the streams then end before the file does";
  EXPECT_FALSE(read(32, 2)) << "more streams than there are";
  EXPECT_FALSE(read(32, 0xffffffff));
  constexpr size_t stream = 36;
  EXPECT_FALSE(read(stream, stream_kinds, 1)) << "kind";
  EXPECT_TRUE(read(stream + 1, 77, 1)) << "codecs belong to the kinds";
  EXPECT_FALSE(read(stream + 2, 1, 2)) << "reserved";
  EXPECT_FALSE(read(stream + 4, static_cast<uint32_t>(length) + 1)) << "a gap";
  EXPECT_FALSE(read(stream + 8, 11)) << "beyond the file";
  EXPECT_FALSE(read(stream + 8, 0xffffffff));
  EXPECT_FALSE(read(stream + 12, 2)) << "more blocks than rows";
  EXPECT_FALSE(read(stream + 12, 0xffffffff));
  EXPECT_FALSE(read(stream + 16, 0x7f800000)) << "an infinite error";
  EXPECT_FALSE(read(stream + 20, 0xffffffff)) << "parameters";
  EXPECT_FALSE(read(stream + 24, 11)) << "a block longer than the stream";
  EXPECT_FALSE(read(stream + 24, 4)) << "a block without a payload";
  EXPECT_FALSE(read(stream + 24 + 8, 0xbf800000)) << "a negative error";
}

// The shortest stream of n blocks: payloads of one byte. A stream that is shorter cannot have so many, which shows
// before anybody makes room for them.
TEST(BlockTable, AStreamIsAsLongAsItsBlocksAndPages) {
  for (const uint32_t blocks : {1u, 64u, 65u, 128u, 129u, 1025u}) {
    const PackBlock block{{1}, 1, 0};
    const PackStream stream{StreamKind::mesh, 0, 1, {}, std::vector<PackBlock>(blocks, block)};
    const std::vector<uint8_t> file = make_pack({}, {stream});
    StreamEntry entry = PackReader::open(from_memory(file), file.size())->directory().streams[0];
    EXPECT_TRUE(BlockTable::place(entry, 0)) << blocks;
    entry.length--;
    EXPECT_FALSE(BlockTable::place(entry, 0)) << blocks;
  }
}

TEST(Directory, AnotherVersionIsRefusedByName) {
  const auto read = Directory::read(directory_with(4, 9), 1000);
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message().find("version 9"), std::string::npos);
}

TEST(Opening, IsMeasuredFromAnyPrefix) {
  const std::vector<uint8_t> file = sample_pack();
  const OpeningSize whole = measure_opening(file).value();
  ASSERT_TRUE(whole.complete);
  for (size_t length = 0; length <= file.size(); length++) {
    const auto size = measure_opening(Bytes(file).first(length));
    ASSERT_TRUE(size);
    EXPECT_TRUE(size->complete || size->needed > length);
    EXPECT_LE(size->needed, whole.needed);
  }
}

TEST(Opening, OfAPlainGlbIsRefused) {
  ByteWriter file;
  file.u32(glb_magic);
  file.u32(2);
  file.u32(28);
  file.u32(8);
  file.u32(glb_json_chunk);
  file.append(as_bytes("{      }"));
  const auto size = measure_opening(file.bytes());
  ASSERT_FALSE(size);
  EXPECT_NE(size.error().message().find("is no pack"), std::string::npos);
}

TEST(SelfContained, FindsReferences) {
  EXPECT_TRUE(check_self_contained(R"({"buffers":[{"byteLength":4}],"extras":{"note":"uri: x"}})"));
  EXPECT_TRUE(check_self_contained(R"({"images":[{"uri":"data:image/png;base64,AA=="}]})"));
  EXPECT_TRUE(check_self_contained(R"({"name":"uri"})"));
  EXPECT_FALSE(check_self_contained(R"({"images":[{"uri":"a.png"}]})"));
  EXPECT_FALSE(check_self_contained(R"({"images":[{ "uri" : "http://example.org/" }]})"));
  EXPECT_FALSE(check_self_contained(R"({"images":[{"\u0075r\u0069":"a.png"}]})"));
  EXPECT_FALSE(check_self_contained(R"({"a":"\"uri","bu\u0066fers":[{"extras":{"uri":1},"uri":"..\/x"}]})"));
  EXPECT_FALSE(check_self_contained(R"({"nodes":[[{}]],"images":[{"uri":"data:,x"},{"name":"]","uri":"x"}]})"));
  // Nobody fetches these.
  EXPECT_TRUE(check_self_contained(R"({"asset":{"extras":{"uri":"https://museum.example/1"}}})"));
  EXPECT_TRUE(check_self_contained(R"({"nodes":[{"uri":"a"}],"images":[{"extras":{"uri":"b"}}],"uri":"c"})"));
  for (const char* broken : {"\"", "\"uri\"", "\"uri\":", "\"uri\":\"", "\"\\", "\"\\u00"})
    check_self_contained(broken);
}

}  // namespace
}  // namespace lightwell
