// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "lightwell/base/result.h"
#include "lightwell/render/picture.h"

namespace lightwell {

/// How two pictures are compared.
enum class Metric {
  rmse,    ///< root of the mean squared difference of linear radiance
  relmse,  ///< mean squared difference over the squared reference plus 0.01 (Rousselle et al. 2011)
  deltae,  ///< CIEDE2000 between the displayed colours (Sharma et al. 2005)
  lab,     ///< Euclidean distance in CIE Lab in percent of the range of L (CIE76), as S08's "mean difference in Lab"
  flip,    ///< LDR-FLIP (Andersson et al. 2020) at 67 pixels a degree
};

/// The metric of a name ("rmse", ...), if it is one.
std::optional<Metric> metric_of(std::string_view name);

struct Comparison {
  std::vector<float> errors;  ///< one a pixel; for rmse the pixel's root mean square over its channels
  double mean = 0;            ///< of the errors; for rmse the root of the mean of their squares
  double p95 = 0;             ///< 95 % of the pixels err by at most this
  double max = 0;
};

/// Compares `picture` with `reference`, which must have the same size. `display` says how deltae, lab and flip see
/// them; pictures of 8 bits have been through a tone curve already.
Result<Comparison> compare(const Picture& picture, const Picture& reference, Metric metric,
                           const Display& display = {0, ToneCurve::none});

/// The errors as colours from black over red and yellow to white at the largest one, as displayed.
Image heat_map(const Comparison& comparison, int width, int height);

}  // namespace lightwell
