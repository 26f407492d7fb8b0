// SPDX-License-Identifier: Apache-2.0
#include "lightwell/cli/pack_name.h"

#include <filesystem>

#include "lightwell/scene/builtin.h"

namespace lightwell {

Result<void> refuse_builtin_scene(const std::string& path) {
  std::error_code unknown;
  if (find_builtin_scene(path) == nullptr || std::filesystem::exists(path, unknown)) return {};
  return fail(
      {path, "", "is a built-in scene, not a pack; `lightwell bake " + path + " -o " + path + ".lw.glb` makes one"});
}

}  // namespace lightwell
