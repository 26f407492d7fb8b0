// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace lightwell {

// What the lists in header fields of a request say.

/// Whether an If-None-Match names a strong entity tag: among others, as weak, or by "*" (RFC 9110, 13.1.2).
bool names_tag(std::string_view list, std::string_view etag);
/// The same for If-Match, where a weak tag is none (RFC 9110, 13.1.1).
bool names_strong_tag(std::string_view list, std::string_view etag);

/// Whether an Accept-Encoding allows gzip (RFC 9110, 12.5.3). An absent or empty one does not.
bool accepts_gzip(std::string_view list);

}  // namespace lightwell
