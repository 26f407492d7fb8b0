// SPDX-License-Identifier: Apache-2.0
#include "lightwell/base/gzip.h"

#include <zlib.h>

#include <memory>

#include "lightwell/base/assert.h"

namespace lightwell {
namespace {

constexpr int gzip_window = 15 + 16, memory_level = 8;

}  // namespace

std::vector<uint8_t> gzip(Bytes bytes, bool compressed) {
  z_stream stream{};
  const int level = compressed ? Z_DEFAULT_COMPRESSION : Z_NO_COMPRESSION;
  int status = deflateInit2(&stream, level, Z_DEFLATED, gzip_window, memory_level, Z_DEFAULT_STRATEGY);
  LW_ASSERT(status == Z_OK);
  std::vector<uint8_t> packed(deflateBound(&stream, static_cast<uLong>(bytes.size())));
  stream.next_in = const_cast<Bytef*>(bytes.data());
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = packed.data();
  stream.avail_out = static_cast<uInt>(packed.size());
  status = deflate(&stream, Z_FINISH);
  LW_ASSERT(status == Z_STREAM_END);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

Result<std::vector<uint8_t>> gunzip(Bytes packed, size_t limit) {
  z_stream stream{};
  if (inflateInit2(&stream, gzip_window) != Z_OK) return fail(ErrorKind::limit, "gzip", "out of memory");
  std::unique_ptr<z_stream, int (*)(z_stream*)> end(&stream, inflateEnd);
  std::vector<uint8_t> bytes;
  std::vector<uint8_t> chunk(size_t(1) << 20);
  size_t at = 0;
  for (bool more = true; more;) {
    if (stream.avail_in == 0 && at < packed.size()) {
      const size_t now = std::min<size_t>(packed.size() - at, size_t(1) << 30);
      stream.next_in = const_cast<Bytef*>(packed.data() + at);
      stream.avail_in = static_cast<uInt>(now);
      at += now;
    }
    stream.next_out = chunk.data();
    stream.avail_out = static_cast<uInt>(chunk.size());
    const int status = inflate(&stream, Z_NO_FLUSH);
    if (status != Z_OK && status != Z_STREAM_END)
      return fail("gzip", status == Z_BUF_ERROR ? "the file ends too early" : "damaged data");
    const size_t produced = chunk.size() - stream.avail_out;
    if (bytes.size() + produced > limit)
      return fail(ErrorKind::limit, "gzip", "inflates to more than " + std::to_string(limit) + " bytes");
    bytes.insert(bytes.end(), chunk.begin(), chunk.begin() + static_cast<ptrdiff_t>(produced));
    if (status != Z_STREAM_END) continue;
    more = stream.avail_in > 0 || at < packed.size();
    inflateReset(&stream);
  }
  return bytes;
}

}  // namespace lightwell
