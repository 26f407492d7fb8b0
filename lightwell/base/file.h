// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "lightwell/base/bytes.h"
#include "lightwell/base/result.h"

namespace lightwell {

// All functions may be called from any thread. Their errors name the file.

/// The content of a regular file; a gzipped one (recognised by its first bytes) is inflated when `inflate` is set. More
/// than `limit` bytes are an error, so that a small hostile file cannot exhaust memory.
Result<std::vector<uint8_t>> read_file(const std::filesystem::path& path, bool inflate = false,
                                       size_t limit = size_t(4) << 30);

/// Writes a file as a whole or not at all: into a temporary file in its folder that takes its place at the end. A link
/// stays, and the file that it leads to is replaced. "-" is stdout.
Result<void> write_file(const std::filesystem::path& path, Bytes bytes);

/// The same for content made piece by piece: `fill` gets a function that appends bytes (and says whether that worked).
Result<void> write_file(const std::filesystem::path& path,
                        const std::function<Result<void>(const std::function<bool(Bytes)>&)>& fill);

/// Fails when write_file would fail as things are now: to be asked before the work that makes the content.
Result<void> check_writable(const std::filesystem::path& path);

}  // namespace lightwell
