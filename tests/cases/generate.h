// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "lightwell/base/random.h"
#include "tests/cases/case.h"

namespace lightwell {

/// What the encoders make of generated light, meshes, images and packs, and random bytes for base: always the same.
/// Several of each room.
std::vector<Case> generate_cases();

/// A case with a few bits of one part turned over, or that part cut off somewhere.
Case damaged(Case one, Random& random);

}  // namespace lightwell
