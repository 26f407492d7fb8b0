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
    const Vec3d mean = sum_ / count_;
    const Vec3d variance = squares_ / count_ - mean * mean;
    const double total = std::max(0.0, variance[0]) + std::max(0.0, variance[1]) + std::max(0.0, variance[2]);
    return {mean.cast<float>(), static_cast<float>(std::sqrt(total / 3 / std::max(1.0, count_ - 1)))};
  }

 private:
  Vec3d sum_{}, squares_{};
  double count_ = 0;
};

/// Flags of the luminaires whose direct light the paths leave out: the grid's, and the environment when it is not
/// wanted.
std::vector<uint8_t> left_out(const TraceScene& scene, const ProbeOptions& options) {
  std::vector<uint8_t> flags(scene.lights().luminaires().size(), 0);
  for (size_t i = 0; i < flags.size(); i++) {
    const bool in_grid = options.integrator == Integrator::ivg && i < options.contained.size() && options.contained[i];
    const bool environment = scene.lights().luminaires()[i].kind == Luminaire::Kind::environment;
    flags[i] = in_grid || (environment && !options.environment);
  }
  return flags;
}

ProbeValue probe_with_paths(const TraceScene& scene, const ProbePoint& point, const ProbeOptions& options,
                            const PathOptions& path, Random random) {
  const Receiver receiver = Receiver::irradiance(point.position, point.normal);
  Mean mean;
  for (int i = 0; i < options.samples; i++) {
    const ReceivedLight light = trace_path(scene, receiver, path, random);
    Vec3f sample{};
    if (options.quantity != LightPart::indirect) sample += light.direct;
    if (options.quantity != LightPart::direct) sample += light.indirect;
    mean.add(sample);
  }
  return mean.value();
}

}  // namespace

Result<std::vector<ProbeValue>> probe(const TraceScene& scene, std::span<const ProbePoint> points,
                                      const ProbeOptions& options, Progress& progress) {
  const bool ivg = options.integrator == Integrator::ivg;
  LW_ASSERT(options.samples > 0 && options.integrator != Integrator::direct && (!ivg || options.grid));
  const std::vector<uint8_t> apart = left_out(scene, options);
  const PathOptions path{.max_bounces = ivg || options.quantity == LightPart::direct ? 0 : options.max_bounces,
                         .apart = apart};
  std::vector<ProbeValue> values(points.size());
  std::atomic<size_t> done = 0;
  progress.stage("probe", static_cast<double>(points.size()), "points");
  parallel_for(
      points.size(), 1, options.threads,
      [&](size_t begin, size_t end, int) {
        for (size_t i = begin; i < end; i++) {
          ProbeValue& value = values[i];
          if (!ivg || options.quantity != LightPart::indirect) {
            value = probe_with_paths(scene, points[i], options, path, Random(options.seed, i));
          }
          if (ivg && options.quantity != LightPart::direct) {
            value.irradiance += options.grid->irradiance(points[i].position, points[i].normal);
          }
        }
        progress.advance(static_cast<double>(done += end - begin));
      },
      [&] { return progress.cancelled(); });
  if (progress.cancelled()) return fail("probe", "cancelled");
  return values;
}

}  // namespace lightwell
