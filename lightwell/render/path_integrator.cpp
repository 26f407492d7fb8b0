// SPDX-License-Identifier: Apache-2.0
#include "lightwell/render/path_integrator.h"

namespace lightwell {
namespace {

class PathIntegrator : public Integrator {
 public:
  PathIntegrator(const World& world, const IntegratorOptions& options)
      : world_(world), options_(options), max_bounces_(wants_indirect(options.part) ? options.max_bounces : 0) {}

  bool samples() const override { return wants_direct(options_.part) || max_bounces_ > 0; }

  ReflectedLight sample(const Receiver& receiver, Random& random) const override {
    DirectAndIndirect light(options_.left_out, options_.factors);
    const int rays = trace_path(world_, receiver, max_bounces_, random, light);
    ReflectedLight reflected{.rays = rays};
    if (wants_direct(options_.part)) reflected.radiance += light.direct;
    if (wants_indirect(options_.part)) reflected.radiance += light.indirect;
    return reflected;
  }

 private:
  const World& world_;
  const IntegratorOptions& options_;
  const int max_bounces_;
};

}  // namespace

std::unique_ptr<Integrator> make_path_integrator(const World& world, const IntegratorOptions& options) {
  return std::make_unique<PathIntegrator>(world, options);
}

}  // namespace lightwell
