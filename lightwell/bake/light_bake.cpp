// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/light_bake.h"

#include <algorithm>
#include <atomic>
#include <chrono>

#include "lightwell/bake/gathered_light.h"
#include "lightwell/bake/light_error.h"
#include "lightwell/bake/thin_walls.h"
#include "lightwell/base/assert.h"
#include "lightwell/base/parallel.h"
#include "lightwell/light/stream.h"

namespace lightwell {
namespace {

/// The memory that the threads' sums may take together, bytes; where it does not suffice, fewer threads add up.
constexpr size_t sums_limit = size_t(768) << 20;

Result<std::vector<GridShape>> place_nodes(const World& world, int longest) {
  std::vector<GridShape> shapes = possible_grids(world, longest);
  size_t most = 0;
  for (const GridShape& shape : shapes) most = std::max(most, shape.count());
  if (most <= LightLayout::most_nodes) return shapes;
  return fail(ErrorKind::limit, "grid",
              std::to_string(longest) + " nodes on the longest axis are " + std::to_string(most) +
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
      estimator.samples(), estimator.samples_at_a_time(), static_cast<int>(sums.size()),
      [&](size_t begin, size_t end, int thread) {
        estimator.add(begin, end, *sums[static_cast<size_t>(thread)]);
        progress.advance(static_cast<double>(done += end - begin));
      },
      [&] { return progress.cancelled(); });
  if (progress.cancelled()) return fail(ErrorKind::cancelled, "light", "cancelled");
  for (size_t i = 1; i < sums.size(); i++) sums.front()->add(*sums[i]);
  return std::move(sums.front());
}

/// The light of the surfaces that the nodes see, in cells of a third of the grid's: finer than what is looked up.
Result<SurfaceCache> light_surfaces(const World& world, const GridShape& shape, const EstimatorOptions& options,
                                    Progress& progress) {
  std::vector<Vec3f> viewpoints(shape.count());
  for (size_t i = 0; i < viewpoints.size(); i++) viewpoints[i] = viewpoint(world, shape, i);
  progress.stage("surfaces", 0, "cells");
  return SurfaceCache::build(world, viewpoints,
                             {.region = world.surfaces().bounds(),
                              .cell = max_component(shape.cell) / 3,
                              .seed = options.seed,
                              .threads = options.threads},
                             progress);
}

Result<NodeLight> light_nodes(const BakeScene& scene, const GridShape& shape, const LightBakeOptions& options,
                              Progress& progress) {
  const std::unique_ptr<Estimator> estimator = options.method->make(scene, shape, options.estimator);
  LW_TRY(sum, sum_up(*estimator, options.estimator.threads, progress));
  return estimator->finish(*sum);
}

/// The grid of which nodes with at most so large a share of insides around them are valid.
LightGrid grid_of(const GridShape& shape, const NodeLight& light, float most_insides) {
  LightGrid grid;
  grid.shape = shape;
  grid.moments = light.moments;
  for (size_t node = 0; node < light.insides.size(); node++) {
    grid.valid.push_back(light.insides[node] <= most_insides);
    if (!grid.valid.back()) grid.moments[node] = {};
  }
  fill_invalid(grid);
  return grid;
}

/// Keeps the grid that errs least of those that it is shown.
class BestGrid {
 public:
  explicit BestGrid(const TestPoints& test) : test_(test) {}

  /// Shows it the ways to use the nodes' light. A node that sees some insides stands near a thin solid, or behind a
  /// sheet: in rooms of sheets it is better left out, among furniture it is better kept.
  void consider(const GridShape& shape, const NodeLight& light) {
    for (const float most_insides : {0.25f, 0.5f, 0.8f, 0.95f}) {
      LightGrid grid = grid_of(shape, light, most_insides);
      grid.normal_offset = test_.best_offset(grid);
      const float error = test_.error(grid);
      if (!grid_.moments.empty() && error >= error_) continue;
      error_ = error;
      grid_ = std::move(grid);
    }
  }

  float error() const { return error_; }
  LightGrid take() { return std::move(grid_); }

 private:
  const TestPoints& test_;
  LightGrid grid_;
  float error_ = 0;
};

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
  LW_TRY(shapes, place_nodes(world, options.nodes));
  SurveyOptions survey{.seed = options.estimator.seed, .threads = options.estimator.threads};
  survey.most_photons = std::min(survey.most_photons, options.estimator.photons);
  LW_TRY(space, FreeSpace::survey(world, survey, progress));
  LW_TRY(cache, light_surfaces(world, shapes.front(), options.estimator, progress));
  const BakeScene scene{world, space, cache};
  const GatheredLight light(world, space, cache, options.estimator.contained);
  LW_TRY(test, TestPoints::gather(world, light, ~options.estimator.seed, options.estimator.threads, progress));

  statistics.rays = cache.rays();
  BestGrid best(test);
  for (const GridShape& shape : shapes) {
    LW_TRY(nodes, light_nodes(scene, shape, options, progress));
    statistics.rays += nodes.rays;
    best.consider(shape, nodes);
  }
  statistics.estimated_error = best.error();
  LightGrid grid = best.take();
  statistics.invalid_nodes = static_cast<size_t>(std::count(grid.valid.begin(), grid.valid.end(), 0));
  statistics.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return grid;
}

}  // namespace lightwell
