// SPDX-License-Identifier: Apache-2.0
#include "lightwell/pack/reader.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <memory>
#include <system_error>

#include "lightwell/base/crc32c.h"
#include "lightwell/pack/content_hash.h"
#include "lightwell/pack/opening.h"

namespace lightwell {
namespace {

std::string name_of(size_t stream, const Extent& extent) {
  return "stream " + std::to_string(stream) + ", " + (extent.page ? "table page at block " : "block ") +
         std::to_string(extent.block);
}

/// Reads the opening and the directory, as far as the headers say.
Result<std::vector<uint8_t>> read_head(const FetchBytes& fetch, uint64_t file_length, OpeningSize& size) {
  std::vector<uint8_t> head;
  for (;;) {
    LW_TRY(measured, measure_opening(head));
    size = measured;
    if (size.file_length > file_length) return fail({"", "file", "is cut short", ErrorKind::bad_input, file_length});
    if (size.complete && head.size() >= size.needed) break;
    const uint64_t end = std::min(size.needed, file_length);
    if (end == head.size()) return fail({"", "file", "is cut short", ErrorKind::bad_input, file_length});
    LW_TRY(more, fetch(head.size(), end - head.size()));
    head.insert(head.end(), more.begin(), more.end());
  }
  if (size.file_length != file_length) return fail("file", "is longer than its header says");
  return head;
}

// A file open for reading. Reads are positional, so that threads can share it.
class OpenFile {
 public:
  explicit OpenFile(const std::string& path) : descriptor_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {}
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  ~OpenFile() {
    if (is_open()) ::close(descriptor_);
  }

  bool is_open() const { return descriptor_ >= 0; }

  Result<std::vector<uint8_t>> read(uint64_t first, uint64_t count) const {
    std::vector<uint8_t> bytes(count);
    for (size_t done = 0; done < bytes.size();) {
      const ssize_t got =
          ::pread(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(first + done));
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) return fail({"", std::to_string(count) + " bytes", "cannot be read", ErrorKind::io, first});
      done += static_cast<size_t>(got);
    }
    return bytes;
  }

 private:
  int descriptor_;
};

struct FileBytes {
  FetchBytes fetch;
  uint64_t length = 0;
};

Result<FileBytes> open_bytes(const std::string& path) {
  std::error_code missing;
  if (std::filesystem::is_directory(path, missing)) return fail({path, "", "is a folder", ErrorKind::io});
  const uint64_t length = std::filesystem::file_size(path, missing);
  if (missing) return fail({path, "", missing.message(), ErrorKind::io});
  const auto file = std::make_shared<const OpenFile>(path);
  if (!file->is_open()) return fail({path, "", std::generic_category().message(errno), ErrorKind::io});
  return FileBytes{[file](uint64_t first, uint64_t count) { return file->read(first, count); }, length};
}

}  // namespace

Result<PackReader> PackReader::open(FetchBytes fetch, uint64_t file_length) {
  if (file_length == 0) return fail("", "is empty");
  OpeningSize size;
  LW_TRY(head, read_head(fetch, file_length, size));
  const Bytes opening = Bytes(head).first(size.opening_length);
  LW_TRY(directory, Directory::read(Bytes(head).subspan(opening.size()), file_length));
  if (directory.opening_length != opening.size())
    return fail({"", "directory", "its length of the opening is wrong", ErrorKind::bad_input, opening.size()});
  if (directory.opening_check != crc32c(opening)) return fail("opening", "its check is wrong");

  PackReader reader;
  reader.fetch_ = std::move(fetch);
  reader.opening_ = opening_as_glb(opening);
  for (const StreamEntry& entry : directory.streams)
    reader.tables_.push_back(*BlockTable::place(entry, opening.size()));
  reader.directory_ = std::move(directory);
  for (size_t stream = 0; stream < reader.tables_.size(); stream++) {
    BlockTable& table = reader.tables_[stream];
    while (table.known() < table.extents()) {
      LW_TRY(page, reader.payload(stream, table.known() - 1));
      if (auto added = table.add_page(page); !added)
        return fail(in_element(added.error(), "stream " + std::to_string(stream)));
    }
  }
  return reader;
}

Result<PackReader> PackReader::open_file(const std::string& path) {
  LW_TRY(file, open_bytes(path));
  auto reader = open(std::move(file.fetch), file.length);
  if (!reader) return fail(in_file(reader.error(), path));
  return reader;
}

// Reads only the headers, since a folder may hold many packs with large openings.
bool is_pack(const FetchBytes& fetch) {
  const auto header = fetch(0, glb_header_bytes);
  if (!header || ByteReader(*header).u32() != glb_magic) return false;
  uint64_t at = glb_header_bytes;
  for (const uint32_t expected : {glb_json_chunk, glb_bin_chunk, chunk_lwst}) {
    const auto chunk = fetch(at, chunk_header_bytes);
    if (!chunk) return false;
    ByteReader reader(*chunk);
    const uint32_t length = reader.u32(), type = reader.u32();
    if (type == chunk_lwst) return at > glb_header_bytes;
    if (type != expected) return false;
    at += chunk_header_bytes + length;
  }
  return false;
}

bool is_pack_file(const std::string& path) {
  const auto file = open_bytes(path);
  return file && is_pack(file->fetch);
}

Result<std::vector<uint8_t>> PackReader::block(size_t stream, uint32_t index) const {
  return payload(stream, index + index / rows_per_page);
}

Result<std::vector<uint8_t>> PackReader::payload(size_t stream, uint32_t index) const {
  const Extent extent = tables_[stream].extent(index);
  LW_TRY(bytes, fetch_(extent.begin, extent.length));
  if (checked_payload(bytes, directory_.id).empty())
    return fail({"", name_of(stream, extent), "its check is wrong", ErrorKind::bad_input, extent.begin});
  bytes.resize(bytes.size() - block_check_bytes);
  return std::move(bytes);
}

Result<void> PackReader::verify_id() const {
  ContentHash hash;
  hash.update(glb_chunks(opening_).bin);
  hash.update(directory_.write_streams());
  for (size_t stream = 0; stream < tables_.size(); stream++) {
    for (uint32_t i = 0; i < tables_[stream].extents(); i++) {
      LW_TRY(bytes, payload(stream, i));
      hash.update(bytes);
    }
  }
  if (hash.finish() != directory_.id)
    return fail("id", "is " + to_text(directory_.id) + ", but the content's is " + to_text(hash.finish()));
  return {};
}

}  // namespace lightwell
