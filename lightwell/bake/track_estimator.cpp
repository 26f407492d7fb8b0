// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/track_estimator.h"

#include "lightwell/bake/tracks.h"
#include "lightwell/trace/photons.h"

namespace lightwell {
namespace {

/// Separate sums of the photons of even and of odd index: the difference of the two half estimates gives the noise.
struct HalfSums : public PartialLight {
  explicit HalfSums(const GridShape& shape) : halves{TrackSums(shape), TrackSums(shape)} {}

  void add(const PartialLight& other) override {
    const auto& more = static_cast<const HalfSums&>(other);
    for (size_t half = 0; half < halves.size(); half++) halves[half] += more.halves[half];
    flights += more.flights;
  }

  std::array<TrackSums, 2> halves;
  uint64_t flights = 0;
};

/// The mean of the half estimates at the valid nodes, zeros at the others.
std::vector<Moments> mean_of_halves(const std::vector<Moments>& a, const std::vector<Moments>& b,
                                    const std::vector<uint8_t>& valid) {
  std::vector<Moments> mean(a.size());
  for (size_t node = 0; node < a.size(); node++) {
    if (!valid[node]) continue;
    mean[node] += a[node] * 0.5f;
    mean[node] += b[node] * 0.5f;
  }
  return mean;
}

/// The noise of (a + b) / 2 relative to its root mean square, over the six E of the valid nodes.
float relative_noise(const std::vector<Moments>& a, const std::vector<Moments>& b, const std::vector<uint8_t>& valid) {
  double difference = 0, size = 0;
  for (size_t node = 0; node < a.size(); node++) {
    if (!valid[node]) continue;
    for (size_t i = 0; i < 6; i++) {
      const Vec3d x = a[node].m[i].cast<double>(), y = b[node].m[i].cast<double>();
      difference += dot(x - y, x - y);
      size += dot(x + y, x + y) / 4;
    }
  }
  return size > 0 ? static_cast<float>(std::sqrt(difference / size) / 2) : 0.0f;
}

class TrackEstimator : public Estimator {
 public:
  TrackEstimator(const World& world, const GridShape& shape, const EstimatorOptions& options)
      : world_(world),
        shape_(shape),
        options_(options),
        reference_flux_(std::max(max_component(world.lights().power()), world.lights().total_weight())) {}

  uint64_t samples() const override { return options_.photons; }
  std::string_view unit() const override { return "photons"; }
  std::unique_ptr<PartialLight> nothing() const override { return std::make_unique<HalfSums>(shape_); }
  size_t partial_bytes() const override { return 2 * TrackSums::bytes(shape_); }

  void add(uint64_t begin, uint64_t end, PartialLight& sum) const override {
    auto& sums = static_cast<HalfSums&>(sum);
    for (uint64_t photon = begin; photon < end; photon++) {
      Flight flight;
      for (PhotonWalk walk(world_, options_.seed, photon); walk.next(flight);) {
        sums.flights++;
        // Light that leaves the back of a surface is ignored: the rays of measure_node_space count the space there as
        // inside a solid.
        if ((flight.bounces == 0 && !options_.contained.contains(flight.luminaire)) || flight.from_back) continue;
        sums.halves[photon % 2].deposit(flight.origin, flight.direction, flight.length, flight.flux / reference_flux_);
      }
    }
  }

  NodeLight finish(const PartialLight& whole, const NodeSpace& space) const override {
    const auto& sums = static_cast<const HalfSums&>(whole);
    // If the number of photons is odd, the even half has one more.
    const uint64_t odd = options_.photons / 2;
    const auto moments = [&](size_t half, uint64_t photons) {
      return sums.halves[half].moments(reference_flux_ / static_cast<float>(photons), space.free_share);
    };
    const std::vector<Moments> a = moments(0, options_.photons - odd), b = moments(1, odd);
    return {mean_of_halves(a, b, space.valid), relative_noise(a, b, space.valid), sums.flights};
  }

 private:
  const World& world_;
  const GridShape shape_;
  const EstimatorOptions& options_;
  const float reference_flux_;  ///< flux of weight 1: the scene's power, about a photon's mean flux
};

}  // namespace

std::unique_ptr<Estimator> make_track_estimator(const World& world, const GridShape& shape,
                                                const EstimatorOptions& options) {
  return std::make_unique<TrackEstimator>(world, shape, options);
}

}  // namespace lightwell
