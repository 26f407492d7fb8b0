// SPDX-License-Identifier: Apache-2.0
#include "lightwell/base/result.h"

#include <algorithm>

namespace lightwell {

Error::Error(std::string in_which_file, std::string of_which_element, std::string why, ErrorKind which_kind,
             std::optional<uint64_t> where)
    : file(std::move(in_which_file)),
      element(std::move(of_which_element)),
      reason(std::move(why)),
      kind(which_kind),
      offset(where) {}
Error::Error(const Error&) = default;
Error::Error(Error&&) noexcept = default;
Error& Error::operator=(const Error&) = default;
Error& Error::operator=(Error&&) noexcept = default;
Error::~Error() = default;

std::string Error::message() const {
  std::string text;
  for (const std::string* part : {&file, &element, &reason}) {
    if (part->empty()) continue;
    if (!text.empty()) text += ": ";
    text += *part;
  }
  if (offset) text += " (at byte " + std::to_string(static_cast<size_t>(*offset)) + ")";
  return text;
}

tl::unexpected<Error> fail(ErrorKind kind, std::string_view element, std::string_view reason) {
  return fail(Error("", std::string(element), std::string(reason), kind));
}
tl::unexpected<Error> fail(ErrorKind kind, const char* element, const char* reason) {
  return fail(Error("", element, reason, kind));
}
tl::unexpected<Error> fail(std::string_view element, std::string_view reason) {
  return fail(ErrorKind::bad_input, element, reason);
}
tl::unexpected<Error> fail(const char* element, const char* reason) {
  return fail(ErrorKind::bad_input, element, reason);
}
tl::unexpected<Error> fail_at(uint64_t offset, const char* element, const char* reason) {
  return fail(Error("", element, reason, ErrorKind::bad_input, offset));
}
tl::unexpected<Error> fail(Error&& error) { return tl::unexpected<Error>(std::move(error)); }
tl::unexpected<Error> fail(const Error& error) { return tl::unexpected<Error>(error); }

Error in_file(Error error, const std::string& file) {
  if (error.file.empty()) error.file = file;
  return error;
}

Error in_element(Error error, std::string_view element) {
  std::string path(element);
  for (const std::string* part : {&error.file, &error.element})
    if (!part->empty()) path += ": " + *part;
  error.element = std::move(path);
  error.file.clear();
  return error;
}

Error at_byte(Error error, uint64_t offset) {
  if (!error.offset) error.offset = offset;
  return error;
}

void Report::warn(std::string text) {
  constexpr size_t most_warnings = 200;
  if (warnings.size() > most_warnings || std::find(warnings.begin(), warnings.end(), text) != warnings.end()) return;
  warnings.push_back(warnings.size() < most_warnings ? std::move(text) : "further warnings are left out");
}

}  // namespace lightwell
