// SPDX-License-Identifier: Apache-2.0
#include "lightwell/render/probe.h"

#include <atomic>

#include "lightwell/base/assert.h"
#include "lightwell/base/parallel.h"

namespace lightwell {
namespace {

/// Mean and standard error of samples of a colour.
class Mean {
 public:
  void add(const Vec3f& sample) {
    const Vec3d s = sample.cast<double>();
    sum_ += s;
    squares_ += s * s;
    count_++;
  }
  ProbeValue value() const {
    if (count_ == 0) return {};
    const Vec3d mean = sum_ / count_;
    const Vec3d variance = squares_ / count_ - mean * mean;
    const double total = std::max(0.0, variance[0]) + std::max(0.0, variance[1]) + std::max(0.0, variance[2]);
    return {mean.cast<float>(), static_cast<float>(std::sqrt(total / 3 / std::max(1.0, count_ - 1)))};
  }

 private:
  Vec3d sum_{}, squares_{};
  double count_ = 0;
};

ProbeValue probe_point(const Integrator& integrator, const ProbePoint& point, int samples, Random random) {
  const Receiver receiver = Receiver::irradiance(point.position, point.normal);
  Mean mean;
  if (integrator.samples())
    for (int i = 0; i < samples; i++) mean.add(integrator.sample(receiver, random).radiance);
  ProbeValue value = mean.value();
  value.irradiance += integrator.known(receiver);
  return value;
}

}  // namespace

Result<std::vector<ProbeValue>> probe(const World& world, std::span<const ProbePoint> points,
                                      const ProbeOptions& options, Progress& progress) {
  LW_ASSERT(options.samples > 0);
  if (options.integrator->needs_field && !options.light.field)
    return fail("probe", "there is no light grid to look up");
  const std::unique_ptr<Integrator> integrator = options.integrator->make(world, options.light);
  std::vector<ProbeValue> values(points.size());
  std::atomic<size_t> done = 0;
  progress.stage("probe", static_cast<double>(points.size()), "points");
  parallel_for(
      points.size(), 1, options.threads,
      [&](size_t begin, size_t end, int) {
        for (size_t i = begin; i < end; i++)
          values[i] = probe_point(*integrator, points[i], options.samples, Random(options.seed, i));
        progress.advance(static_cast<double>(done += end - begin));
      },
      [&] { return progress.cancelled(); });
  if (progress.cancelled()) return fail(ErrorKind::cancelled, "probe", "cancelled");
  return values;
}

}  // namespace lightwell
