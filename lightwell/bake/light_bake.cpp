// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/light_bake.h"

#include <algorithm>
#include <cmath>

#include "lightwell/bake/coarse_light.h"
#include "lightwell/bake/light_parts.h"
#include "lightwell/base/assert.h"
#include "lightwell/light/grid_sum.h"

namespace lightwell {
namespace {

constexpr size_t little_room = 25'000;  // bytes: so few are for a coarser grid
/// Of the bytes and the time, for what lies around the focus where something does.
constexpr int share_of_surroundings = 8;

using Clock = std::chrono::steady_clock;

/// Of the light that test points are told, as far as that is to be had: what is left is taken out of their error, which
/// cannot tell much smaller ones.
constexpr float most_noise = 0.02f;

/// What a grid covers: all that there is, the focus of the scene, or what lies around that.
enum class Extent { whole, focus, surroundings };

/// When a grid's cells are to be divided no further, for all to be done by `end`: its light is gathered `again` so many
/// times, which takes as long each time.
Clock::time_point deadline_of(Clock::time_point end, int again, Extent extent) {
  const Clock::time_point now = Clock::now();
  Clock::duration left = end - now;
  if (extent == Extent::focus) left -= left / share_of_surroundings;
  return now + left / (1 + again);
}

/// Options of the grid that is divided, whose nodes all parts have: a sky apart is found by the client beside it, more
/// finely than by any grid, but for the surroundings, where grids go on to show it. Its own grid takes the other half
/// of the bytes.
LightBakeOptions of_divided(const LightBakeOptions& options, const World& world, Extent extent) {
  LightBakeOptions divided = options;
  const int sky = world.lights().environment_luminaire();
  if (options.sky_apart != SkyApart::always || !options.estimator.contained.contains(sky)) return divided;
  divided.most_bytes /= 2;
  if (extent == Extent::surroundings) return divided;
  divided.estimator.contained.erase(sky);
  divided.beside.insert(sky);
  return divided;
}

/// What a grid over an extent may take. `start`: of the whole bake; `again`: as often its light is gathered.
Effort effort_of(const LightBakeOptions& options, Clock::time_point start, int again, Extent extent) {
  // Three times the error would do with a ninth of the rays; it gets a third, since noise shows before it is measured.
  constexpr float usual_error = 0.01f;
  const float rays = options.draft ? least_rays : std::clamp(usual_error / options.target_error, least_rays, 1.0f);
  if (options.nodes > 0) return {.nodes = options.nodes, .rays = rays};
  Effort effort{.nodes = coarse_nodes, .adaptive = true, .most_bytes = options.most_bytes, .rays = rays};
  const size_t of_surroundings = effort.most_bytes / share_of_surroundings;
  if (extent == Extent::focus) effort.most_bytes -= of_surroundings;
  if (extent == Extent::surroundings) effort.most_bytes = of_surroundings;
  if (options.draft || effort.most_bytes < little_room) effort.nodes = coarsest_nodes;
  if (std::isfinite(options.seconds)) {
    const auto limit = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(options.seconds));
    effort.deadline = deadline_of(start + limit, again, extent);
  }
  return effort;
}

/// What a refined grid may err by at most, as a share of what it did before: else its bytes are spared.
constexpr float most_after_refinement = 0.9f;

/// The grid `all` in other light.
Result<LightGrid> relit(const LightGrid& all, const BakeScene& scene, const LightBakeOptions& options,
                        Progress& progress, uint64_t& rays) {
  LW_TRY(nodes, light_nodes(scene, all.shape, options, progress));
  rays += nodes.rays;
  return AdaptiveLight::relit(all, GatheredLight(scene, options.estimator), std::move(nodes), options.estimator.threads,
                              progress);
}

/// The grid `all` in the light of a part, which alone lights a world of its own. What comes straight from the sky needs
/// no light of surfaces: none is asked for.
Result<LightGrid> light_of_part(const Place& place, const CoarseLight& coarse, const LightGrid& all,
                                const LightPart& part, const LightBakeOptions& options, Progress& progress,
                                uint64_t& rays) {
  LightBakeOptions of_part = options;
  of_part.estimator.contained = part.contained;
  of_part.estimator.reflected = part.reflected;
  const std::unique_ptr<const World> world = place.world.lit_by(part.luminaires);
  if (!part.reflected)
    return relit(all, {*world, place.space, coarse.scene().cache, place.box}, of_part, progress, rays);
  LW_TRY(cache,
         light_surfaces({*world, place.space, place.box}, all.shape, coarse.cell(), of_part.estimator, progress));
  rays += cache.rays();
  return relit(all, {*world, place.space, cache, place.box}, of_part, progress, rays);
}

/// How often the light of all nodes is gathered again: for each of several parts, but what is divided holds all that is
/// reflected.
int gathered_again(std::span<const LightPart> parts, const LightBakeOptions& options) {
  const int count = static_cast<int>(parts.size());
  return options.groups.size() > 1 ? count : count - 1;
}

/// The same grid in the light of each part. `all`, which holds all light or all but the sky's `beside` it, becomes the
/// sum of the parts that do.
Result<std::vector<BakedGrid>> light_by_parts(const Place& place, const CoarseLight& coarse, LightGrid& all,
                                              const LightBakeOptions& options, bool beside, Progress& progress,
                                              uint64_t& rays) {
  const std::vector<LightPart> parts =
      light_parts(place.world, options.estimator.contained, options.groups, options.sky_apart == SkyApart::always);
  std::vector<BakedGrid> grids;
  const bool is_a_part = options.groups.size() <= 1 && (beside || parts.size() == 1);
  for (const LightPart& part : parts) {
    if (is_a_part && part.reflected) {
      grids.push_back({.grid = all, .contains = contents_of(part, place.world)});
      continue;
    }
    LW_TRY(grid, light_of_part(place, coarse, all, part, options, progress, rays));
    grids.push_back({.grid = std::move(grid), .contains = contents_of(part, place.world)});
  }
  if (is_a_part) return grids;
  all = grids.front().grid;
  for (size_t i = 1; i < grids.size(); i++)
    if (parts[i].reflected || !beside) add_light(all, grids[i].grid);
  return grids;
}

/// The coarse light that there is time for: where it is short that of a draft, by which it is told; `effort` becomes
/// what was taken.
Result<std::unique_ptr<CoarseLight>> affordable_light(const Place& place, const LightBakeOptions& options,
                                                      Effort& effort, Progress& progress, uint64_t& rays) {
  // As long takes a whole bake that is hardly refined, measured on sponza (docs/decisions/034-time-and-target.md).
  constexpr int drafts_of_a_whole = 12;
  if (effort.deadline == Clock::time_point::max() || effort.draft())
    return CoarseLight::gather(place, options, effort, progress);
  const Effort draft = effort.as_draft();
  const Clock::time_point start = Clock::now();
  LW_TRY(first, CoarseLight::gather(place, options, draft, progress));
  const Clock::time_point now = Clock::now();
  if (now + drafts_of_a_whole * (now - start) <= effort.deadline) {
    rays += first->rays();
    return CoarseLight::gather(place, options, effort, progress);
  }
  effort = draft;
  return std::move(first);
}

/// Points that had no say in what a grid is like, and that know what is near them without the cache's blur. Where time
/// is short they may take a fifth of it.
Result<TestPoints> judges(const CoarseLight& coarse, const Effort& effort, Progress& progress) {
  TestPointOptions judging = coarse.testing();
  judging.seed ^= 0x0dd5;
  judging.near = 8;
  judging.rays /= 2;
  judging.most_noise = most_noise;
  const Clock::time_point now = Clock::now();
  if (effort.deadline != Clock::time_point::max()) judging.deadline = now + (effort.deadline - now) / 5;
  return TestPoints::gather(coarse.light(), judging, progress);
}

/// Divides the cells of the coarse grid until `judge` is content.
Result<void> refine(CoarseLight& coarse, const TestPoints& judge, const LightBakeOptions& options, const Effort& effort,
                    bool must_reach, Progress& progress, LightBakeStatistics& statistics) {
  // Points of their own: what the grid was fitted to would tell nothing of its error.
  TestPointOptions fitting = coarse.testing();
  fitting.surface_points = static_cast<size_t>(scaled(16'000, std::sqrt(effort.rays)));
  fitting.free_points = static_cast<size_t>(scaled(1000, std::sqrt(effort.rays)));
  fitting.rays /= 8;
  fitting.near = 8;
  fitting.seed ^= 0xb71c;
  LW_TRY(fit, TestPoints::gather(coarse.light(), fitting, progress));
  AdaptiveLight& nodes = coarse.nodes();
  const uint64_t before = nodes.rays();
  const size_t unrefined = nodes.count();
  const RefinementOptions refinement{options.target_error, effort.most_bytes, coarse.best().rule(), effort.deadline,
                                     must_reach};
  LW_TRY(refined, nodes.refine(fit, judge, refinement, progress));
  statistics.rays += nodes.rays() - before;
  // Its stream is within the bytes by this rule, and they are to pay.
  const float most = refined.end == Refinement::to_target ? 1 : most_after_refinement;
  const bool pays = coarse.best().consider(nodes, std::array{refined.rule}, most);
  const bool could_go_on = refined.end == Refinement::to_deadline;
  if (!statistics.refinement)
    statistics.refinement = pays || could_go_on || nodes.count() == unrefined ? refined.end : Refinement::to_no_gain;
  return {};
}

/// Grids, or none where they were to come to the target error and did not, but to another one.
struct Baked {
  std::vector<BakedGrid> grids;
  float missed = 0;
};

/// Bakes the grids over a box; adds to the statistics.
Result<Baked> bake_box(const Place& place, LightBakeOptions options, const LightBakeOptions& divided, Effort effort,
                       bool must_reach, Progress& progress, LightBakeStatistics& statistics) {
  LW_TRY(coarse, affordable_light(place, divided, effort, progress, statistics.rays));
  options.estimator.effort = effort.rays;
  statistics.rays += coarse->rays();
  LW_TRY(judge, judges(*coarse, effort, progress));
  if (effort.adaptive) LW_CHECK(refine(*coarse, judge, options, effort, must_reach, progress, statistics));
  statistics.nodes += coarse->best().nodes();
  LightGrid all = coarse->best().take();
  if (must_reach) {
    const float error = judge.error(all);
    if (error > options.target_error) return Baked{.grids = {}, .missed = error};
  }
  LW_TRY(grids,
         light_by_parts(place, *coarse, all, options, divided.beside != LuminaireSet(), progress, statistics.rays));
  for (BakedGrid& baked : grids) {
    baked.estimated_error = judge.error(all);
    baked.estimate = judge.errors(all);
    baked.dark = judge.dark();
  }
  statistics.invalid_nodes += static_cast<size_t>(std::count(all.valid.begin(), all.valid.end(), 0));
  return Baked{.grids = std::move(grids)};
}

/// Bakes the grids of a scene, over what it is about and, where that is not all, over the rest. The former alone
/// may miss the target.
Result<Baked> bake_boxes(const World& world, const FreeSpace& space, const LightBakeOptions& options,
                         Clock::time_point start, bool must_reach, Progress& progress,
                         LightBakeStatistics& statistics) {
  std::vector<Box3f> boxes{world.surfaces().focus()};
  if (boxes.front() != world.surfaces().bounds()) boxes.push_back(world.surfaces().bounds());
  const int again = gathered_again(
      light_parts(world, options.estimator.contained, options.groups, options.sky_apart == SkyApart::always), options);
  Baked all;
  for (const Box3f& box : boxes) {
    const Extent extent = boxes.size() == 1 ? Extent::whole : all.grids.empty() ? Extent::focus : Extent::surroundings;
    const LightBakeOptions divided = of_divided(options, world, extent);
    const Effort effort = effort_of(divided, start, again, extent);
    const bool must = must_reach && extent != Extent::surroundings;
    LW_TRY(baked, bake_box({world, space, box}, options, divided, effort, must, progress, statistics));
    if (baked.grids.empty()) return baked;
    for (BakedGrid& grid : baked.grids) {
      grid.priority = static_cast<int>(&boxes.back() - &box);
      all.grids.push_back(std::move(grid));
    }
  }
  return all;
}

/// Bakes one grid of all light or, where that would miss the target, the sky's own apart, if that errs by less.
Result<Baked> bake_as_needed(const World& world, const FreeSpace& space, LightBakeOptions options,
                             Clock::time_point start, Progress& progress, LightBakeStatistics& statistics) {
  options.sky_apart = SkyApart::never;
  LW_TRY(together, bake_boxes(world, space, options, start, true, progress, statistics));
  if (!together.grids.empty()) return together;
  uint64_t rays = statistics.rays;
  const auto bake = [&](SkyApart sky_apart) {
    options.sky_apart = sky_apart;
    statistics = LightBakeStatistics();
    auto baked = bake_boxes(world, space, options, start, false, progress, statistics);
    statistics.rays = rays += statistics.rays;
    return baked;
  };
  LW_TRY(apart, bake(SkyApart::always));
  // The rest of the light may be what errs: then it is better off with all of the bytes.
  const bool pays = apart.grids.front().estimated_error <= most_after_refinement * together.missed;
  return pays ? std::move(apart) : bake(SkyApart::never);
}

/// Whether it is to be found out where the sky's light is to be.
bool asks_for_need(const World& world, const LightBakeOptions& options) {
  const bool has_target = options.nodes == 0 && !options.draft && !std::isfinite(options.seconds);
  const bool has_sky = options.estimator.contained.contains(world.lights().environment_luminaire());
  return options.sky_apart == SkyApart::as_needed && has_target && has_sky;
}

}  // namespace

std::vector<LightField::Layer> layers_of(std::vector<BakedGrid> grids) {
  std::vector<LightField::Layer> layers;
  for (BakedGrid& baked : grids) layers.push_back({std::move(baked.grid), std::move(baked.contains), baked.priority});
  return layers;
}

Result<std::vector<BakedGrid>> bake_light(const World& world, const LightBakeOptions& options, Progress& progress,
                                          LightBakeStatistics& statistics) {
  LW_ASSERT((options.nodes == 0 || options.nodes >= 2) && options.estimator.photons >= 1);
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

  LW_TRY(baked, asks_for_need(world, options) ? bake_as_needed(world, space, options, start, progress, statistics)
                                              : bake_boxes(world, space, options, start, false, progress, statistics));
  std::vector<BakedGrid>& grids = baked.grids;
  statistics.estimated_error = grids.front().estimated_error;
  statistics.estimate = grids.front().estimate;
  statistics.dark = grids.front().dark;
  statistics.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return std::move(grids);
}

}  // namespace lightwell
