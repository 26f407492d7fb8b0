// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace lightwell {

// Numbers as text for people.

/// Four significant digits, "0.04361", or a whole number if it has more, "-2,387,122"; a number below 1e-6 is "0".
std::string short_number(double number);

/// "20,010"
std::string grouped(uint64_t count);

/// "9 blocks", "1 block"
std::string counted(uint64_t count, const std::string& noun);

/// "51.66 kB"; kilo-, mega- and gigabytes are powers of a thousand.
std::string size_text(uint64_t bytes);

}  // namespace lightwell
