// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "lightwell/base/bytes.h"
#include "lightwell/base/result.h"

namespace lightwell {

// All functions may be called from any thread. Their errors name the file.

/// Reads a whole file; gzipped content (recognised by its first bytes) is inflated when `inflate` is set. More than
/// `limit` bytes, read or inflated, are an error, as is content of more than 16 MiB that inflates to more than 200
/// times the file, so that a small hostile file cannot exhaust memory.
Result<std::vector<uint8_t>> read_file(const std::filesystem::path& path, bool inflate = false,
                                       size_t limit = size_t(4) << 30);

/// Writes a file completely or not at all: to a temporary file in the same folder, which is then renamed over it. What
/// a killed process has left of such a file is removed. A symbolic link stays and its target is replaced; a device or a
/// pipe is written to directly. "-" is stdout.
Result<void> write_file(const std::filesystem::path& path, Bytes bytes);

/// The same for content made piece by piece: `fill` gets a function that appends bytes and returns whether that
/// succeeded.
Result<void> write_file(const std::filesystem::path& path,
                        const std::function<Result<void>(const std::function<bool(Bytes)>&)>& fill);

/// Fails if write_file would fail now. Called before the work that makes the content.
Result<void> check_writable(const std::filesystem::path& path);

}  // namespace lightwell
