// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/coarse_light.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "lightwell/bake/thin_walls.h"
#include "lightwell/base/parallel.h"
#include "lightwell/light/stream.h"

namespace lightwell {
namespace {

/// The memory that the threads' sums may take together, bytes; where it does not suffice, fewer threads add up.
constexpr size_t sums_limit = size_t(768) << 20;

/// Gives a grid an even number of cells on each axis, as bricks need.
void make_divisible(GridShape& shape) {
  for (int a = 0; a < 3; a++) {
    if (shape.cells()[a] % 2 == 0) continue;
    shape.cell[a] *= static_cast<float>(shape.cells()[a]) / static_cast<float>(shape.nodes[a]);
    shape.nodes[a]++;
  }
}

Result<std::vector<GridShape>> place_nodes(const Place& place, const Effort& effort) {
  std::vector<GridShape> shapes = possible_grids(place.world, place.space, place.box, effort.nodes);
  if (effort.adaptive) std::for_each(shapes.begin(), shapes.end(), make_divisible);
  size_t most = 0;
  for (const GridShape& shape : shapes) most = std::max(most, shape.count());
  if (most <= LightLayout::most_nodes) return shapes;
  return fail(ErrorKind::limit, "grid",
              std::to_string(effort.nodes) + " nodes on the longest axis are " + std::to_string(most) +
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

}  // namespace

Result<SurfaceCache> light_surfaces(const Place& place, const GridShape& shape, float cell,
                                    const EstimatorOptions& options, Progress& progress) {
  std::vector<Vec3f> viewpoints(shape.count());
  for (size_t i = 0; i < viewpoints.size(); i++)
    viewpoints[i] = viewpoint(place.box, shape.position(shape.node(i)), shape.cell);
  progress.stage("surfaces", 0, "cells");
  SurfaceCacheOptions of_cache{.region = place.box, .cell = cell, .seed = options.seed, .threads = options.threads};
  of_cache.samples = scaled(of_cache.samples, std::sqrt(options.effort));
  return SurfaceCache::build(place.world, viewpoints, of_cache, progress);
}

Result<NodeLight> light_nodes(const BakeScene& scene, const GridShape& shape, const LightBakeOptions& options,
                              Progress& progress) {
  const std::unique_ptr<Estimator> estimator = options.method->make(scene, shape, options.estimator);
  LW_TRY(sum, sum_up(*estimator, options.estimator.threads, progress));
  return estimator->finish(*sum);
}

Effort Effort::as_draft() const {
  Effort draft = *this;
  draft.nodes = coarsest_nodes;
  draft.rays = least_rays;
  return draft;
}

bool Effort::draft() const { return nodes == coarsest_nodes && rays == least_rays; }

bool BestGrid::consider(const AdaptiveLight& light, std::span<const NodeRule> ways, float most) {
  bool better = false;
  const float allowed = most * badness_;
  for (const NodeRule& rule : ways) {
    LightGrid grid = light.grid(rule);
    grid.normal_offset = test_.best_offset(grid);
    const float badness = test_.badness(grid);
    if (!grid_.moments.empty() && badness >= (better ? badness_ : allowed)) continue;
    badness_ = badness;
    rule_ = rule;
    nodes_ = light.count();
    grid_ = std::move(grid);
    better = true;
  }
  return better;
}

CoarseLight::CoarseLight(const Place& place, const LightBakeOptions& options, SurfaceCache cache, float cell)
    : estimator_(options.estimator),
      cache_(std::move(cache)),
      cell_(cell),
      scene_{place.world, place.space, cache_, place.box},
      light_(scene_, estimator_),
      testing_{.free_points = 250, .seed = ~estimator_.seed, .threads = estimator_.threads},
      best_(test_),
      rays_(cache_.rays()) {
  testing_.rays = scaled(testing_.rays, estimator_.effort);
  if (options.beside == LuminaireSet()) return;
  const EstimatorOptions straight{.seed = estimator_.seed, .contained = options.beside, .reflected = false};
  testing_.beside = &beside_.emplace(scene_, straight);
}

Result<std::unique_ptr<CoarseLight>> CoarseLight::gather(const Place& place, const LightBakeOptions& options,
                                                         const Effort& effort, Progress& progress) {
  LightBakeOptions with_effort = options;
  with_effort.estimator.effort = effort.rays;
  LW_TRY(shapes, place_nodes(place, effort));
  const float cell = max_component(shapes.front().cell) / static_cast<float>(effort.adaptive ? 6 : 3);
  LW_TRY(cache, light_surfaces(place, shapes.front(), cell, with_effort.estimator, progress));
  std::unique_ptr<CoarseLight> coarse(new CoarseLight(place, with_effort, std::move(cache), cell));
  LW_TRY(test, TestPoints::gather(coarse->light_, coarse->testing_, progress));
  coarse->test_ = std::move(test);
  for (const GridShape& shape : shapes) {
    LW_TRY(nodes, light_nodes(coarse->scene_, shape, with_effort, progress));
    coarse->rays_ += nodes.rays;
    AdaptiveLight candidate(coarse->light_, shape, std::move(nodes), options.estimator.threads);
    if (coarse->best_.consider(candidate)) coarse->nodes_.emplace(std::move(candidate));
  }
  return coarse;
}

}  // namespace lightwell
