// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "lightwell/packing/environment_extension.h"
#include "lightwell/scene/scene.h"

namespace lightwell {

/// The width of the picture that a pack keeps of its environment, at most, pixels. It is kept without loss: seen from
/// within, a pixel is as large as twenty of the screen, and a block of a lossy file like a window.
inline constexpr int environment_width = 512;

/// Radiance in the bytes of an ordinary image, equal steps of its logarithm.
struct CodedRadiance {
  Image image;                    ///< three channels
  float radiance = 0, stops = 0;  ///< as in EnvironmentPicture
};

/// Codes an environment's map, means of its pixels where it is larger than `environment_width`. Nothing where there is
/// no map, only a black one, or one brighter than a pack may state.
std::optional<CodedRadiance> coded(const Environment& environment);

/// The radiance of a coded image: radiance * 2^(stops (byte / 255 - 1)), of the byte 0 none.
RadianceImage decoded(const Image& image, const EnvironmentPicture& picture);

/// Appends the picture of a scene's environment to its document and its images, as a texture that nothing shows, and
/// says where it is. Nothing where coded() gives nothing.
std::optional<EnvironmentPicture> add_environment(Scene& scene, Document& document);

}  // namespace lightwell
