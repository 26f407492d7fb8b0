// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "lightwell/scene/scene.h"

namespace lightwell {

/// The materials of a document in its order. Factors outside their range are clamped with a warning.
std::vector<Material> read_materials(const Json& document, Report& report);

/// The images of a document in its order, decoded. One that cannot be read is a white pixel and warned of.
std::vector<Image> read_images(const Document& document, Report& report);

}  // namespace lightwell
