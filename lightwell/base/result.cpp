// SPDX-License-Identifier: Apache-2.0
#include "lightwell/base/result.h"

#include <algorithm>

namespace lightwell {

std::string Error::message() const {
  std::string text;
  for (const std::string* part : {&file, &element, &reason}) {
    if (part->empty()) continue;
    if (!text.empty()) text += ": ";
    text += *part;
  }
  return text;
}

Error in_file(Error error, const std::string& file) {
  if (error.file.empty()) error.file = file;
  return error;
}

void Report::warn(std::string text) {
  constexpr size_t most_warnings = 200;
  if (warnings.size() > most_warnings || std::find(warnings.begin(), warnings.end(), text) != warnings.end()) return;
  warnings.push_back(warnings.size() < most_warnings ? std::move(text) : "further warnings are left out");
}

}  // namespace lightwell
