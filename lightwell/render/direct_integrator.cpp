// SPDX-License-Identifier: Apache-2.0
#include "lightwell/render/direct_integrator.h"

#include "lightwell/render/direct_light.h"

namespace lightwell {
namespace {

class DirectIntegrator : public Integrator {
 public:
  DirectIntegrator(const World& world, const IntegratorOptions& options)
      : direct_(world, options, options.left_out), wanted_(wants_direct(options.part)) {}

  bool samples() const override { return wanted_; }

  ReflectedLight sample(const Receiver& receiver, Random& random) const override {
    return direct_.sample(receiver, {}, random);
  }

 private:
  const DirectLight direct_;
  const bool wanted_;
};

}  // namespace

std::unique_ptr<Integrator> make_direct_integrator(const World& world, const IntegratorOptions& options) {
  return std::make_unique<DirectIntegrator>(world, options);
}

}  // namespace lightwell
