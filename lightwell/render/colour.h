// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/base/vector.h"

namespace lightwell {

/// CIE XYZ relative to the white of sRGB (D65), so that white is (1, 1, 1), and back.
Vec3f relative_xyz(const Vec3f& linear_srgb);
Vec3f linear_srgb(const Vec3f& relative_xyz);

/// CIE L*a*b* of 1976.
Vec3f lab_of(const Vec3f& relative_xyz);

/// The colour difference CIEDE2000 between two L*a*b* colours (Sharma, Wu, Dalal 2005).
float ciede2000(const Vec3f& lab1, const Vec3f& lab2);

}  // namespace lightwell
