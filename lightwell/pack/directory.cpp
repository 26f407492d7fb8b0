// SPDX-License-Identifier: Apache-2.0
#include "lightwell/pack/directory.h"

#include <algorithm>
#include <cmath>

#include "lightwell/base/assert.h"
#include "lightwell/base/crc32c.h"
#include "lightwell/pack/block_table.h"

namespace lightwell {
namespace {

constexpr uint32_t head_bytes = 4 + 4 + 16 + 4 + 4 + 4;
constexpr uint32_t stream_head_bytes = 4 + 4 + 4 + 4 + 4 + 4;

std::string name_of(size_t stream) { return "stream " + std::to_string(stream); }

Result<StreamEntry> read_stream(ByteReader& reader, size_t index) {
  StreamEntry entry;
  const uint8_t kind = reader.u8();
  entry.codec = reader.u8();
  const uint16_t reserved = reader.u16();
  entry.first = reader.u32();
  entry.length = reader.u32();
  entry.blocks = reader.u32();
  entry.error = reader.f32();
  const uint32_t parameters = reader.u32();
  if (kind >= stream_kinds)
    return fail(ErrorKind::unsupported, name_of(index), "is of unknown kind " + std::to_string(kind));
  entry.kind = static_cast<StreamKind>(kind);
  if (reserved != 0) return fail(name_of(index), "its reserved field is not zero");
  if (entry.blocks > max_stream_blocks) return fail(ErrorKind::limit, name_of(index), "has too many blocks");
  if (!(entry.error >= 0 && std::isfinite(entry.error)))
    return fail(name_of(index), "its error is negative or no number");
  if (parameters > max_parameter_bytes) return fail(ErrorKind::limit, name_of(index), "its parameters are too long");
  const Bytes bytes = reader.take(parameters);
  entry.parameters.assign(bytes.begin(), bytes.end());
  const uint32_t count = std::min(entry.blocks, rows_per_page);
  entry.rows = read_rows(reader, count);
  if (entry.rows.size() != count) return fail(name_of(index), "its block table is damaged");
  if (!BlockTable::place(entry, 0)) return fail(name_of(index), "its first blocks are longer than the stream");
  return entry;
}

}  // namespace

std::string to_text(const PackId& id) {
  std::string text;
  for (const uint8_t byte : id) {
    text += "0123456789abcdef"[byte >> 4];
    text += "0123456789abcdef"[byte & 15];
  }
  return text;
}

const char* to_text(StreamKind kind) {
  switch (kind) {
    case StreamKind::light: return "light";
    case StreamKind::mesh: return "mesh";
    case StreamKind::texture: return "texture";
    case StreamKind::bricks: return "bricks";
    case StreamKind::parts: return "parts";
  }
  LW_ASSERT(false);
}

uint32_t block_check(Bytes payload, const PackId& id) { return crc32c(payload, crc32c(id)); }

Bytes checked_payload(Bytes block, const PackId& id) {
  if (block.size() <= block_check_bytes) return {};
  const Bytes payload = block.first(block.size() - block_check_bytes);
  ByteReader check(block.last(block_check_bytes));
  return check.u32() == block_check(payload, id) ? payload : Bytes{};
}

size_t Directory::byte_length() const {
  size_t length = head_bytes + block_check_bytes;
  for (const StreamEntry& entry : streams)
    length += stream_head_bytes + entry.parameters.size() + row_bytes * entry.rows.size();
  return length;
}

std::vector<uint8_t> Directory::write() const {
  ByteWriter writer;
  writer.u32(static_cast<uint32_t>(byte_length()));
  writer.u32(format_version);
  writer.append(id);
  writer.u32(opening_length);
  writer.u32(opening_check);
  writer.u32(static_cast<uint32_t>(streams.size()));
  writer.append(write_streams());
  writer.u32(crc32c(writer.bytes()));
  return writer.release();
}

std::vector<uint8_t> Directory::write_streams() const {
  ByteWriter writer;
  for (const StreamEntry& entry : streams) {
    writer.u8(static_cast<uint8_t>(entry.kind));
    writer.u8(entry.codec);
    writer.u16(0);
    writer.u32(entry.first);
    writer.u32(entry.length);
    writer.u32(entry.blocks);
    writer.f32(entry.error);
    writer.u32(static_cast<uint32_t>(entry.parameters.size()));
    writer.append(entry.parameters);
    write_rows(writer, entry.rows);
  }
  return writer.release();
}

Result<Directory> Directory::read(Bytes bytes, uint64_t file_length) {
  ByteReader reader(bytes);
  const uint32_t length = reader.u32();
  const uint32_t version = reader.u32();
  if (!reader.ok()) return fail("directory", "is cut short");
  if (version != format_version)
    return fail(ErrorKind::unsupported, "directory",
                "has format version " + std::to_string(version) + "; this program reads version " +
                    std::to_string(format_version));
  if (length != bytes.size() || length < head_bytes + block_check_bytes)
    return fail("directory", "its length is wrong");
  const Bytes checked = bytes.first(bytes.size() - block_check_bytes);
  if (ByteReader(bytes.last(block_check_bytes)).u32() != crc32c(checked))
    return fail("directory", "its check is wrong");

  Directory directory;
  reader = ByteReader(checked);
  reader.take(8);
  std::ranges::copy(reader.take(16), directory.id.begin());
  directory.opening_length = reader.u32();
  directory.opening_check = reader.u32();
  const uint32_t count = reader.u32();
  if (count > max_streams || count > reader.remaining() / stream_head_bytes)
    return fail(ErrorKind::limit, "directory", "has too many streams");
  uint64_t expected = length;
  for (uint32_t i = 0; i < count; i++) {
    const uint64_t place = directory.opening_length + reader.position();
    auto entry = read_stream(reader, i);
    if (entry && entry->first != expected) entry = fail(name_of(i), "does not begin where the one before it ends");
    if (!entry) return fail(at_byte(std::move(entry.error()), place));
    expected += entry->length;
    directory.streams.push_back(std::move(*entry));
  }
  if (!reader.ok() || reader.remaining() != 0) return fail("directory", "its length is wrong");
  if (directory.opening_length + expected + 3 < file_length || directory.opening_length + expected > file_length)
    return fail("directory", "its streams do not fill the file");
  return directory;
}

}  // namespace lightwell
