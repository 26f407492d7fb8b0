// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>
#include <vector>

namespace lightwell {

/// Why an operation on somebody's data failed: which file, which element of it, and the reason, each in a few words.
/// Printed as "FILE: ELEMENT: REASON"; an empty part is left out.
struct Error {
  std::string file;
  std::string element;
  std::string reason;

  std::string message() const;
};

/// A value, or the Error that prevented it.
template <typename T>
using Result = tl::expected<T, Error>;

/// The failure of element for the given reason; the file is added by whoever knows it (see in_file).
inline tl::unexpected<Error> fail(std::string element, std::string reason) {
  return tl::unexpected<Error>(Error{"", std::move(element), std::move(reason)});
}

inline tl::unexpected<Error> fail(Error error) { return tl::unexpected<Error>(std::move(error)); }

/// The same error, said of a file; an error that names its file already is left as it is.
Error in_file(Error error, const std::string& file);

/// What an import or a bake wants its user to know although it went on. Each warning is one line.
struct Report {
  std::vector<std::string> warnings;

  /// Adds a warning once; the same text again is dropped, and so are all beyond the 200 that anybody would read.
  void warn(std::string text);
};

}  // namespace lightwell

/// Evaluates a Result, returns its error from the calling function, or declares `name` as its value.
#define LW_TRY(name, expression)                                                  \
  auto name##_result = (expression);                                              \
  if (!name##_result) return ::lightwell::fail(std::move(name##_result).error()); \
  auto& name = *name##_result

/// Evaluates a Result<void> and returns its error from the calling function.
#define LW_CHECK(expression)                                                      \
  do {                                                                            \
    auto check_result = (expression);                                             \
    if (!check_result) return ::lightwell::fail(std::move(check_result).error()); \
  } while (false)
