// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/gather_estimator.h"

#include "lightwell/bake/gathered_light.h"

namespace lightwell {
namespace {

/// Nodes that are finished; the others are zero, so that sums are exact.
struct FinishedNodes : public PartialLight {
  explicit FinishedNodes(size_t count) : moments(count), insides(count) {}

  void add(const PartialLight& other) override {
    const auto& more = static_cast<const FinishedNodes&>(other);
    for (size_t i = 0; i < moments.size(); i++) {
      moments[i] += more.moments[i];
      insides[i] += more.insides[i];
    }
    rays += more.rays;
  }

  std::vector<Moments> moments;
  std::vector<float> insides;
  uint64_t rays = 0;
};

class GatherEstimator : public Estimator {
 public:
  GatherEstimator(const BakeScene& scene, const GridShape& shape, const EstimatorOptions& options)
      : shape_(shape), options_(options), light_(scene.world, scene.space, scene.cache, options.contained, scene.box) {}

  uint64_t samples() const override { return shape_.count(); }
  std::string_view unit() const override { return "nodes"; }
  size_t samples_at_a_time() const override { return 16; }
  std::unique_ptr<PartialLight> nothing() const override { return std::make_unique<FinishedNodes>(shape_.count()); }
  size_t partial_bytes() const override { return shape_.count() * (sizeof(Moments) + sizeof(float)); }

  void add(uint64_t begin, uint64_t end, PartialLight& sum) const override {
    auto& nodes = static_cast<FinishedNodes&>(sum);
    for (uint64_t node = begin; node < end; node++) {
      Random random(options_.seed, node);
      const auto found = light_.at_node(shape_.position(shape_.node(node)), shape_.cell, random);
      nodes.moments[node] = found.moments;
      nodes.insides[node] = found.insides;
      nodes.rays += found.rays;
    }
  }

  NodeLight finish(const PartialLight& whole) const override {
    const auto& nodes = static_cast<const FinishedNodes&>(whole);
    return {nodes.moments, nodes.insides, nodes.rays};
  }

 private:
  const GridShape shape_;
  const EstimatorOptions& options_;
  const GatheredLight light_;
};

}  // namespace

std::unique_ptr<Estimator> make_gather_estimator(const BakeScene& scene, const GridShape& shape,
                                                 const EstimatorOptions& options) {
  return std::make_unique<GatherEstimator>(scene, shape, options);
}

}  // namespace lightwell
