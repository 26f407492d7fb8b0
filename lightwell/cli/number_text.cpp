// SPDX-License-Identifier: Apache-2.0
#include "lightwell/cli/number_text.h"

#include <cmath>
#include <cstdio>

namespace lightwell {

std::string short_number(double number) {
  const double size = std::abs(number);
  // From 9999.5 on four digits round to 1e+04.
  if (size >= 9999.5 && size < 1e15)
    return std::string(number < 0 ? "-" : "").append(grouped(static_cast<uint64_t>(std::llround(size))));
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", size < 1e-6 ? 0 : number);
  return text;
}

std::string grouped(uint64_t count) {
  const std::string digits = std::to_string(count);
  std::string text;
  for (size_t i = 0; i < digits.size(); i++) {
    if (i > 0 && (digits.size() - i) % 3 == 0) text += ',';
    text += digits[i];
  }
  return text;
}

std::string counted(uint64_t count, const std::string& noun) {
  return grouped(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string size_text(uint64_t bytes) {
  const auto number = static_cast<double>(bytes);
  if (number >= 1e9) return short_number(number / 1e9) + " GB";
  if (number >= 1e6) return short_number(number / 1e6) + " MB";
  return number >= 1e3 ? short_number(number / 1e3) + " kB" : counted(bytes, "byte");
}

}  // namespace lightwell
