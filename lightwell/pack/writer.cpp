// SPDX-License-Identifier: Apache-2.0
#include "lightwell/pack/writer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "lightwell/base/crc32c.h"
#include "lightwell/pack/block_table.h"
#include "lightwell/pack/content_hash.h"
#include "lightwell/pack/opening.h"

namespace lightwell {
namespace {

constexpr uint64_t max_file_bytes = std::numeric_limits<uint32_t>::max() & ~uint64_t(3);

BlockRow row_of(const PackBlock& block) {
  return {static_cast<uint32_t>(block.payload.size() + block_check_bytes), block.adds, block.error};
}

Result<StreamEntry> entry_of(const PackStream& stream, size_t index) {
  const auto wrong = [&](ErrorKind kind, std::string_view reason) {
    return fail(kind, "stream " + std::to_string(index), reason);
  };
  if (stream.blocks.size() > max_stream_blocks) return wrong(ErrorKind::limit, "has too many blocks");
  if (stream.parameters.size() > max_parameter_bytes) return wrong(ErrorKind::limit, "its parameters are too long");
  if (!(stream.error >= 0 && std::isfinite(stream.error)))
    return wrong(ErrorKind::bad_input, "its error is negative or no number");
  for (const PackBlock& block : stream.blocks) {
    if (block.payload.empty()) return wrong(ErrorKind::bad_input, "has an empty block");
    if (block.payload.size() > max_block_bytes - block_check_bytes)
      return wrong(ErrorKind::limit, "has a block of more than 16 MiB");
    if (!(block.error >= 0 && std::isfinite(block.error)))
      return wrong(ErrorKind::bad_input, "a block's error is negative or no number");
  }
  StreamEntry entry;
  entry.kind = stream.kind;
  entry.codec = stream.codec;
  entry.blocks = static_cast<uint32_t>(stream.blocks.size());
  entry.error = stream.error;
  entry.parameters = stream.parameters;
  for (uint32_t i = 0; i < std::min(entry.blocks, rows_per_page); i++) entry.rows.push_back(row_of(stream.blocks[i]));
  return entry;
}

/// The payloads of a stream in the order of the file: its blocks, with a table page after each 64th while more follow.
using Payloads = std::vector<std::vector<uint8_t>>;

Payloads payloads_of(PackStream stream) {
  Payloads payloads;
  const size_t count = stream.blocks.size();
  for (size_t i = 0; i < count; i++) {
    payloads.push_back(std::move(stream.blocks[i].payload));
    if ((i + 1) % rows_per_page != 0 || i + 1 == count) continue;
    std::vector<BlockRow> rows;
    for (size_t next = i + 1; next < std::min(count, i + 1 + rows_per_page); next++)
      rows.push_back(row_of(stream.blocks[next]));
    ByteWriter page;
    write_rows(page, rows);
    payloads.push_back(page.release());
  }
  return payloads;
}

/// Says where the streams will lie: one behind the other, the first behind the directory.
Result<void> place_streams(std::vector<StreamEntry>& streams, std::span<const Payloads> payloads) {
  const size_t directory_length = Directory{{}, 0, 0, streams}.byte_length();
  if (directory_length > max_directory_bytes) return fail(ErrorKind::limit, "pack", "its directory exceeds 64 MiB");
  uint64_t end = directory_length;
  for (size_t i = 0; i < streams.size(); i++) {
    const uint64_t first = end;
    for (const std::vector<uint8_t>& payload : payloads[i]) end += payload.size() + block_check_bytes;
    if (end > max_file_bytes) return fail(ErrorKind::limit, "pack", "exceeds the 4 GiB of a binary glTF");
    streams[i].first = static_cast<uint32_t>(first);
    streams[i].length = static_cast<uint32_t>(end - first);
  }
  return {};
}

PackId id_of(Bytes bin, const std::vector<StreamEntry>& streams, std::span<const Payloads> payloads) {
  ContentHash hash;
  hash.update(bin);
  hash.update(Directory{{}, 0, 0, streams}.write_streams());
  for (const Payloads& stream : payloads)
    for (const std::vector<uint8_t>& payload : stream) hash.update(payload);
  return hash.finish();
}

void append_chunk_header(ByteWriter& file, size_t length, uint32_t type) {
  file.u32(static_cast<uint32_t>(length));
  file.u32(type);
}

size_t padded(size_t length) { return (length + 3) / 4 * 4; }

}  // namespace

Result<PackWriter> PackWriter::create(std::vector<uint8_t> bin, std::vector<PackStream> streams) {
  if (streams.size() > max_streams) return fail(ErrorKind::limit, "pack", "has more than 65536 streams");
  PackWriter writer;
  bin.resize(padded(bin.size()));
  writer.bin_ = std::move(bin);

  std::vector<Payloads> payloads;
  for (size_t i = 0; i < streams.size(); i++) {
    LW_TRY(entry, entry_of(streams[i], i));
    writer.plan_.streams.push_back(std::move(entry));
    payloads.push_back(payloads_of(std::move(streams[i])));
  }
  LW_CHECK(place_streams(writer.plan_.streams, payloads));
  writer.plan_.id = id_of(writer.bin_, writer.plan_.streams, payloads);

  ByteWriter data;
  for (Payloads& stream : payloads) {
    for (const std::vector<uint8_t>& payload : stream) {
      data.append(payload);
      data.u32(block_check(payload, writer.plan_.id));
    }
    stream.clear();
  }
  writer.data_ = data.release();
  return writer;
}

Result<std::vector<uint8_t>> PackWriter::finish(std::string json) const {
  json.resize(padded(json.size()), ' ');
  Directory directory{plan_.id, 0, 0, plan_.streams};
  const size_t chunk_length = padded(directory.byte_length() + data_.size());
  const uint64_t bin_length = bin_.empty() ? 0 : chunk_header_bytes + bin_.size();
  const uint64_t opening =
      uint64_t(glb_header_bytes) + chunk_header_bytes + json.size() + bin_length + chunk_header_bytes;
  if (opening + chunk_length > max_file_bytes)
    return fail(ErrorKind::limit, "pack", "exceeds the 4 GiB of a binary glTF");

  ByteWriter file;
  file.u32(glb_magic);
  file.u32(2);
  file.u32(static_cast<uint32_t>(opening + chunk_length));
  append_chunk_header(file, json.size(), glb_json_chunk);
  file.append(as_bytes(json));
  if (!bin_.empty()) {
    append_chunk_header(file, bin_.size(), glb_bin_chunk);
    file.append(bin_);
  }
  append_chunk_header(file, chunk_length, chunk_lwst);
  directory.opening_length = static_cast<uint32_t>(opening);
  directory.opening_check = crc32c(file.bytes());
  file.append(directory.write());
  file.append(data_);
  file.align(4);
  return file.release();
}

}  // namespace lightwell
