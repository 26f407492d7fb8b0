// SPDX-License-Identifier: Apache-2.0
#include "lightwell/base/file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <memory>
#include <random>
#include <system_error>

#include "lightwell/base/gzip.h"

namespace lightwell {
namespace fs = std::filesystem;
namespace {

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Close>;

// Of a gzip file: what texts reach, and what any small file may inflate to.
constexpr size_t most_inflation = 200;
constexpr size_t free_inflation = size_t(1) << 24;

std::string reason(int code) { return std::generic_category().message(code); }

Result<void> write_all(std::FILE* file, const std::function<Result<void>(const std::function<bool(Bytes)>&)>& fill) {
  LW_CHECK(fill([&](Bytes bytes) { return std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size(); }));
  if (std::fflush(file) != 0 || std::ferror(file)) return fail(ErrorKind::io, "", reason(errno));
  return {};
}

Error not_writable(const fs::path& path, const std::string& why) {
  return {path.string(), "", "cannot be written: " + why, ErrorKind::io};
}

// Resolves the symbolic links of a path. The last one may point to a file that does not exist yet.
Result<fs::path> behind_links(const fs::path& path) {
  constexpr int most_links = 40;  // as many as Linux follows
  fs::path at = path;
  std::error_code code;
  for (int links = 0; fs::is_symlink(fs::symlink_status(at, code)); links++) {
    if (links == most_links) return fail(not_writable(path, reason(ELOOP)));
    const fs::path target = fs::read_symlink(at, code);
    if (code) return fail(not_writable(path, code.message()));
    at = at.parent_path() / target;
  }
  return at;
}

// Whether a write replaces the file: true for a regular or new file, false for a device or a pipe.
Result<bool> is_replaced(const fs::path& path) {
  std::error_code unknown;
  const auto kind = fs::status(path, unknown).type();
  if (kind == fs::file_type::directory) return fail({path.string(), "", "is a folder", ErrorKind::io});
  return kind == fs::file_type::regular || kind == fs::file_type::not_found;
}

constexpr std::string_view temporary_ending = ".part";
constexpr size_t temporary_digits = 16;

// Whether `name` is one that a TemporaryFile beside the file `beside` has.
bool is_temporary(std::string_view name, std::string_view beside) {
  if (name.size() != beside.size() + 1 + temporary_digits + temporary_ending.size()) return false;
  const std::string_view digits = name.substr(beside.size() + 1, temporary_digits);
  return name.starts_with(beside) && name[beside.size()] == '.' && name.ends_with(temporary_ending) &&
         digits.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

// Locks a file for this process alone, until it is closed or the process ends. False when another one has it.
bool lock(int descriptor) { return ::flock(descriptor, LOCK_EX | LOCK_NB) == 0; }

// Removes the temporary files beside a file that a killed process has left: those that nobody has locked.
void remove_abandoned(const fs::path& beside) {
  std::error_code ignored;
  const fs::path folder = beside.parent_path();
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.empty() ? "." : folder, ignored)) {
    if (!is_temporary(entry.path().filename().string(), beside.filename().string())) continue;
    const int descriptor = ::open(entry.path().c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0) continue;
    if (lock(descriptor)) fs::remove(entry.path(), ignored);
    ::close(descriptor);
  }
}

// A temporary file beside another one, with an unpredictable name, so that nobody can have planted a link there.
// Removed on destruction unless it has replaced the other file. Locked while it is there.
class TemporaryFile {
 public:
  explicit TemporaryFile(const fs::path& beside) {
    constexpr int attempts = 8;  // a name is taken once in 2^64
    remove_abandoned(beside);
    std::random_device random;
    for (int i = 0; i < attempts; i++) {
      char digits[temporary_digits + 1];
      std::snprintf(digits, sizeof digits, "%08x%08x", random(), random());
      path_ = beside.string() + "." + digits + std::string(temporary_ending);
      const int descriptor = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
      made_ = descriptor >= 0;
      failure_ = errno;
      if (made_) file_.reset(::fdopen(descriptor, "wb"));
      if (made_ ? keep(descriptor) : failure_ != EEXIST) break;
    }
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    std::error_code ignored;
    if (made_) fs::remove(path_, ignored);
  }

  // The errno of the failure when there is no file.
  int failure() const { return failure_; }
  std::FILE* file() const { return file_.get(); }

  // Closes the file and renames it over another.
  Result<void> replace(const fs::path& other) {
    std::error_code code;
    if (std::fclose(file_.release()) != 0) return fail(ErrorKind::io, "", reason(errno));
    fs::rename(path_, other, code);
    if (code) return fail(ErrorKind::io, "", code.message());
    made_ = false;
    return {};
  }

 private:
  // Locks the file, where files can be locked. False when another process took it for an abandoned one before that.
  bool keep(int descriptor) {
    struct stat status {};
    const bool taken = !lock(descriptor) && errno == EWOULDBLOCK;
    made_ = !taken && (::fstat(descriptor, &status) != 0 || status.st_nlink > 0);
    if (!made_) file_.reset();
    return made_;
  }

  fs::path path_;
  File file_;
  int failure_ = 0;
  bool made_ = false;
};

Result<void> replace_file(const fs::path& path,
                          const std::function<Result<void>(const std::function<bool(Bytes)>&)>& fill) {
  TemporaryFile temporary(path);
  if (!temporary.file()) return fail(ErrorKind::io, "", "cannot be written: " + reason(temporary.failure()));
  LW_CHECK(write_all(temporary.file(), fill));
  return temporary.replace(path);
}

}  // namespace

Result<std::vector<uint8_t>> read_file(const std::filesystem::path& path, bool inflate, size_t limit) {
  std::error_code code;
  if (std::filesystem::is_directory(path, code)) return fail({path.string(), "", "is a folder", ErrorKind::io});
  const File file(std::fopen(path.c_str(), "rbe"));
  if (!file) return fail({path.string(), "", reason(errno), ErrorKind::io});
  std::vector<uint8_t> bytes;
  for (size_t got = 1; got > 0;) {
    const size_t before = bytes.size();
    if (before > limit)
      return fail({path.string(), "", "is larger than " + std::to_string(limit) + " bytes", ErrorKind::limit});
    bytes.resize(std::max<size_t>(before * 2, size_t(1) << 16));
    got = std::fread(bytes.data() + before, 1, bytes.size() - before, file.get());
    bytes.resize(before + got);
  }
  if (std::ferror(file.get())) return fail({path.string(), "", "cannot be read", ErrorKind::io});
  if (!inflate || bytes.size() < 2 || bytes[0] != 0x1f || bytes[1] != 0x8b) return bytes;
  auto plain = gunzip(bytes, std::min(limit, free_inflation + most_inflation * bytes.size()));
  if (!plain) return fail(in_file(plain.error(), path.string()));
  return plain;
}

Result<void> write_file(const std::filesystem::path& path, Bytes bytes) {
  return write_file(path, [&](const std::function<bool(Bytes)>& append) -> Result<void> {
    if (!append(bytes)) return fail(ErrorKind::io, "", reason(errno));
    return {};
  });
}

Result<void> write_file(const std::filesystem::path& path,
                        const std::function<Result<void>(const std::function<bool(Bytes)>&)>& fill) {
  if (path == "-") {
    auto written = write_all(stdout, fill);
    if (!written) return fail(in_file(written.error(), "stdout"));
    return written;
  }
  LW_TRY(replaced, is_replaced(path));
  Result<void> written;
  if (replaced) {
    LW_TRY(file, behind_links(path));
    written = replace_file(file, fill);
  } else {
    const File device(std::fopen(path.c_str(), "wbe"));
    if (!device) return fail(not_writable(path, reason(errno)));
    written = write_all(device.get(), fill);
  }
  if (!written) return fail(in_file(written.error(), path.string()));
  return {};
}

Result<void> check_writable(const std::filesystem::path& path) {
  if (path == "-") return {};
  LW_TRY(replaced, is_replaced(path));
  if (!replaced) {
    if (access(path.c_str(), W_OK) != 0) return fail(not_writable(path, reason(errno)));
    return {};
  }
  LW_TRY(file, behind_links(path));
  const TemporaryFile temporary(file);
  if (!temporary.file()) return fail(not_writable(path, reason(temporary.failure())));
  return {};
}

}  // namespace lightwell
