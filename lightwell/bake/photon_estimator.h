// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightwell/bake/estimator.h"

namespace lightwell {

/// Estimators whose samples are photons. The track-length estimator: the lengths of photons' flights through a node's
/// box, divided by the free part of its volume, give the node's light (docs/decisions/003-track-estimator.md).
std::unique_ptr<Estimator> make_track_estimator(const BakeScene& scene, const GridShape& shape,
                                                const EstimatorOptions& options);
/// R09's estimator: the photons that cross three faces round a node, each divided by the cosine that R09 leaves out
/// (bake/faces.h).
std::unique_ptr<Estimator> make_face_estimator(const BakeScene& scene, const GridShape& shape,
                                               const EstimatorOptions& options);

/// The faces of R09 with the weights that it prints, which find two thirds of uniform light. Not among estimators():
/// for the benchmark that compares them.
std::unique_ptr<Estimator> make_printed_face_estimator(const BakeScene& scene, const GridShape& shape,
                                                       const EstimatorOptions& options);

}  // namespace lightwell
