// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "lightwell/bake/node_space.h"
#include "lightwell/light/grid.h"
#include "lightwell/trace/surface_cache.h"

namespace lightwell {

class NodeJournal;

/// What is known of a scene before its light is estimated.
struct BakeScene {
  const World& world;
  const FreeSpace& space;
  const SurfaceCache& cache;
  Box3f box;  ///< of the part that is baked
};

/// An estimator's sum over some of its samples. Sums of disjoint samples add up to the same bits in any order,
/// whichever threads, runs or machines made them: they hold integers or complete nodes.
class PartialLight {
 public:
  virtual ~PartialLight() = default;
  /// Adds the sum of other samples of the same estimator.
  virtual void add(const PartialLight& other) = 0;
};

/// The light at the nodes of a grid.
struct NodeLight {
  std::vector<Moments> moments;  ///< W/m2
  std::vector<float> noise;      ///< of the moments, a share of them; empty when unknown
  std::vector<float> insides;    ///< share of a node's surroundings that is inside of solids; 1: it stands in one
  uint64_t rays = 0;             ///< that it took
};

/// Estimates the light at the nodes of a grid from samples that do not depend on each other: photons or nodes. Threads
/// may share it.
class Estimator {
 public:
  virtual ~Estimator() = default;
  /// The number of samples.
  virtual uint64_t samples() const = 0;
  /// The name of the samples: "photons", "nodes".
  virtual std::string_view unit() const = 0;
  /// An empty sum.
  virtual std::unique_ptr<PartialLight> nothing() const = 0;
  /// The memory that a sum takes, bytes.
  virtual size_t partial_bytes() const = 0;
  /// Adds the samples begin ... end-1 to a sum of this estimator.
  virtual void add(uint64_t begin, uint64_t end, PartialLight& sum) const = 0;
  /// How many samples a thread takes at a time.
  virtual size_t samples_at_a_time() const = 0;
  /// The light that the sum of all samples stands for.
  virtual NodeLight finish(const PartialLight& whole) const = 0;
};

/// Options of an estimator.
struct EstimatorOptions {
  uint64_t photons = 8'000'000;
  uint64_t seed = 1;
  /// The luminaires whose direct light goes into the grid as well.
  LuminaireSet contained;
  bool reflected = true;  ///< whether what surfaces reflect is gathered
  float effort = 1;       ///< share of the rays that gathering takes by default
  int threads = 0;        ///< 0: all processors
  /// Of what was gathered before this run, if any.
  NodeJournal* journal = nullptr;
};

/// A row of the table of estimators. A new estimator is a new file and a row.
struct EstimatorKind {
  const char* name;
  const char* help;   ///< a few words for the command line
  bool node_by_node;  ///< whether a node's light does not depend on the grid, so that more nodes can be added
  /// Scene and options must outlive the estimator.
  std::unique_ptr<Estimator> (*make)(const BakeScene& scene, const GridShape& shape, const EstimatorOptions& options);
};

/// All estimators, the default one first.
std::span<const EstimatorKind> estimators();

}  // namespace lightwell
