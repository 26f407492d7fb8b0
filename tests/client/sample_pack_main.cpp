// SPDX-License-Identifier: Apache-2.0
//
// sample_pack FILE [TRIANGLES]: writes a small pack whose light is a formula, for tests of clients that need no bake.
#include <cstdio>
#include <cstdlib>

#include "lightwell/base/file.h"
#include "tests/client/sample_pack.h"

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: sample_pack FILE [TRIANGLES]\n");
    return 2;
  }
  const auto triangles = static_cast<uint32_t>(argc > 2 ? std::atoi(argv[2]) : 20000);
  const auto written = lightwell::write_file(argv[1], lightwell::sample_pack(lightwell::sample_scene(triangles, 16)));
  if (!written) std::fprintf(stderr, "sample_pack: %s\n", written.error().message().c_str());
  return written ? 0 : 1;
}
