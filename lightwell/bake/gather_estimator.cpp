// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/gather_estimator.h"

#include "lightwell/bake/gathered_light.h"
#include "lightwell/bake/lookup_sides.h"

namespace lightwell {
namespace {

/// Nodes that are finished; the others are zero, so that sums are exact.
struct FinishedNodes : public PartialLight {
  explicit FinishedNodes(size_t count) : moments(count), noise(count), insides(count) {}

  void add(const PartialLight& other) override {
    const auto& more = static_cast<const FinishedNodes&>(other);
    for (size_t i = 0; i < moments.size(); i++) {
      moments[i] += more.moments[i];
      noise[i] += more.noise[i];
      insides[i] += more.insides[i];
    }
    rays += more.rays;
  }

  std::vector<Moments> moments;
  std::vector<float> noise, insides;
  uint64_t rays = 0;
};

class GatherEstimator : public Estimator {
 public:
  GatherEstimator(const BakeScene& scene, const GridShape& shape, const EstimatorOptions& options)
      : shape_(shape), light_(scene, options), lookups_(scene.world.surfaces(), scene.box) {
    lookups_.follow(shape, BrickTree(shape.cells()), options.threads);
  }

  uint64_t samples() const override { return shape_.count(); }
  std::string_view unit() const override { return "nodes"; }
  size_t samples_at_a_time() const override { return 16; }
  std::unique_ptr<PartialLight> nothing() const override { return std::make_unique<FinishedNodes>(shape_.count()); }
  size_t partial_bytes() const override { return shape_.count() * (sizeof(Moments) + 2 * sizeof(float)); }

  void add(uint64_t begin, uint64_t end, PartialLight& sum) const override {
    auto& nodes = static_cast<FinishedNodes&>(sum);
    for (uint64_t node = begin; node < end; node++) {
      const Vec3i corner = shape_.node(node);
      const auto found =
          light_.at_node(shape_.position(corner), shape_.cell, lookups_.facings(lattice_place(0, corner)));
      nodes.moments[node] = found.moments;
      nodes.noise[node] = found.noise;
      nodes.insides[node] = found.insides;
      nodes.rays += found.rays;
    }
  }

  NodeLight finish(const PartialLight& whole) const override {
    const auto& nodes = static_cast<const FinishedNodes&>(whole);
    return {nodes.moments, nodes.noise, nodes.insides, nodes.rays};
  }

 private:
  const GridShape shape_;
  const GatheredLight light_;
  LookupSides lookups_;
};

}  // namespace

std::unique_ptr<Estimator> make_gather_estimator(const BakeScene& scene, const GridShape& shape,
                                                 const EstimatorOptions& options) {
  return std::make_unique<GatherEstimator>(scene, shape, options);
}

}  // namespace lightwell
