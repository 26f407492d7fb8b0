// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/photon_estimator.h"

#include "lightwell/bake/faces.h"
#include "lightwell/bake/tracks.h"
#include "lightwell/trace/photons.h"

namespace lightwell {
namespace {

/// What photons leave in a grid, in TrackSums or FaceSums.
template <typename Sums>
struct PhotonSums : public PartialLight {
  explicit PhotonSums(const GridShape& shape) : left(shape) {}

  void add(const PartialLight& other) override {
    const auto& more = static_cast<const PhotonSums<Sums>&>(other);
    left += more.left;
    flights += more.flights;
  }

  Sums left;
  uint64_t flights = 0;
};

template <typename Sums>
class PhotonEstimator : public Estimator {
 public:
  PhotonEstimator(const World& world, const FreeSpace& space, const GridShape& shape, const EstimatorOptions& options)
      : world_(world),
        space_(space),
        shape_(shape),
        options_(options),
        reference_flux_(std::max(max_component(world.lights().power()), world.lights().total_weight())) {}

  uint64_t samples() const override { return options_.photons; }
  std::string_view unit() const override { return "photons"; }
  size_t samples_at_a_time() const override { return 4096; }
  std::unique_ptr<PartialLight> nothing() const override { return std::make_unique<PhotonSums<Sums>>(shape_); }
  size_t partial_bytes() const override { return Sums::bytes(shape_); }

  void add(uint64_t begin, uint64_t end, PartialLight& sum) const override {
    auto& sums = static_cast<PhotonSums<Sums>&>(sum);
    for (uint64_t photon = begin; photon < end; photon++) {
      Flight flight;
      for (PhotonWalk walk(world_, options_.seed, photon); walk.next(flight);) {
        sums.flights++;
        // Light that leaves the back of a surface is ignored: the rays of measure_node_space count the space there as
        // inside a solid.
        const bool wanted = flight.bounces > 0 ? options_.reflected : options_.contained.contains(flight.luminaire);
        if (!wanted || flight.from_back) continue;
        sums.left.deposit(flight.origin, flight.direction, flight.length, flight.flux / reference_flux_);
      }
    }
  }

  NodeLight finish(const PartialLight& whole) const override {
    const NodeSpace space = measure_node_space(world_.surfaces(), space_, shape_, ~options_.seed, options_.threads);
    const auto& sums = static_cast<const PhotonSums<Sums>&>(whole);
    const float flux = reference_flux_ / static_cast<float>(options_.photons);
    NodeLight light{sums.left.moments(flux, space.free_share), {}, {}, sums.flights};
    for (size_t node = 0; node < shape_.count(); node++)
      light.insides.push_back(space.valid[node] ? 1 - space.free_share[node] : 1.0f);
    return light;
  }

 private:
  const World& world_;
  const FreeSpace& space_;
  const GridShape shape_;
  const EstimatorOptions& options_;
  const float reference_flux_;  ///< flux of weight 1: the scene's power, about a photon's mean flux
};

struct PrintedFaceSums : public FaceSums {
  explicit PrintedFaceSums(const GridShape& shape) : FaceSums(shape, true) {}
};

}  // namespace

std::unique_ptr<Estimator> make_track_estimator(const BakeScene& scene, const GridShape& shape,
                                                const EstimatorOptions& options) {
  return std::make_unique<PhotonEstimator<TrackSums>>(scene.world, scene.space, shape, options);
}

std::unique_ptr<Estimator> make_face_estimator(const BakeScene& scene, const GridShape& shape,
                                               const EstimatorOptions& options) {
  return std::make_unique<PhotonEstimator<FaceSums>>(scene.world, scene.space, shape, options);
}

std::unique_ptr<Estimator> make_printed_face_estimator(const BakeScene& scene, const GridShape& shape,
                                                       const EstimatorOptions& options) {
  return std::make_unique<PhotonEstimator<PrintedFaceSums>>(scene.world, scene.space, shape, options);
}

}  // namespace lightwell
