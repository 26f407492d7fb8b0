// SPDX-License-Identifier: Apache-2.0
//
// room_inputs: writes generated cases, and damaged copies of each, to the standard output for room_digests. A native
// program, since encoders are the baker's.
#include <cstdio>

#include "tests/cases/generate.h"

using namespace lightwell;

int main() {
  constexpr int damaged_copies = 4;
  Random random(1, 1);
  ByteWriter writer;
  for (const Case& one : generate_cases()) {
    write_case(writer, one);
    for (int copy = 0; copy < damaged_copies; copy++) write_case(writer, damaged(one, random));
  }
  return std::fwrite(writer.bytes().data(), 1, writer.size(), stdout) == writer.size() ? 0 : 1;
}
