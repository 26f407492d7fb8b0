// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/node_journal.h"

#include "lightwell/base/bytes.h"
#include "lightwell/base/file.h"
#include "lightwell/base/fingerprint.h"

namespace lightwell {
namespace {

// A record is the key, the moments, the other numbers, and a checksum of all these.
constexpr size_t record_bytes = 8 + 27 * 4 + 4 + 4 + 4 + 4;
constexpr size_t largest_file = size_t(1) << 30;
/// Records that a crash may lose.
constexpr size_t records_at_a_time = 64;

uint32_t checksum(Bytes bytes) { return static_cast<uint32_t>(fingerprint(bytes)); }

std::vector<uint8_t> write_record(uint64_t key, const NodeSurroundings& found) {
  ByteWriter writer;
  writer.u64(key);
  for (const Vec3f& moment : found.moments.m)
    for (const float value : moment.e) writer.f32(value);
  writer.f32(found.insides);
  writer.f32(found.noise);
  writer.u32(found.rays);
  writer.u32(checksum(writer.bytes()));
  return writer.release();
}

/// Nothing when the checksum is wrong.
std::optional<std::pair<uint64_t, NodeSurroundings>> read_record(Bytes record) {
  ByteReader reader(record);
  NodeSurroundings found;
  const uint64_t key = reader.u64();
  for (Vec3f& moment : found.moments.m)
    for (float& value : moment.e) value = reader.f32();
  found.insides = reader.f32();
  found.noise = reader.f32();
  found.rays = reader.u32();
  if (reader.u32() != checksum(record.first(record_bytes - 4))) return std::nullopt;
  return std::pair(key, found);
}

}  // namespace

uint64_t NodeJournal::key(uint64_t inputs, const Vec3f& node, const Vec3f& cell) {
  ByteWriter place;
  for (const float value : node.e) place.f32(value);
  for (const float value : cell.e) place.f32(value);
  return fingerprint(place.bytes(), inputs);
}

Result<std::unique_ptr<NodeJournal>> NodeJournal::open(const std::filesystem::path& path) {
  std::unique_ptr<NodeJournal> journal(new NodeJournal);
  std::error_code unknown;
  size_t whole = 0;
  if (std::filesystem::exists(path, unknown)) {
    LW_TRY(bytes, read_file(path, false, largest_file));
    for (; whole + record_bytes <= bytes.size(); whole += record_bytes) {
      const auto record = read_record(Bytes(bytes).subspan(whole, record_bytes));
      if (!record) break;
      journal->known_.insert(*record);
    }
    std::filesystem::resize_file(path, whole, unknown);
    if (unknown) return fail(path.string(), "cannot be written: " + unknown.message());
  }
  journal->file_.open(path, std::ios::binary | std::ios::app);
  if (!journal->file_) return fail(path.string(), "cannot be written");
  return journal;
}

std::optional<NodeSurroundings> NodeJournal::find(uint64_t key) const {
  const std::lock_guard lock(mutex_);
  const auto found = known_.find(key);
  return found == known_.end() ? std::nullopt : std::optional(found->second);
}

void NodeJournal::add(uint64_t key, const NodeSurroundings& found) {
  const std::vector<uint8_t> record = write_record(key, found);
  const std::lock_guard lock(mutex_);
  known_.emplace(key, found);
  file_.write(reinterpret_cast<const char*>(record.data()), static_cast<std::streamsize>(record.size()));
  if (++unwritten_ < records_at_a_time) return;
  file_.flush();
  unwritten_ = 0;
}

size_t NodeJournal::size() const {
  const std::lock_guard lock(mutex_);
  return known_.size();
}

}  // namespace lightwell
