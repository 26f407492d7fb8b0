// SPDX-License-Identifier: Apache-2.0
#include "lightwell/pack/opening.h"

#include <algorithm>

#include "lightwell/base/assert.h"
#include "lightwell/pack/directory.h"

namespace lightwell {
namespace {

constexpr const char* no_pack = "is no pack; `lightwell bake` makes one";

}  // namespace

Result<OpeningSize> measure_opening(Bytes prefix) {
  OpeningSize size;
  size.needed = glb_header_bytes + chunk_header_bytes;
  ByteReader header(prefix);
  const uint32_t magic = header.u32();
  // Many a server answers with a page, and with the status 200, where it has no file.
  if (header.ok() && magic != glb_magic) return fail("", prefix[0] == '<' ? "is HTML or XML" : no_pack);
  if (prefix.size() < size.needed) return size;
  if (const uint32_t version = header.u32(); version != 2)
    return fail(ErrorKind::unsupported, "header", "is of glTF version " + std::to_string(version));
  size.file_length = header.u32();

  uint64_t at = glb_header_bytes;
  for (const uint32_t wanted : {glb_json_chunk, glb_bin_chunk, chunk_lwst}) {
    size.needed = at + chunk_header_bytes;
    if (size.needed > size.file_length) return fail("", no_pack);
    if (prefix.size() < size.needed) return size;
    ByteReader chunk(prefix.subspan(at));
    const uint32_t length = chunk.u32();
    const uint32_t type = chunk.u32();
    if (length > size.file_length - size.needed) return fail_at(at, "chunk", "reaches beyond the end of the file");
    if (type == glb_bin_chunk && wanted == chunk_lwst) return fail_at(at, "chunk", "BIN stands twice");
    if (type == chunk_lwst && wanted != glb_json_chunk) {
      if (size.needed + length != size.file_length) return fail_at(at, "LWST chunk", "does not end with the file");
      at = size.needed;
      break;
    }
    if (type != wanted) return fail("", no_pack);
    at = size.needed + length;
  }
  size.opening_length = at;
  size.needed = at + sizeof(uint32_t);
  if (prefix.size() < size.needed) return size;
  const uint32_t directory = ByteReader(prefix.subspan(at)).u32();
  if (directory > max_directory_bytes || directory > size.file_length - at || directory < sizeof(uint32_t))
    return fail_at(at, "directory", "its length is wrong");
  size.needed = at + directory;
  size.complete = true;
  return size;
}

std::vector<uint8_t> opening_as_glb(Bytes opening) {
  LW_ASSERT(opening.size() >= glb_header_bytes + 2 * chunk_header_bytes);
  const Bytes kept = opening.first(opening.size() - chunk_header_bytes);
  ByteWriter glb;
  glb.append(kept.first(8));
  glb.u32(static_cast<uint32_t>(kept.size()));
  glb.append(kept.subspan(glb_header_bytes));
  return glb.release();
}

GlbChunks glb_chunks(Bytes glb) {
  ByteReader reader(glb);
  reader.take(glb_header_bytes);
  const auto chunk = [&] {
    const uint32_t length = reader.u32();
    reader.u32();
    return reader.take(length);
  };
  GlbChunks chunks;
  chunks.json = chunk();
  if (reader.remaining() > 0) chunks.bin = chunk();
  LW_ASSERT(reader.ok());
  return chunks;
}

}  // namespace lightwell
