// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

namespace lightwell {

/// The file of a scene, and those beside it that it names: buffers and images of a glTF, materials of an OBJ and their
/// images, images of a PLY. Of what it names nothing need be there, nor be read in the end.
std::vector<std::filesystem::path> files_of_scene(const std::filesystem::path& path);

}  // namespace lightwell
