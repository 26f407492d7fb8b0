// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lightwell/base/result.h"

namespace lightwell {

/// The bytes that a URI of a document means: a data URI, or a file below `folder` by a relative path with
/// percent-encoding. Refused are schemes, absolute paths, "..", and links that lead out of the folder. The error's
/// element is left to the caller.
Result<std::vector<uint8_t>> read_uri(const std::string& uri, const std::filesystem::path& folder);

}  // namespace lightwell
