// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "lightwell/base/result.h"

namespace lightwell {

/// The bytes that a URI in a document refers to: a data URI, or a percent-encoded relative path to a file below
/// `folder`. Fails for other schemes, absolute paths, ".." and links that lead out of the folder. The caller adds the
/// element to the error.
Result<std::vector<uint8_t>> read_uri(const std::string& uri, const std::filesystem::path& folder);

/// Undoes percent-encoding. A % that does not begin a code is kept.
std::string decode_percent(std::string_view text);

}  // namespace lightwell
