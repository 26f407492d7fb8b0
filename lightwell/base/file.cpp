// SPDX-License-Identifier: Apache-2.0
#include "lightwell/base/file.h"

#include <unistd.h>
#include <zlib.h>

#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>

namespace lightwell {
namespace {

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Close>;

std::string reason(int code) { return std::generic_category().message(code); }

// Inflates every member of the file, one behind the other (RFC 1952, 2.2).
Result<std::vector<uint8_t>> inflate_gzip(Bytes packed, size_t limit) {
  z_stream stream{};
  if (inflateInit2(&stream, 15 + 16) != Z_OK) return fail("gzip", "out of memory");
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
      return fail("gzip", "inflates to more than " + std::to_string(limit) + " bytes");
    bytes.insert(bytes.end(), chunk.begin(), chunk.begin() + static_cast<ptrdiff_t>(produced));
    if (status != Z_STREAM_END) continue;
    more = stream.avail_in > 0 || at < packed.size();
    inflateReset(&stream);
  }
  return bytes;
}

Result<void> write_all(std::FILE* file, const std::function<Result<void>(const std::function<bool(Bytes)>&)>& fill) {
  LW_CHECK(fill([&](Bytes bytes) { return std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size(); }));
  if (std::fflush(file) != 0 || std::ferror(file)) return fail("", reason(errno));
  return {};
}

// A regular file is replaced; a device or a pipe is written to.
Result<bool> is_replaced(const std::filesystem::path& path) {
  std::error_code unknown;
  const auto kind = std::filesystem::status(path, unknown).type();
  if (kind == std::filesystem::file_type::directory) return fail({path.string(), "", "is a folder"});
  return kind == std::filesystem::file_type::regular || kind == std::filesystem::file_type::not_found;
}

std::filesystem::path temporary_beside(const std::filesystem::path& path) {
  return path.string() + ".part" + std::to_string(getpid());
}

}  // namespace

Result<std::vector<uint8_t>> read_file(const std::filesystem::path& path, bool inflate, size_t limit) {
  std::error_code code;
  if (std::filesystem::is_directory(path, code)) return fail({path.string(), "", "is a folder"});
  const File file(std::fopen(path.c_str(), "rb"));
  if (!file) return fail({path.string(), "", reason(errno)});
  std::vector<uint8_t> bytes;
  for (size_t got = 1; got > 0;) {
    const size_t before = bytes.size();
    if (before > limit) return fail({path.string(), "", "is larger than " + std::to_string(limit) + " bytes"});
    bytes.resize(std::max<size_t>(before * 2, size_t(1) << 16));
    got = std::fread(bytes.data() + before, 1, bytes.size() - before, file.get());
    bytes.resize(before + got);
  }
  if (std::ferror(file.get())) return fail({path.string(), "", "cannot be read"});
  if (!inflate || bytes.size() < 2 || bytes[0] != 0x1f || bytes[1] != 0x8b) return bytes;
  auto plain = inflate_gzip(bytes, limit);
  if (!plain) return fail(in_file(plain.error(), path.string()));
  return plain;
}

Result<void> write_file(const std::filesystem::path& path, Bytes bytes) {
  return write_file(path, [&](const std::function<bool(Bytes)>& append) -> Result<void> {
    if (!append(bytes)) return fail("", reason(errno));
    return {};
  });
}

Result<void> write_file(const std::filesystem::path& path,
                        const std::function<Result<void>(const std::function<bool(Bytes)>&)>& fill) {
  if (path == "-") return write_all(stdout, fill);
  LW_TRY(replaced, is_replaced(path));
  if (!replaced) {
    const File device(std::fopen(path.c_str(), "wb"));
    if (!device) return fail({path.string(), "", "cannot be written: " + reason(errno)});
    auto outcome = write_all(device.get(), fill);
    return outcome ? outcome : Result<void>(fail(in_file(outcome.error(), path.string())));
  }
  const std::filesystem::path temporary = temporary_beside(path);
  Result<void> written;
  {
    const File file(std::fopen(temporary.c_str(), "wb"));
    if (!file) return fail({path.string(), "", "cannot be written: " + reason(errno)});
    written = write_all(file.get(), fill);
  }
  std::error_code code;
  if (written) {
    std::filesystem::rename(temporary, path, code);
    if (code) written = fail("", code.message());
  }
  if (!written) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    return fail(in_file(written.error(), path.string()));
  }
  return {};
}

Result<void> check_writable(const std::filesystem::path& path) {
  if (path == "-") return {};
  LW_TRY(replaced, is_replaced(path));
  if (!replaced) {
    if (access(path.c_str(), W_OK) != 0) return fail({path.string(), "", "cannot be written: " + reason(errno)});
    return {};
  }
  const std::filesystem::path temporary = temporary_beside(path);
  const bool opened = File(std::fopen(temporary.c_str(), "wb")) != nullptr;
  if (!opened) return fail({path.string(), "", "cannot be written: " + reason(errno)});
  std::error_code ignored;
  std::filesystem::remove(temporary, ignored);
  return {};
}

}  // namespace lightwell
