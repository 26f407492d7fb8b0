// SPDX-License-Identifier: Apache-2.0
#include "lightwell/client/download.h"

#include <algorithm>

#include "lightwell/base/assert.h"
#include "lightwell/base/crc32c.h"

namespace lightwell {
namespace {

constexpr uint64_t first_request_bytes = 65536;
constexpr size_t witness_bytes = 4 + 4 + 16;  // the directory's length, version and id

/// Removes and returns the first n bytes, or all if there are fewer, and moves the cursor past them.
Bytes cut(Cursor& cursor, Bytes& bytes, uint64_t n) {
  const Bytes front = bytes.first(static_cast<size_t>(std::min<uint64_t>(n, bytes.size())));
  bytes = bytes.subspan(front.size());
  cursor.position += front.size();
  return front;
}

}  // namespace

Result<uint64_t> Download::receive(Cursor& cursor, Bytes bytes) {
  uint64_t gained = 0;
  while (!bytes.empty()) {
    if (!opened()) {
      LW_TRY(head, receive_head(cursor, bytes));
      gained += head;
    } else if (cursor.position < directory_->opening_length + witness_.size()) {
      gained += read_witness(cursor, bytes);
    } else if (const std::optional<size_t> stream = stream_at(cursor.position)) {
      LW_TRY(extent, receive_extent(*stream, cursor, bytes));
      gained += extent;
    } else {
      const bool before = !streams_.empty() && cursor.position < streams_.front().table.begin();
      cut(cursor, bytes, before ? streams_.front().table.begin() - cursor.position : bytes.size());
    }
  }
  return gained;
}

std::pair<uint64_t, uint64_t> Download::wanted_head() const {
  if (head_.empty()) return {0, first_request_bytes};
  const uint64_t end = size_.needed + (size_.complete ? 0 : first_request_bytes);
  const bool length_known = size_.file_length != 0;
  return {head_.size(), length_known ? std::min(end, size_.file_length) : end};
}

/// Appends bytes to the head (opening and directory) up to the end that its headers state; those behind it are left for
/// the streams. A damaged head is read once more before it is an error.
Result<uint64_t> Download::receive_head(Cursor& cursor, Bytes& bytes) {
  if (cursor.position > head_.size()) {
    cut(cursor, bytes, bytes.size());
    return 0;
  }
  cut(cursor, bytes, head_.size() - cursor.position);
  uint64_t gained = 0;
  Result<void> opened_now;
  for (;;) {
    auto measured = measure_opening(head_);
    if (!measured) {
      opened_now = lightwell::fail(measured.error());
      break;
    }
    size_ = *measured;
    if (size_.complete && head_.size() == size_.needed) {
      opened_now = open();
      break;
    }
    if (bytes.empty()) return gained;
    const Bytes front = cut(cursor, bytes, size_.needed - head_.size());
    head_.insert(head_.end(), front.begin(), front.end());
    gained += front.size();
  }
  if (opened_now) return gained;
  if (head_failed_) return lightwell::fail(opened_now.error());
  head_failed_ = true;
  head_.clear();
  size_ = {};
  return 0;
}

void Download::forget_damage() {
  strikes_.clear();
  suspicious_ = replaced_ = false;
  another_.clear();
  if (opened()) return;
  head_.clear();
  size_ = {};
  head_failed_ = false;
}

Result<void> Download::open() {
  const Bytes opening = Bytes(head_).first(static_cast<size_t>(size_.opening_length));
  const Bytes directory = Bytes(head_).subspan(opening.size());
  LW_TRY(read, Directory::read(directory, size_.file_length));
  if (read.opening_length != opening.size()) return lightwell::fail("directory", "its length of the opening is wrong");
  if (read.opening_check != crc32c(opening)) return lightwell::fail("opening", "its check is wrong");
  opening_ = opening_as_glb(opening);
  const Bytes witness = directory.first(witness_bytes);
  witness_.assign(witness.begin(), witness.end());
  for (const StreamEntry& entry : read.streams) {
    BlockTable table = *BlockTable::place(entry, opening.size());
    std::vector<uint8_t> here(table.known());
    streams_.push_back({std::move(table), std::move(here), {}, 0, 0});
  }
  directory_ = std::move(read);
  head_ = {};
  return {};
}

std::pair<uint64_t, uint64_t> Download::wanted_witness() const {
  return {directory_->opening_length, directory_->opening_length + witness_.size()};
}

/// Reads the start of the directory again. When the same different bytes arrive twice, they are no transmission error:
/// the file was replaced.
uint64_t Download::read_witness(Cursor& cursor, Bytes& bytes) {
  const uint64_t begin = directory_->opening_length;
  if (cursor.position < begin) cut(cursor, bytes, begin - cursor.position);
  if (bytes.empty()) return 0;
  const size_t offset = static_cast<size_t>(cursor.position - begin);
  const Bytes front = cut(cursor, bytes, witness_.size() - offset);
  if (offset == 0) read_again_.clear();
  if (offset != read_again_.size()) return 0;
  read_again_.insert(read_again_.end(), front.begin(), front.end());
  if (read_again_.size() < witness_.size()) return 0;
  const bool asked_for = suspicious_;
  if (read_again_ == witness_) {
    suspicious_ = false;
  } else {
    replaced_ = read_again_ == another_;
    another_ = std::exchange(read_again_, {});
  }
  return asked_for ? witness_.size() : 0;  // a whole file that comes again brings it, too
}

std::optional<size_t> Download::stream_at(uint64_t position) const {
  const auto behind =
      std::ranges::upper_bound(streams_, position, {}, [](const Stream& stream) { return stream.table.begin(); });
  if (behind == streams_.begin()) return std::nullopt;
  const auto found = behind - 1;
  if (position >= found->table.end()) return std::nullopt;
  return static_cast<size_t>(found - streams_.begin());
}

/// Adds bytes to the extent at the cursor. Bytes of extents that are not known yet, or have arrived already, are
/// skipped.
Result<uint64_t> Download::receive_extent(size_t index, Cursor& cursor, Bytes& bytes) {
  const Stream& stream = streams_[index];
  const std::optional<uint32_t> number = stream.table.at(cursor.position);
  if (!number) {
    cursor.partial.clear();
    cut(cursor, bytes, stream.table.end() - cursor.position);
    return 0;
  }
  const Extent extent = stream.table.extent(*number);
  const bool joined = cursor.position == extent.begin + cursor.partial.size();
  const uint64_t rest = extent.end() - cursor.position;
  if (stream.here[*number] || !joined) {
    cursor.partial.clear();
    cut(cursor, bytes, rest);
    return 0;
  }
  const Bytes front = cut(cursor, bytes, rest);
  if (front.size() == extent.length) return accept(index, *number, front);
  cursor.partial.insert(cursor.partial.end(), front.begin(), front.end());
  if (cursor.partial.size() < extent.length) return 0;
  const std::vector<uint8_t> whole = std::exchange(cursor.partial, {});
  return accept(index, *number, whole);
}

/// Checks a whole extent and keeps its payload.
Result<uint64_t> Download::accept(size_t index, uint32_t number, Bytes bytes) {
  Stream& stream = streams_[index];
  const Extent extent = stream.table.extent(number);
  const Bytes payload = checked_payload(bytes, directory_->id);
  if (payload.empty()) {
    LW_CHECK(strike(index, extent));
    return 0;
  }
  if (extent.page) {
    if (auto added = stream.table.add_page(payload); !added)
      return lightwell::fail(in_element(std::move(added.error()), "stream " + std::to_string(index)));
    stream.here.resize(stream.table.known());
  } else {
    stream.ready.emplace(extent.block, std::vector<uint8_t>(payload.begin(), payload.end()));
    backlog_ += payload.size();
  }
  stream.here[number] = 1;
  stream.received += extent.length;
  return extent.length;
}

Result<void> Download::strike(size_t index, const Extent& extent) {
  suspicious_ = true;
  const uint32_t number = *streams_[index].table.at(extent.begin);
  if (++strikes_[{index, number}] < 2) return {};
  return lightwell::fail("stream " + std::to_string(index) + (extent.page ? ", table page at block " : ", block ") +
                             std::to_string(extent.block),
                         "its check failed twice: the file is damaged, or was replaced");
}

bool Download::ready(size_t stream) const {
  const Stream& state = streams_[stream];
  return !state.ready.empty() && state.ready.begin()->first == state.next;
}

std::vector<uint8_t> Download::take(size_t stream) {
  LW_ASSERT(ready(stream));
  Stream& state = streams_[stream];
  std::vector<uint8_t> payload = std::move(state.ready.begin()->second);
  state.ready.erase(state.ready.begin());
  state.next++;
  backlog_ -= payload.size();
  return payload;
}

}  // namespace lightwell
