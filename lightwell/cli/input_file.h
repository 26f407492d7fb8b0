// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>

#include "lightwell/base/result.h"

namespace lightwell {

/// What stdin brings up to its end, as a file in memory that can be read from anywhere.
class StandardInput {
 public:
  static Result<StandardInput> read();
  StandardInput(StandardInput&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  ~StandardInput();

  /// A name by which this process can open it.
  std::string path() const;

 private:
  explicit StandardInput(int descriptor) : descriptor_(descriptor) {}

  int descriptor_;
};

/// What open(path) gives for the file that an argument names; "-" is stdin, and errors say so.
template <typename Open>
auto with_input(const std::string& name, const Open& open) -> decltype(open(name)) {
  if (name != "-") return open(name);
  LW_TRY(input, StandardInput::read());
  const std::string path = input.path();
  auto opened = open(path);
  if (!opened && opened.error().file == path) opened.error().file = "stdin";
  return opened;
}

}  // namespace lightwell
