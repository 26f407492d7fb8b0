// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/bake/estimator.h"

namespace lightwell {

/// The track-length estimator: the lengths of photons' flights through a node's box, divided by the free part of its
/// volume, give the node's light (docs/decisions/003-track-estimator.md). A sample is a photon.
std::unique_ptr<Estimator> make_track_estimator(const BakeScene& scene, const GridShape& shape,
                                                const EstimatorOptions& options);

}  // namespace lightwell
