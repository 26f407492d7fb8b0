// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "lightwell/base/bytes.h"
#include "lightwell/base/result.h"
#include "lightwell/base/vector.h"
#include "lightwell/texture/image.h"

namespace lightwell {

/// A picture of linear RGB radiance, first row at the top.
using Picture = RadianceImage;

/// How radiance above what a screen can show is brought into its range.
enum class ToneCurve {
  none,     ///< cut off at 1
  neutral,  ///< Khronos PBR Neutral
};

/// From radiance to a screen: times 2^exposure, then the tone curve, then sRGB.
struct Display {
  float exposure = 0;  ///< EV
  ToneCurve tone = ToneCurve::neutral;
};

/// The Khronos PBR Neutral tone curve (Khronos Group, 2024): colours below 0.8 keep their hue and, 4 % of reflection
/// apart, their value; brighter ones are compressed and desaturated.
Vec3f neutral_tone(Vec3f radiance);

/// The sRGB transfer function (IEC 61966-2-1) of a linear value in [0, 1], and its inverse.
float to_srgb(float linear);
float from_srgb(float encoded);

/// The picture as a screen shows it: 8-bit sRGB, three channels.
Image to_display(const Picture& picture, const Display& display);

/// Writes a picture; the name's ending says how: .png (as displayed), .exr (half floats would lose the dark: 32-bit
/// floats) or .pfm (floats, first row at the bottom), both linear and without exposure.
Result<void> write_picture(const std::filesystem::path& path, const Picture& picture, const Display& display = {});

/// Reads a picture of any of these kinds, recognised by content; 8-bit images are taken as sRGB without a tone curve.
Result<Picture> read_picture(const std::filesystem::path& path);

}  // namespace lightwell
