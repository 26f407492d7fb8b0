// SPDX-License-Identifier: Apache-2.0
#include "lightwell/cli/input_file.h"

#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

namespace lightwell {
namespace {

tl::unexpected<Error> cannot(const std::string& what) {
  return fail(Error("stdin", "", what + std::strerror(errno), ErrorKind::io));
}

bool write_all(int descriptor, const char* bytes, size_t count) {
  while (count > 0) {
    const ssize_t written = ::write(descriptor, bytes, count);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes += written;
    count -= static_cast<size_t>(written);
  }
  return true;
}

}  // namespace

Result<StandardInput> StandardInput::read() {
  const int descriptor = memfd_create("stdin", MFD_CLOEXEC);
  if (descriptor < 0) return cannot("cannot be kept in memory: ");
  StandardInput input(descriptor);
  std::array<char, 1 << 16> piece;
  for (;;) {
    const ssize_t count = ::read(STDIN_FILENO, piece.data(), piece.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return cannot("cannot be read: ");
    if (count == 0) return input;
    if (!write_all(descriptor, piece.data(), static_cast<size_t>(count))) return cannot("cannot be kept in memory: ");
  }
}

StandardInput::~StandardInput() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::string StandardInput::path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

}  // namespace lightwell
