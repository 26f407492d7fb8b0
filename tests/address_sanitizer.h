// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace lightwell {

/// The address sanitizer keeps freed memory and some around each piece, and takes its time for both: limits of memory
/// and time are so many times as wide where a test is built with it.
#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define LIGHTWELL_ADDRESS_SANITIZER
#endif
#endif
#ifdef LIGHTWELL_ADDRESS_SANITIZER
inline constexpr int with_sanitizer = 4;
#else
inline constexpr int with_sanitizer = 1;
#endif

}  // namespace lightwell
