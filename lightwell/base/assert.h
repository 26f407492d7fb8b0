// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>

/// Checks a contract between functions of the program and aborts when it is broken: a false condition is a bug, never
/// bad input. Active in every build, since a wrong picture costs more than the check. The condition must have no side
/// effects, so that the program is the same without it; the test "asserts" checks this.
#define LW_ASSERT(condition)        \
  do {                              \
    if (!(condition)) std::abort(); \
  } while (false)
