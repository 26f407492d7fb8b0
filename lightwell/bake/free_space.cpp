// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/free_space.h"

#include "lightwell/base/parallel.h"
#include "lightwell/trace/photons.h"

namespace lightwell {
namespace {

/// A scene is closed if a smaller share of the flights escapes.
constexpr double closed_escapes = 1e-3;
/// Photons traced between checks whether there are enough. One batch is enough to tell whether a scene is closed.
constexpr uint64_t batch = 1 << 16;

/// Pieces of double-sided surface that all threads together may count, 16 bytes each: beyond that fewer threads count.
constexpr size_t most_counts = 1 << 24;

/// The observations of one thread.
struct Sightings {
  Solids::Hits hits;
  uint64_t flights = 0;
  uint64_t escaped = 0;

  void watch(const World& world, const Solids& solids, uint64_t seed, uint64_t photon) {
    Flight flight;
    for (PhotonWalk walk(world, seed, photon); walk.next(flight);) {
      flights++;
      escaped += !std::isfinite(flight.length);
      if (walk.end()) solids.count(*walk.end(), hits);
    }
  }

  Sightings& operator+=(const Sightings& other) {
    hits += other.hits;
    flights += other.flights;
    escaped += other.escaped;
    return *this;
  }
};

}  // namespace

Result<FreeSpace> FreeSpace::survey(const World& world, const SurveyOptions& options, Progress& progress) {
  FreeSpace space(Solids(world.surfaces()));
  const int wanted = options.threads > 0 ? options.threads : default_threads();
  const size_t affordable = std::max<size_t>(1, most_counts / (1 + space.solids_.no_hits().front.size()));
  const int threads = static_cast<int>(std::min(affordable, static_cast<size_t>(wanted)));
  std::vector<Sightings> seen(static_cast<size_t>(threads), Sightings{space.solids_.no_hits()});
  Sightings sum{space.solids_.no_hits()};
  for (uint64_t first = 0; first < options.most_photons && !(first > 0 && space.solids_.settled(sum.hits));
       first += batch) {
    const uint64_t count = std::min(batch, options.most_photons - first);
    parallel_for(
        count, 4096, threads,
        [&](size_t begin, size_t end, int thread) {
          for (size_t i = begin; i < end; i++)
            seen[static_cast<size_t>(thread)].watch(world, space.solids_, options.seed, first + i);
        },
        [&] { return progress.cancelled(); });
    if (progress.cancelled()) return fail(ErrorKind::cancelled, "light", "cancelled");
    sum = {space.solids_.no_hits()};
    for (const Sightings& of_thread : seen) sum += of_thread;
  }
  // There is no flight at all if every photon began where its source is black.
  space.closed_ =
      sum.flights > 0 && static_cast<double>(sum.escaped) < closed_escapes * static_cast<double>(sum.flights);
  space.solids_.decide(sum.hits);
  return space;
}

}  // namespace lightwell
