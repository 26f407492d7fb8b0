// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/light_bake.h"

#include <algorithm>
#include <atomic>
#include <chrono>

#include "lightwell/bake/thin_walls.h"
#include "lightwell/base/assert.h"
#include "lightwell/base/parallel.h"
#include "lightwell/light/stream.h"

namespace lightwell {
namespace {

/// The memory that the threads' sums may take together, bytes; where it does not suffice, fewer threads add up.
constexpr size_t sums_limit = size_t(768) << 20;
/// Samples that a thread takes at a time.
constexpr size_t samples_at_a_time = 4096;

Result<GridShape> place_nodes(const World& world, int longest) {
  const GridShape shape = grid_of_walls(world, longest);
  if (shape.count() <= LightLayout::most_nodes) return shape;
  return fail(ErrorKind::limit, "grid",
              std::to_string(longest) + " nodes on the longest axis are " + std::to_string(shape.count()) +
                  " in all, a pack holds " + std::to_string(LightLayout::most_nodes));
}

Result<std::unique_ptr<PartialLight>> sum_up(const Estimator& estimator, int threads, Progress& progress) {
  const size_t wanted = static_cast<size_t>(threads > 0 ? threads : default_threads());
  const size_t affordable = std::max<size_t>(1, sums_limit / estimator.partial_bytes());
  std::vector<std::unique_ptr<PartialLight>> sums;
  for (size_t i = 0; i < std::min(wanted, affordable); i++) sums.push_back(estimator.nothing());
  std::atomic<uint64_t> done = 0;
  progress.stage("light", static_cast<double>(estimator.samples()), estimator.unit());
  parallel_for(
      estimator.samples(), samples_at_a_time, static_cast<int>(sums.size()),
      [&](size_t begin, size_t end, int thread) {
        estimator.add(begin, end, *sums[static_cast<size_t>(thread)]);
        progress.advance(static_cast<double>(done += end - begin));
      },
      [&] { return progress.cancelled(); });
  if (progress.cancelled()) return fail(ErrorKind::cancelled, "light", "cancelled");
  for (size_t i = 1; i < sums.size(); i++) sums.front()->add(*sums[i]);
  return std::move(sums.front());
}

}  // namespace

Result<LightGrid> bake_light(const World& world, const LightBakeOptions& options, Progress& progress,
                             LightBakeStatistics& statistics) {
  LW_ASSERT(options.nodes >= 2 && options.estimator.photons >= 2);
  if (world.lights().dark()) {
    return fail("",
                "nothing shines: the scene has no emissive material, no lamp and no environment; "
                "--environment 1,1,1 lights it from all around");
  }
  const auto start = std::chrono::steady_clock::now();
  progress.stage("free space", 0, "photons");
  LW_TRY(shape, place_nodes(world, options.nodes));
  SurveyOptions survey{.seed = options.estimator.seed, .threads = options.threads};
  survey.most_photons = std::min(survey.most_photons, options.estimator.photons);
  LW_TRY(space, FreeSpace::survey(world, survey, progress));
  const std::unique_ptr<Estimator> estimator = options.method->make(world, shape, options.estimator);
  LW_TRY(sum, sum_up(*estimator, options.threads, progress));
  NodeSpace nodes = measure_node_space(world.surfaces(), space, shape, ~options.estimator.seed, options.threads);
  NodeLight light = estimator->finish(*sum, nodes);

  LightGrid grid;
  grid.shape = shape;
  grid.moments = std::move(light.moments);
  grid.valid = std::move(nodes.valid);
  fill_invalid(grid);
  statistics.rays = light.rays;
  statistics.estimated_error = light.noise;
  statistics.invalid_nodes = static_cast<size_t>(std::count(grid.valid.begin(), grid.valid.end(), 0));
  statistics.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return grid;
}

}  // namespace lightwell
