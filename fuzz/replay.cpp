// SPDX-License-Identifier: Apache-2.0
//
// TARGET FOLDER...: runs a fuzz target on every file of some folders, in builds without libFuzzer.
#include <cstdio>
#include <filesystem>

#include "lightwell/base/file.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

int main(int argc, char** argv) {
  int inputs = 0;
  for (int i = 1; i < argc; i++)
    for (const auto& entry : std::filesystem::directory_iterator(argv[i])) {
      const auto bytes = lightwell::read_file(entry.path().string());
      if (!bytes) return 1;
      LLVMFuzzerTestOneInput(bytes->data(), bytes->size());
      inputs++;
    }
  std::printf("%d inputs\n", inputs);
  return inputs > 0 ? 0 : 1;
}
