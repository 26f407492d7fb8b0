// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace lightwell {

// Texts of numbers, for people.

/// Four digits, "0.04361", or a whole number of more, "-2,387,122"; a number that rounds to zero has no sign.
std::string short_number(double number);

/// "20,010"
std::string grouped(uint64_t count);

/// "9 blocks", "1 block"
std::string counted(uint64_t count, const std::string& noun);

/// "51.66 kB"; kilo-, mega- and gigabytes are powers of a thousand.
std::string size_text(uint64_t bytes);

}  // namespace lightwell
