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

/// What kind of failure it is, for callers that act on it.
enum class ErrorKind : uint8_t {
  bad_input,    ///< the data or the argument is not what it has to be
  unsupported,  ///< of a format, version, codec or extension that this program does not know
  io,           ///< a file, a network or the system did not do what was asked of it
  cancelled,    ///< the user ended it
  limit,        ///< beyond a stated limit, or beyond the memory that there is
};

/// Why an operation on somebody's data failed: the file, the element of it and the reason, each in a few words, and the
/// first byte concerned where that is known. Its special members are out of line, since hundreds of callers have them.
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

  /// "FILE: ELEMENT: REASON (at byte OFFSET)"; what is empty or unknown is left out.
  std::string message() const;
};

/// A value, or the Error that prevented it.
template <typename T>
using Result = tl::expected<T, Error>;

/// The failure of an element for the given reason; the file is added by whoever knows it (see in_file). Literals have
/// an overload of their own, since they are shorter code.
tl::unexpected<Error> fail(ErrorKind kind, std::string_view element, std::string_view reason);
tl::unexpected<Error> fail(ErrorKind kind, const char* element, const char* reason);
/// The same for bad input.
tl::unexpected<Error> fail(std::string_view element, std::string_view reason);
tl::unexpected<Error> fail(const char* element, const char* reason);
/// The same at a byte of the file.
tl::unexpected<Error> fail_at(uint64_t offset, const char* element, const char* reason);
tl::unexpected<Error> fail(Error&& error);
tl::unexpected<Error> fail(const Error& error);

/// The same error, said of a file; an error that names its file already is left as it is.
Error in_file(Error error, const std::string& file);
/// The same error, said of an element of another file: the file and the element that it named so far follow the
/// element's name.
Error in_element(Error error, std::string_view element);
/// The same error with the byte of the file where it is; an error that knows its byte already is left as it is.
Error at_byte(Error error, uint64_t offset);

/// The warnings of an import or a bake that went on in spite of them, each one line. For one thread at a time.
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
