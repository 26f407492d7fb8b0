// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>

/// Checks a contract between functions of the program: a false condition is a bug, never bad input.
/// Active in every build, since a wrong picture costs more than the test. The condition has no side effects, so that
/// the program would be the same without it; the test "asserts" looks after that.
#define LW_ASSERT(condition)        \
  do {                              \
    if (!(condition)) std::abort(); \
  } while (false)
