// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/light_bake.h"

#include <algorithm>
#include <atomic>
#include <chrono>

#include "lightwell/bake/free_space.h"
#include "lightwell/bake/thin_walls.h"
#include "lightwell/bake/tracks.h"
#include "lightwell/base/assert.h"
#include "lightwell/base/parallel.h"
#include "lightwell/light/stream.h"
#include "lightwell/trace/photons.h"

namespace lightwell {
namespace {

/// A node with less of its box free stands in a solid; what light it got says more of chance than of the scene.
constexpr float least_free_share = 0.05f;
/// A scene from which a smaller share of the flights escapes is closed: some escape through cracks of any mesh.
constexpr double closed_escapes = 1e-3;
/// What the threads' sums may take together, bytes; beyond that fewer threads deposit.
constexpr size_t sums_limit = size_t(768) << 20;

/// The two half bakes: photons of even and of odd index.
using Halves = std::array<TrackSums, 2>;

/// What one thread adds up.
struct Worker {
  Worker(const GridShape& shape, const Solids& solids)
      : halves{TrackSums(shape), TrackSums(shape)}, hits(solids.no_hits()) {}

  void trace(const TraceScene& scene, const Solids& solids, const LightBakeOptions& options, uint64_t photon,
             float flux) {
    Flight flight;
    for (PhotonWalk walk(scene, options.seed, photon); walk.next(flight);) {
      flights++;
      escaped += !std::isfinite(flight.length);
      if (walk.end()) solids.count(*walk.end(), hits);
      const size_t luminaire = static_cast<size_t>(flight.luminaire);
      const bool contained = luminaire < options.contained.size() && options.contained[luminaire];
      // Light from the back of a surface would be met by a node's rays as the inside of a solid, see free_shares().
      if ((flight.bounces == 0 && !contained) || flight.from_back) continue;
      halves[photon % 2].deposit(flight.origin, flight.direction, flight.length, flight.flux / flux);
    }
  }

  Worker& operator+=(const Worker& other) {
    for (size_t half = 0; half < halves.size(); half++) halves[half] += other.halves[half];
    hits += other.hits;
    flights += other.flights;
    escaped += other.escaped;
    return *this;
  }

  Halves halves;
  Solids::Hits hits;
  uint64_t flights = 0;
  uint64_t escaped = 0;
};

/// Photons of what flux a deposit of weight 1 stands for: the scene's power, which is also a photon's mean flux.
float reference_flux(const TraceScene& scene) {
  return std::max(max_component(scene.lights().power()), scene.lights().total_weight());
}

Worker trace_photons(const TraceScene& scene, const Solids& solids, const GridShape& shape,
                     const LightBakeOptions& options, Progress& progress) {
  const size_t threads = static_cast<size_t>(options.threads > 0 ? options.threads : default_threads());
  const size_t affordable = std::max<size_t>(1, sums_limit / (2 * TrackSums::bytes(shape)));
  std::vector<Worker> workers;
  for (size_t i = 0; i < std::min(threads, affordable); i++) workers.emplace_back(shape, solids);
  const float flux = reference_flux(scene);
  std::atomic<uint64_t> done = 0;
  progress.stage("light", static_cast<double>(options.photons), "photons");
  parallel_for(
      options.photons, 4096, static_cast<int>(workers.size()),
      [&](size_t begin, size_t end, int thread) {
        for (size_t photon = begin; photon < end; photon++) {
          workers[static_cast<size_t>(thread)].trace(scene, solids, options, photon, flux);
        }
        progress.advance(static_cast<double>(done += end - begin));
      },
      [&] { return progress.cancelled(); });
  Worker& sum = workers.front();
  for (size_t i = 1; i < workers.size(); i++) sum += workers[i];
  return std::move(sum);
}

/// A flag a node: it stands in free space, of which its box has a share.
std::vector<uint8_t> valid_nodes(const TraceScene& scene, const Solids& solids, const GridShape& shape,
                                 const std::vector<float>& shares) {
  std::vector<uint8_t> valid;
  for (size_t node = 0; node < shares.size(); node++)
    valid.push_back(shares[node] >= least_free_share && !is_in_thin_wall(scene, solids, shape, node));
  return valid;
}

/// The mean of the half bakes at the valid nodes, nothing at the others.
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

/// The noise of (a + b) / 2 as a share of its size, over the six E of the valid nodes.
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

}  // namespace

Result<LightGrid> bake_light(const TraceScene& scene, const LightBakeOptions& options, Progress& progress,
                             LightBakeStatistics& statistics) {
  LW_ASSERT(options.nodes >= 2 && options.photons >= 2);
  if (scene.lights().dark()) {
    return fail("",
                "nothing shines: the scene has no emissive material, no lamp and no environment; "
                "--environment 1,1,1 lights it from all around");
  }
  const auto start = std::chrono::steady_clock::now();
  LightGrid grid;
  grid.shape = grid_of_walls(scene, options.nodes);
  if (grid.shape.count() > LightLayout::most_nodes) {
    return fail("grid", std::to_string(options.nodes) + " nodes on the longest axis are " +
                            std::to_string(grid.shape.count()) + " in all, a pack holds " +
                            std::to_string(LightLayout::most_nodes));
  }
  Solids solids(scene);
  const Worker traced = trace_photons(scene, solids, grid.shape, options, progress);
  if (progress.cancelled()) return fail("light", "cancelled");

  statistics.photons = options.photons;
  statistics.rays = traced.flights;
  // There is no flight at all when every photon began where its source is black.
  statistics.escaped = static_cast<float>(static_cast<double>(traced.escaped) /
                                          static_cast<double>(std::max<uint64_t>(traced.flights, 1)));
  const bool closed = traced.flights > 0 && static_cast<double>(statistics.escaped) < closed_escapes;
  solids.decide(traced.hits);
  const std::vector<float> shares = free_shares(scene, solids, grid.shape, closed, ~options.seed, options.threads);
  grid.valid = valid_nodes(scene, solids, grid.shape, shares);
  statistics.invalid_nodes = static_cast<size_t>(std::count(grid.valid.begin(), grid.valid.end(), 0));

  // A half holds half of the photons (one more of even index when their number is odd).
  const float flux = reference_flux(scene);
  const uint64_t odd = options.photons / 2;
  const std::vector<Moments> a = traced.halves[0].moments(flux / static_cast<float>(options.photons - odd), shares);
  const std::vector<Moments> b = traced.halves[1].moments(flux / static_cast<float>(odd), shares);
  statistics.estimated_error = relative_noise(a, b, grid.valid);
  grid.moments = mean_of_halves(a, b, grid.valid);
  fill_invalid(grid);
  statistics.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return grid;
}

}  // namespace lightwell
