// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <utility>
#include <vector>

namespace lightwell {

/// The kind of a failure, for callers that act on it.
enum class ErrorKind : uint8_t {
  bad_input,    ///< the data or an argument is invalid
  unsupported,  ///< a format, version, codec or extension that this program does not know
  io,           ///< a file, the network or the system failed
  cancelled,    ///< ended by the user
  limit,        ///< beyond a stated limit or the available memory
};

/// Why an operation on input failed: the file, the element in it and the reason, each in a few words, and the first
/// byte concerned where it is known. Its special members are out of line, since hundreds of callers would inline them.
struct Error {
  std::string file;
  std::string element;
  std::string reason;
  ErrorKind kind = ErrorKind::bad_input;
  std::optional<uint64_t> offset;  ///< in the file

  Error(std::string file, std::string element, std::string reason, ErrorKind kind = ErrorKind::bad_input,
        std::optional<uint64_t> offset = {});
  Error(const Error&);
  Error(Error&&) noexcept;
  Error& operator=(const Error&);
  Error& operator=(Error&&) noexcept;
  ~Error();

  /// "FILE: ELEMENT: REASON (at byte OFFSET)"; empty or unknown parts are left out.
  std::string message() const;
};

/// A value, or the Error that prevented it.
template <typename T>
using Result = tl::expected<T, Error>;

/// The error of an element with a reason; a caller that knows the file adds it (see in_file). String literals have
/// their own overloads, which make smaller code.
tl::unexpected<Error> fail(ErrorKind kind, std::string_view element, std::string_view reason);
tl::unexpected<Error> fail(ErrorKind kind, const char* element, const char* reason);
/// The same for bad input.
tl::unexpected<Error> fail(std::string_view element, std::string_view reason);
tl::unexpected<Error> fail(const char* element, const char* reason);
/// The same for bad input at a byte of the file.
tl::unexpected<Error> fail_at(uint64_t offset, const char* element, const char* reason);
tl::unexpected<Error> fail(Error&& error);
tl::unexpected<Error> fail(const Error& error);

/// The error with the file's name added, unless it names one already.
Error in_file(Error error, const std::string& file);
/// The error moved into an enclosing file: `element` is put before the file and element named so far, and the file
/// becomes empty, for in_file to set.
Error in_element(Error error, std::string_view element);
/// The error with its byte offset in the file added, unless it has one already.
Error at_byte(Error error, uint64_t offset);

/// The warnings of an import or a bake that succeeded in spite of them, one line each. Not for concurrent use.
struct Report {
  std::vector<std::string> warnings;

  /// Adds a warning unless the same text is there already. After 200 a last line says that further ones are left out.
  void warn(std::string text);
};

}  // namespace lightwell

/// Evaluates a Result: returns its error from the calling function, or declares `name` as its value.
#define LW_TRY(name, expression)                                                  \
  auto name##_result = (expression);                                              \
  if (!name##_result) return ::lightwell::fail(std::move(name##_result).error()); \
  auto& name = *name##_result

/// Evaluates a Result<void> and returns its error, if any, from the calling function.
#define LW_CHECK(expression)                                                      \
  do {                                                                            \
    auto check_result = (expression);                                             \
    if (!check_result) return ::lightwell::fail(std::move(check_result).error()); \
  } while (false)
