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

/// How radiance beyond the range of a screen is mapped into it.
enum class ToneCurve {
  none,     ///< clipped at 1
  neutral,  ///< Khronos PBR Neutral
};

/// The map from radiance to a screen: times 2^exposure, then the tone curve.
struct Display {
  float exposure = 0;  ///< EV
  ToneCurve tone = ToneCurve::neutral;

  /// What the screen emits, linear, within [0, 1].
  Vec3f operator()(const Vec3f& radiance) const;
  /// The radiance that it shows as a colour, linear, within [0, 1]. Bright colours that are more saturated than the
  /// tone curve leaves them come as near as it does.
  Vec3f radiance_of(Vec3f colour) const;
};

/// The Khronos PBR Neutral tone curve (Khronos Group, 2024): colours below 0.8 keep their hue and, apart from 4 % for
/// reflection, their value; brighter ones are compressed and desaturated.
Vec3f neutral_tone(Vec3f colour);

/// The picture as a screen shows it: 8-bit sRGB, three channels.
Image displayed(const Picture& picture, const Display& display);

/// Writes a picture; the extension gives the format: .png or none (as displayed), .exr or .pfm (32-bit floats,
/// unchanged). Others are an error.
Result<void> write_picture(const std::filesystem::path& path, const Picture& picture, const Display& display = {});

/// Reads a picture, recognised by content: OpenEXR, PFM (colour or grey, either byte order), or an 8-bit image, which
/// is taken as sRGB without a tone curve; transparency is ignored.
Result<Picture> read_picture(const std::filesystem::path& path);
Result<Picture> read_picture(Bytes file);

}  // namespace lightwell
