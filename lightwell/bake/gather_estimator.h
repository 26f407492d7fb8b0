// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/bake/estimator.h"

namespace lightwell {

/// Rays from each node see surfaces, whose light the surface cache knows (trace/surface_cache.h). Without blur: a node
/// holds the light of its own place. A sample is a node.
std::unique_ptr<Estimator> make_gather_estimator(const BakeScene& scene, const GridShape& shape,
                                                 const EstimatorOptions& options);

}  // namespace lightwell
