// SPDX-License-Identifier: Apache-2.0
//
// Reads any bytes as a pack: opening, directory, tables, every block. Checksums would reject nearly every input, so the
// directory is also read with its checksum corrected.
#include <vector>

#include "lightwell/base/crc32c.h"
#include "lightwell/pack/reader.h"
#include "lightwell/pack/self_contained.h"

using namespace lightwell;

namespace {

void read_pack(Bytes file) {
  const FetchBytes fetch = [file](uint64_t first, uint64_t length) -> Result<std::vector<uint8_t>> {
    if (first > file.size() || length > file.size() - first) return fail("input", "is too short");
    const Bytes part = file.subspan(static_cast<size_t>(first), static_cast<size_t>(length));
    return std::vector<uint8_t>(part.begin(), part.end());
  };
  const auto reader = PackReader::open(fetch, file.size());
  if (reader) (void)reader->verify_id();
}

void read_directory(Bytes bytes) {
  if (bytes.size() < 8) return;
  ByteWriter directory;
  directory.u32(static_cast<uint32_t>(bytes.size()) + block_check_bytes);
  directory.u32(format_version);
  directory.append(bytes.subspan(8));
  directory.u32(crc32c(directory.bytes()));
  for (const uint64_t file_length : {uint64_t(1000), uint64_t(0xffffffff)})
    (void)Directory::read(directory.bytes(), file_length);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const Bytes bytes(data, size);
  read_pack(bytes);
  read_directory(bytes);
  (void)check_self_contained({reinterpret_cast<const char*>(data), size});
  return 0;
}
