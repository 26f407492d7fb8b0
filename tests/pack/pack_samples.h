// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "lightwell/base/random.h"
#include "lightwell/pack/opening.h"
#include "lightwell/pack/reader.h"
#include "lightwell/pack/writer.h"

namespace lightwell {

inline std::vector<uint8_t> random_bytes(Random& random, size_t length) {
  std::vector<uint8_t> bytes(length);
  for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(random.bits());
  return bytes;
}

/// A stream of random blocks of 1 ... `longest` bytes.
inline PackStream random_stream(Random& random, StreamKind kind, uint32_t blocks, uint32_t longest) {
  PackStream stream;
  stream.kind = kind;
  stream.codec = static_cast<uint8_t>(random.below(4));
  stream.error = static_cast<float>(blocks + 1);
  stream.parameters = random_bytes(random, random.below(40));
  for (uint32_t i = 0; i < blocks; i++)
    stream.blocks.push_back(
        {random_bytes(random, 1 + random.below(longest)), random.below(1000), static_cast<float>(blocks - i)});
  return stream;
}

/// Streams whose numbers of blocks stand on both sides of the pages' borders.
inline std::vector<PackStream> random_streams(uint64_t seed) {
  Random random(seed, 0);
  std::vector<PackStream> streams;
  for (const uint32_t blocks : {0u, 1u, 63u, 64u, 65u, 128u, 129u, 200u})
    streams.push_back(random_stream(random, static_cast<StreamKind>(random.below(stream_kinds)), blocks, 50));
  return streams;
}

inline std::vector<uint8_t> make_pack(std::vector<uint8_t> bin, std::vector<PackStream> streams,
                                      std::string text = "{\"asset\":{}}") {
  return PackWriter::create(std::move(bin), std::move(streams)).value().finish(std::move(text)).value();
}

/// The streams of a pack as a writer takes them.
inline std::vector<PackStream> streams_of(const PackReader& reader) {
  std::vector<PackStream> streams;
  for (size_t i = 0; i < reader.directory().streams.size(); i++) {
    const StreamEntry& entry = reader.directory().streams[i];
    streams.push_back({entry.kind, entry.codec, entry.error, entry.parameters, {}});
    for (uint32_t block = 0; block < entry.blocks; block++)
      streams[i].blocks.push_back(
          {reader.block(i, block).value(), reader.rows(i)[block].adds, reader.rows(i)[block].error});
  }
  return streams;
}

/// The pack with another codec number of one stream: its checks are right, and nothing else is changed.
inline std::vector<uint8_t> with_codec(const PackReader& reader, size_t stream, uint8_t codec) {
  std::vector<PackStream> streams = streams_of(reader);
  streams[stream].codec = codec;
  const GlbChunks chunks = glb_chunks(reader.opening());
  return make_pack({chunks.bin.begin(), chunks.bin.end()}, std::move(streams),
                   {chunks.json.begin(), chunks.json.end()});
}

/// Reads from bytes in memory, which must outlive it.
inline FetchBytes from_memory(Bytes file) {
  return [file](uint64_t first, uint64_t length) -> Result<std::vector<uint8_t>> {
    if (first > file.size() || length > file.size() - first) return fail("memory", "is too short");
    const Bytes part = file.subspan(first, length);
    return std::vector<uint8_t>(part.begin(), part.end());
  };
}

}  // namespace lightwell
