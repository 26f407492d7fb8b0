// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/light_bake.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>

#include "lightwell/bake/gathered_light.h"
#include "lightwell/bake/light_error.h"
#include "lightwell/bake/light_parts.h"
#include "lightwell/bake/thin_walls.h"
#include "lightwell/base/assert.h"
#include "lightwell/base/parallel.h"
#include "lightwell/light/grid_sum.h"
#include "lightwell/light/stream.h"

namespace lightwell {
namespace {

/// The memory that the threads' sums may take together, bytes; where it does not suffice, fewer threads add up.
constexpr size_t sums_limit = size_t(768) << 20;

/// Nodes on the longest axis of a grid that is to be divided; of a draft, and where there is little room.
constexpr int coarse_nodes = 17, coarsest_nodes = 9;
constexpr size_t little_room = 25'000;  // bytes
/// Of the bytes, for what lies around the focus where something does.
constexpr size_t share_of_surroundings = 8;

using Clock = std::chrono::steady_clock;

int scaled(int count, float share) { return static_cast<int>(std::lround(static_cast<float>(count) * share)); }

/// Of the light that test points are told, as far as that is to be had: what is left is taken out of their error, which
/// cannot tell much smaller ones.
constexpr float most_noise = 0.02f;

/// What one grid may take.
struct Effort {
  int nodes = 0;  ///< on the longest axis, before it is divided
  bool adaptive = false;
  size_t most_bytes = 0;
  /// Of the rays that a bake takes by default: fewer where less is asked for.
  float rays = 1;
  Clock::time_point deadline = Clock::time_point::max();
};

/// What a grid covers: all that there is, the focus of the scene, or what lies around that.
enum class Extent { whole, focus, surroundings };

Effort effort_of(const LightBakeOptions& options, Clock::time_point start, Extent extent) {
  // Three times the error would do with a ninth of the rays; it gets a third, since noise shows before it is measured.
  constexpr float usual_error = 0.01f, least_rays = 0.25f;
  const float rays = options.draft ? least_rays : std::clamp(usual_error / options.target_error, least_rays, 1.0f);
  if (options.nodes > 0) return {.nodes = options.nodes, .rays = rays};
  Effort effort{.nodes = coarse_nodes, .adaptive = true, .most_bytes = options.most_bytes, .rays = rays};
  const size_t of_surroundings = effort.most_bytes / share_of_surroundings;
  if (extent == Extent::focus) effort.most_bytes -= of_surroundings;
  if (extent == Extent::surroundings) effort.most_bytes = of_surroundings;
  if (options.draft || effort.most_bytes < little_room) effort.nodes = coarsest_nodes;
  if (std::isfinite(options.seconds))
    effort.deadline =
        start + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(options.seconds));
  return effort;
}

/// Gives a grid an even number of cells on each axis, as bricks need.
void make_divisible(GridShape& shape) {
  for (int a = 0; a < 3; a++) {
    if (shape.cells()[a] % 2 == 0) continue;
    shape.cell[a] *= static_cast<float>(shape.cells()[a]) / static_cast<float>(shape.nodes[a]);
    shape.nodes[a]++;
  }
}

Result<std::vector<GridShape>> place_nodes(const World& world, const FreeSpace& space, const Box3f& box,
                                           const Effort& effort) {
  std::vector<GridShape> shapes = possible_grids(world, space, box, effort.nodes);
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

/// The light of the surfaces that the nodes see, in cells finer than what is looked up: as large as `cell`, metres.
Result<SurfaceCache> light_surfaces(const World& world, const Box3f& box, const GridShape& shape, float cell,
                                    const EstimatorOptions& options, Progress& progress) {
  std::vector<Vec3f> viewpoints(shape.count());
  for (size_t i = 0; i < viewpoints.size(); i++)
    viewpoints[i] = viewpoint(box, shape.position(shape.node(i)), shape.cell);
  progress.stage("surfaces", 0, "cells");
  SurfaceCacheOptions of_cache{.region = box, .cell = cell, .seed = options.seed, .threads = options.threads};
  of_cache.samples = scaled(of_cache.samples, std::sqrt(options.effort));
  return SurfaceCache::build(world, viewpoints, of_cache, progress);
}

Result<NodeLight> light_nodes(const BakeScene& scene, const GridShape& shape, const LightBakeOptions& options,
                              Progress& progress) {
  const std::unique_ptr<Estimator> estimator = options.method->make(scene, shape, options.estimator);
  LW_TRY(sum, sum_up(*estimator, options.estimator.threads, progress));
  return estimator->finish(*sum);
}

/// The ways to use nodes that see some insides.
constexpr std::array<NodeRule, 8> rules = {
    {{0.25f}, {0.5f}, {0.8f}, {0.95f}, {0.25f, true}, {0.5f, true}, {0.8f, true}, {0.95f, true}}};

/// What a refined grid may err by at most, as a share of what it did before: else its bytes are spared.
constexpr float most_after_refinement = 0.9f;

/// Keeps the grid that errs least of those that it is shown.
class BestGrid {
 public:
  explicit BestGrid(const TestPoints& test) : test_(test) {}

  /// Shows it the ways to use the nodes' light. A node that sees some insides stands near a thin solid, or behind a
  /// sheet: in rooms of sheets it is better left out, among furniture it is better kept.
  /// True when one of them is the best so far, and errs at most by this share of what the best one did.
  bool consider(const AdaptiveLight& light, std::span<const NodeRule> ways = rules, float most = 1) {
    bool better = false;
    const float allowed = most * error_;
    for (const NodeRule& rule : ways) {
      LightGrid grid = light.grid(rule);
      grid.normal_offset = test_.best_offset(grid);
      const float error = test_.badness(grid);
      if (!grid_.moments.empty() && error >= (better ? error_ : allowed)) continue;
      error_ = error;
      rule_ = rule;
      nodes_ = light.count();
      grid_ = std::move(grid);
      better = true;
    }
    return better;
  }

  const NodeRule& rule() const { return rule_; }
  size_t nodes() const { return nodes_; }
  LightGrid take() { return std::move(grid_); }

 private:
  const TestPoints& test_;
  LightGrid grid_;
  float error_ = 0;
  NodeRule rule_;
  size_t nodes_ = 0;
};

/// The part of a scene that grids cover, and where its light is known.
struct Place {
  const World& world;
  const FreeSpace& space;
  Box3f box;
  float cell = 0;  ///< of the light of surfaces, metres
};

/// The light at the nodes of a grid that holds that of all.
Result<LightGrid> light_of_part(const Place& place, const LightGrid& all, const LightPart& part,
                                const LightBakeOptions& options, Progress& progress, uint64_t& rays) {
  const std::unique_ptr<const World> world = place.world.lit_by(part.luminaires);
  LightBakeOptions of_part = options;
  of_part.estimator.contained = part.contained;
  of_part.estimator.reflected = part.reflected;
  LW_TRY(cache, light_surfaces(*world, place.box, all.shape, place.cell, of_part.estimator, progress));
  const BakeScene scene{*world, place.space, cache, place.box};
  LW_TRY(nodes, light_nodes(scene, all.shape, of_part, progress));
  rays += cache.rays() + nodes.rays;
  return AdaptiveLight::relit(all, GatheredLight(scene, of_part.estimator), std::move(nodes), options.estimator.threads,
                              progress);
}

/// The same grid in the light of each part. `all` becomes their sum, which is what is looked up in the end.
Result<std::vector<BakedGrid>> light_by_parts(const Place& place, LightGrid& all, const LightBakeOptions& options,
                                              Progress& progress, uint64_t& rays) {
  const std::vector<LightPart> parts =
      light_parts(place.world, options.estimator.contained, options.groups, options.sky_apart);
  std::vector<BakedGrid> grids;
  if (parts.size() == 1) {
    grids.push_back({.grid = all, .contains = contents_of(parts.front(), place.world)});
    return grids;
  }
  for (const LightPart& part : parts) {
    LW_TRY(grid, light_of_part(place, all, part, options, progress, rays));
    grids.push_back({.grid = std::move(grid), .contains = contents_of(part, place.world)});
  }
  all = grids.front().grid;
  for (size_t i = 1; i < grids.size(); i++) add_light(all, grids[i].grid);
  return grids;
}

/// Bakes the grids over a box; adds to the statistics.
Result<std::vector<BakedGrid>> bake_box(const World& world, const FreeSpace& space, const Box3f& box,
                                        LightBakeOptions options, const Effort& effort, Progress& progress,
                                        LightBakeStatistics& statistics) {
  options.estimator.effort = effort.rays;
  const EstimatorOptions& estimator = options.estimator;
  LW_TRY(shapes, place_nodes(world, space, box, effort));
  const float cell = max_component(shapes.front().cell) / static_cast<float>(effort.adaptive ? 6 : 3);
  LW_TRY(cache, light_surfaces(world, box, shapes.front(), cell, estimator, progress));
  const BakeScene scene{world, space, cache, box};
  const GatheredLight light(scene, estimator);
  TestPointOptions testing{.free_points = 250, .seed = ~estimator.seed, .threads = estimator.threads};
  testing.rays = scaled(testing.rays, effort.rays);
  LW_TRY(test, TestPoints::gather(light, testing, progress));

  statistics.rays += cache.rays();
  BestGrid best(test);
  std::optional<AdaptiveLight> chosen;
  for (const GridShape& shape : shapes) {
    LW_TRY(nodes, light_nodes(scene, shape, options, progress));
    statistics.rays += nodes.rays;
    AdaptiveLight candidate(light, shape, std::move(nodes), estimator.threads);
    if (best.consider(candidate)) chosen.emplace(std::move(candidate));
  }
  if (effort.adaptive) {
    // Points of their own: what the grid was fitted to would tell nothing of its error.
    TestPointOptions fitting = testing;
    fitting.surface_points = static_cast<size_t>(scaled(16'000, std::sqrt(effort.rays)));
    fitting.free_points = static_cast<size_t>(scaled(1000, std::sqrt(effort.rays)));
    fitting.rays /= 8;
    fitting.near = 8;
    fitting.seed ^= 0xb71c;
    LW_TRY(fit, TestPoints::gather(light, fitting, progress));
    const uint64_t before = chosen->rays();
    const size_t unrefined = chosen->count();
    const RefinementOptions refinement{options.target_error, effort.most_bytes, best.rule(), effort.deadline};
    LW_TRY(refined, chosen->refine(fit, refinement, progress));
    statistics.rays += chosen->rays() - before;
    // Its stream is within the bytes by this rule, and they are to pay.
    const bool pays = best.consider(*chosen, std::array{refined.rule}, most_after_refinement);
    if (!statistics.refinement)
      statistics.refinement = pays || chosen->count() == unrefined ? refined.end : Refinement::to_no_gain;
  }
  statistics.nodes += best.nodes();
  LightGrid all = best.take();
  LW_TRY(grids, light_by_parts({world, space, box, cell}, all, options, progress, statistics.rays));
  // Points that had no say in what was chosen, and that know what is near them without the cache's blur.
  TestPointOptions judging = testing;
  judging.seed ^= 0x0dd5;
  judging.near = 8;
  judging.rays /= 2;
  judging.most_noise = most_noise;
  LW_TRY(judge, TestPoints::gather(light, judging, progress));
  const float error = judge.error(all);
  const ErrorEstimate estimate = judge.errors(all);
  for (BakedGrid& baked : grids) {
    baked.estimated_error = error;
    baked.estimate = estimate;
  }
  statistics.invalid_nodes += static_cast<size_t>(std::count(all.valid.begin(), all.valid.end(), 0));
  return grids;
}

}  // namespace

std::vector<LightField::Layer> layers_of(std::vector<BakedGrid> grids) {
  std::vector<LightField::Layer> layers;
  for (BakedGrid& baked : grids) layers.push_back({std::move(baked.grid), std::move(baked.contains), baked.priority});
  return layers;
}

Result<std::vector<BakedGrid>> bake_light(const World& world, const LightBakeOptions& options, Progress& progress,
                                          LightBakeStatistics& statistics) {
  LW_ASSERT((options.nodes == 0 || options.nodes >= 2) && options.estimator.photons >= 2);
  if (world.lights().dark()) {
    return fail("",
                "nothing shines: the scene has no emissive material, no lamp and no environment; "
                "--environment 1,1,1 lights it from all around");
  }
  const Clock::time_point start = Clock::now();
  if (options.nodes == 0 && !options.method->node_by_node)
    return fail(ErrorKind::unsupported, "grid",
                "--method " + std::string(options.method->name) + " fills regular grids only: give --grid N");
  progress.stage("free space", 0, "photons");
  SurveyOptions survey{.seed = options.estimator.seed, .threads = options.estimator.threads};
  survey.most_photons = std::min(survey.most_photons, options.estimator.photons);
  LW_TRY(space, FreeSpace::survey(world, survey, progress));

  std::vector<Box3f> boxes{world.surfaces().focus()};
  if (boxes.front() != world.surfaces().bounds()) boxes.push_back(world.surfaces().bounds());
  std::vector<BakedGrid> grids;
  for (const Box3f& box : boxes) {
    const Extent extent = boxes.size() == 1 ? Extent::whole : grids.empty() ? Extent::focus : Extent::surroundings;
    const Effort effort = effort_of(options, start, extent);
    LW_TRY(baked, bake_box(world, space, box, options, effort, progress, statistics));
    for (BakedGrid& grid : baked) {
      grid.priority = static_cast<int>(&boxes.back() - &box);
      grids.push_back(std::move(grid));
    }
  }
  statistics.estimated_error = grids.front().estimated_error;
  statistics.estimate = grids.front().estimate;
  statistics.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return grids;
}

}  // namespace lightwell
