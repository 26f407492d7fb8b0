// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "lightwell/base/result.h"
#include "lightwell/render/picture.h"

namespace lightwell {

/// How two pictures are compared. `lab` is the figure for quantised light in S08 (Pacanowski, Granier et al.,
/// "Efficient Streaming of 3D Scenes with Complex Geometry and Complex Lighting", Web3D 2008): the mean difference in
/// Lab.
enum class Metric {
  rmse,    ///< root of the mean squared difference of linear radiance
  relmse,  ///< mean squared difference over the squared reference plus 0.01 (Rousselle et al. 2011)
  deltae,  ///< CIEDE2000 between the displayed colours (Sharma et al. 2005)
  lab,     ///< Euclidean distance in CIE Lab (CIE76), in percent of the range of L
  flip,    ///< LDR-FLIP (Andersson et al. 2020) at 67 pixels a degree
};

/// The metric with this name ("rmse", ...), if there is one.
std::optional<Metric> metric_of(std::string_view name);

struct Comparison {
  std::vector<float> errors;  ///< one a pixel; for rmse the pixel's root mean square over its channels
  double mean = 0;            ///< of the errors; for rmse the root of the mean of their squares
  double p95 = 0;             ///< 95 % of the pixels err by at most this
  double max = 0;
};

/// Compares `picture` with `reference`; fails when their sizes differ or they are empty. `display` is how deltae, lab
/// and flip see them: by default without a tone curve, since 8-bit pictures have been through one already.
Result<Comparison> compare(const Picture& picture, const Picture& reference, Metric metric,
                           const Display& display = {0, ToneCurve::none});

/// The errors as colours from black over red and yellow to white at the largest one, as displayed.
Image heat_map(const Comparison& comparison, int width, int height);

}  // namespace lightwell
