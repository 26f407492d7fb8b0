// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/bake/node_surroundings.h"

namespace lightwell {

/// Moments give light that comes from a few directions wrongly for normals between the axes, by up to a tenth. These
/// are moved, as little as it takes in their nine numbers, to give what the surfaces around that look them up receive:
/// `received` (W/m2) by normal. E stays positive and S within its bounds.
Moments fitted(const Moments& moments, const Facings& facings, std::span<const Vec3f> received);

}  // namespace lightwell
