// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/adaptive_light.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "lightwell/base/parallel.h"
#include "lightwell/light/lattice_order.h"
#include "lightwell/light/lattice_stream.h"

namespace lightwell {
namespace {

using Clock = std::chrono::steady_clock;

/// Rounds of dividing, each by what the one before has left; and the finest level.
constexpr int rounds = 6;
constexpr int finest_level = 3;
/// What errs by more than so many times the target after so many rounds, with a third of the bytes, does not come to it
/// (docs/decisions/041-the-sky-as-a-lamp.md).
constexpr int rounds_of_promise = 2;
constexpr float most_of_promise = 2;
/// What a brick adds to the stream, bytes, until it is known of this grid.
constexpr size_t likely_brick_bytes = 300;
/// Sets of rays from a node of a brick: fewer than from the grid's own, since what is left of the noise is told from
/// what the light does.
constexpr int sets_a_node = 4;

/// A node that sees a greater share of insides stands in a solid, as far as walls between nodes are concerned.
constexpr float most_insides = 0.25f;

uint64_t key_of(const Brick& brick, int point) { return lattice_place(brick.level, brick.corner(point)); }

/// The brick that would divide the cells at a place; nothing where they are as fine as they may be.
std::optional<Brick> dividing(const BrickTree& tree, const Vec3f& place) {
  const auto finest = tree.finest(place);
  Brick brick{.level = finest ? tree.bricks()[*finest].level + 1 : 1, .at = {}};
  if (brick.level > finest_level) return std::nullopt;
  const float bricks_a_cell = std::ldexp(1.0f, brick.level) / Brick::cells;
  for (int a = 0; a < 3; a++) {
    const int last = (tree.cells()[a] << brick.level) / Brick::cells - 1;
    brick.at[a] = std::clamp(static_cast<int>(place[a] * bricks_a_cell), 0, last);
  }
  return brick;
}

/// Takes the noise of a node for what it is: it is moved towards the mean of those beside it between which it lies, all
/// the way where it differs by less than the noise of both, little where it differs by much more (the shrinkage of
/// wavelet coefficients: Donoho and Johnstone, Adapting to Unknown Smoothness, JASA 1995, in the form of James and
/// Stein).
class Quietened {
 public:
  /// Two opposite ones: one alone would take every slope for noise.
  void add_between(const Moments& a, const Moments& b) {
    sum_ += a;
    sum_ += b;
    count_ += 2;
  }
  /// `noise` as in NodeSurroundings.
  Moments of(const Moments& moments, float noise) const {
    if (count_ == 0) return moments;
    Moments difference = sum_ * (1 / static_cast<float>(count_));
    difference += moments * -1;
    const float size = size_of(difference), own = noise * size_of(moments);
    if (!(size > 0)) return moments;
    difference = difference * std::min(1.0f, 2 * own * own / (size * size));
    difference += moments;
    return difference;
  }

 private:
  Moments sum_;
  int count_ = 0;
};

/// Quietens the grid's own valid nodes, from coarse to fine.
void quieten(LightGrid& grid, const std::vector<float>& noise) {
  if (noise.empty()) return;
  for (const LatticeNode& place : lattice_order(grid.shape.nodes)) {
    if (!grid.valid[place.node]) continue;
    Quietened quietened;
    for (size_t i = 0; i + 1 < place.parent_count; i += 2) {
      const uint32_t a = place.parents[i], b = place.parents[i + 1];
      if (grid.valid[a] && grid.valid[b]) quietened.add_between(grid.moments[a], grid.moments[b]);
    }
    grid.moments[place.node] = quietened.of(grid.moments[place.node], noise[place.node]);
  }
}

using PointNoise = std::array<float, Brick::points>;

/// The same for the finer points of a brick.
void quieten(BrickPoints& points, const PointNoise& noise, const std::vector<int>& finer) {
  for (const int point : finer) {
    BrickPoint& light = points[static_cast<size_t>(point)];
    if (light.weight <= node_weight(false)) continue;
    const Vec3i local = Brick::local(point);
    Quietened quietened;
    for (int axis = 0; axis < 3; axis++) {
      if (local[axis] % 2 == 0) continue;
      const auto beside = [&](int step) {
        Vec3i place = local;
        place[axis] += step;
        return points[static_cast<size_t>(Brick::point(place))];
      };
      const BrickPoint below = beside(-1), above = beside(1);
      if (below.weight > node_weight(false) && above.weight > node_weight(false))
        quietened.add_between(below.moments, above.moments);
    }
    light.moments = quietened.of(light.moments, noise[static_cast<size_t>(point)]);
  }
}

/// The noise of many nodes together, those of bricks as those of the grid.
class NoiseOfAll {
 public:
  /// `noise` as in NodeSurroundings.
  void add(const Moments& moments, float noise) {
    const double size = static_cast<double>(size_of(moments));
    squares_ += size * size * static_cast<double>(noise * noise);
    sizes_ += size * size;
  }
  float relative() const { return sizes_ > 0 ? static_cast<float>(std::sqrt(squares_ / sizes_)) : 0; }

 private:
  double squares_ = 0, sizes_ = 0;
};

/// Of a bundle in a file: its row in the table of blocks, and its check.
constexpr size_t bytes_of_a_block = 16;

size_t stream_bytes(const LightGrid& grid) {
  const auto stream = encode_lattice(grid);
  if (!stream) return std::numeric_limits<size_t>::max();
  ByteWriter parameters;
  stream->layout.write(parameters);
  size_t bytes = parameters.size();
  const auto add = [&](const std::vector<LightBundle>& bundles) {
    for (const LightBundle& bundle : bundles) bytes += bundle.payload.size() + bytes_of_a_block;
  };
  add(stream->bundles);
  std::ranges::for_each(stream->regions, add);
  return bytes;
}

}  // namespace

AdaptiveLight::AdaptiveLight(const GatheredLight& light, const GridShape& shape, NodeLight nodes, int threads)
    : light_(light),
      shape_(shape),
      nodes_(std::move(nodes)),
      threads_(threads),
      tree_(shape.cells()),
      brick_nodes_(tree_),
      sides_(light.world().surfaces(), light.box()),
      links_(light.world().surfaces(), light.box()) {
  sides_.follow(shape_, tree_, threads_);
  follow_links();
}

void AdaptiveLight::follow_links() {
  links_.follow(shape_, tree_, threads_);
  // A lookup on a wall reaches the node behind it where it reaches the one before it, though none of those that were
  // followed may have done so. What stands within the wall is no node before it.
  behind_.clear();
  std::unordered_set<uint64_t> inside;
  for (size_t node = 0; node < nodes_.insides.size(); node++)
    if (nodes_.insides[node] > most_insides) inside.insert(lattice_place(0, shape_.node(node)));
  for (const auto& [place, node] : gathered_)
    if (node.insides > most_insides) inside.insert(place);
  const auto reached = [&](uint64_t place) { return sides_.balance(place) > 0; };
  const auto hides = [&](uint64_t front, uint64_t back) {
    return reached(front) && !reached(back) && !inside.contains(front);
  };
  links_.for_each_blocked(shape_, tree_, [&](uint64_t a, uint64_t b) {
    if (hides(a, b)) behind_.insert(b);
    if (hides(b, a)) behind_.insert(a);
  });
}

bool AdaptiveLight::valid(const NodeRule& rule, float insides, int level, const Vec3i& corner) const {
  if (insides > rule.most_insides) return false;
  const uint64_t place = lattice_place(level, corner);
  return !rule.by_lookups || !(sides_.across(place) || behind_.contains(place));
}

LightGrid AdaptiveLight::grid(const NodeRule& rule) const {
  LightGrid grid;
  grid.shape = shape_;
  grid.moments = nodes_.moments;
  NoiseOfAll noise_of_all;
  for (size_t node = 0; node < nodes_.insides.size(); node++) {
    grid.valid.push_back(valid(rule, nodes_.insides[node], 0, shape_.node(node)));
    if (!grid.valid.back()) grid.moments[node] = {};
    if (!nodes_.noise.empty()) noise_of_all.add(grid.moments[node], nodes_.noise[node]);
  }
  quieten(grid, nodes_.noise);
  fill_invalid(grid);
  grid.tree = tree_;
  grid.bricks.resize(tree_.bricks().size());
  const std::vector<int> finer = finer_points();
  for (uint32_t brick = 0; brick < grid.bricks.size(); brick++) {
    BrickPoints nodes;
    PointNoise noise{};
    for (const int point : finer) {
      if (brick_nodes_.at(brick, point) == BrickNodes::none) continue;
      const Node& node = gathered_.at(key_of(tree_.bricks()[brick], point));
      const Brick& cube = tree_.bricks()[brick];
      const bool used = valid(rule, node.insides, cube.level, cube.corner(point));
      nodes[static_cast<size_t>(point)] = {used ? node.moments : Moments{}, node_weight(used)};
      noise[static_cast<size_t>(point)] = node.noise;
      if (used) noise_of_all.add(node.moments, node.noise);
    }
    place_brick(grid, brick, nodes);
    quieten(grid.bricks[brick], noise, finer);
    fill_invalid(grid.bricks[brick], shape_.cell);
  }
  grid.links = links_.of(grid);
  grid.noise = noise_of_all.relative();
  return grid;
}

Result<LightGrid> AdaptiveLight::relit(const LightGrid& like, const GatheredLight& light, NodeLight nodes, int threads,
                                       Progress& progress) {
  const auto insides_of = [](float weight) { return weight > node_weight(false) ? 0.0f : 1.0f; };
  for (size_t node = 0; node < like.valid.size(); node++)
    nodes.insides[node] = insides_of(node_weight(like.valid[node]));
  AdaptiveLight relit(light, like.shape, std::move(nodes), threads);
  LW_CHECK(relit.divide(like.tree.bricks(), progress));
  for (const BrickNode& node : relit.brick_nodes_.nodes())
    relit.gathered_.at(key_of(relit.tree_.bricks()[node.brick], node.point)).insides =
        insides_of(like.bricks[node.brick][static_cast<size_t>(node.point)].weight);
  LightGrid grid = relit.grid({.most_insides = 0.5f});
  grid.normal_offset = like.normal_offset;
  return grid;
}

Result<void> AdaptiveLight::divide(std::span<const Brick> bricks, Progress& progress) {
  for (const Brick& brick : bricks) tree_.add(brick);
  brick_nodes_ = BrickNodes(tree_);
  sides_.follow(shape_, tree_, threads_);
  std::vector<BrickNode> missing;
  for (const BrickNode& node : brick_nodes_.nodes())
    if (!gathered_.contains(key_of(tree_.bricks()[node.brick], node.point))) missing.push_back(node);
  std::vector<NodeSurroundings> found(missing.size());
  parallel_for(
      missing.size(), 16, threads_,
      [&](size_t begin, size_t end, int) {
        for (size_t i = begin; i < end; i++) {
          const Brick& brick = tree_.bricks()[missing[i].brick];
          const Vec3f cell = shape_.cell * std::ldexp(1.0f, -brick.level);
          const Vec3f position = shape_.lo + cell * brick.corner(missing[i].point).cast<float>();
          const Facings facings = sides_.facings(key_of(brick, missing[i].point));
          found[i] = light_.at_node(position, cell, facings, sets_a_node);
        }
      },
      [&] { return progress.cancelled(); });
  if (progress.cancelled()) return fail(ErrorKind::cancelled, "light", "cancelled");
  for (size_t i = 0; i < missing.size(); i++) {
    gathered_[key_of(tree_.bricks()[missing[i].brick], missing[i].point)] = {found[i].moments, found[i].insides,
                                                                             found[i].noise};
    nodes_.rays += found[i].rays;
  }
  follow_links();
  return {};
}

/// Divides as many as there is time for, a few first to learn how long they take.
Result<void> AdaptiveLight::divide_until(std::span<const Brick> bricks, const RefinementOptions& options,
                                         Progress& progress) {
  if (options.deadline == Clock::time_point::max()) return divide(bricks, progress);
  size_t piece = 64;
  while (!bricks.empty() && Clock::now() < options.deadline) {
    piece = std::min(piece, bricks.size());
    const Clock::time_point start = Clock::now();
    LW_CHECK(divide(bricks.first(piece), progress));
    bricks = bricks.subspan(piece);
    const auto took = std::max<Clock::duration>(Clock::now() - start, std::chrono::milliseconds(1));
    const auto pieces_left = std::max<Clock::rep>((options.deadline - Clock::now()) / took, 0);
    piece *= std::clamp<size_t>(static_cast<size_t>(pieces_left), 1, 4);
  }
  return {};
}

/// The bricks that could be added where the grid errs most, summed over the points in each.
std::vector<Brick> AdaptiveLight::worst_bricks(const TestPoints& points, const LightGrid& grid, size_t count) const {
  struct Candidate {
    Brick brick;
    double error = 0;
  };
  std::map<std::array<int, 4>, Candidate> candidates;  // in an order that does not depend on the points'
  for (const TestPoints::Excess& excess : points.excess(grid)) {
    const auto brick = excess.error > 0 ? dividing(tree_, shape_.place_of(excess.position)) : std::nullopt;
    if (!brick) continue;
    Candidate& candidate = candidates[{brick->level, brick->at[0], brick->at[1], brick->at[2]}];
    candidate.brick = *brick;
    candidate.error += static_cast<double>(excess.error);
  }
  std::vector<Candidate> worst;
  for (const auto& [place, candidate] : candidates) worst.push_back(candidate);
  std::stable_sort(worst.begin(), worst.end(),
                   [](const Candidate& a, const Candidate& b) { return a.error > b.error; });
  std::vector<Brick> bricks;
  for (size_t i = 0; i < std::min(count, worst.size()); i++) bricks.push_back(worst[i].brick);
  return bricks;
}

/// Takes back the newest bricks until the stream is no longer than it may be.
void AdaptiveLight::keep_within(const RefinementOptions& options, const NodeRule& rule) {
  for (;;) {
    const size_t bytes = stream_bytes(grid(rule)), bricks = tree_.bricks().size();
    if (bytes <= options.most_bytes || bricks == 0) return;
    const size_t too_many = 1 + bricks * (bytes - options.most_bytes) / bytes;
    BrickTree fewer(tree_.cells());
    for (const Brick& brick : tree_.bricks().first(bricks - std::min(bricks, too_many))) fewer.add(brick);
    tree_ = std::move(fewer);
    brick_nodes_ = BrickNodes(tree_);
  }
}

/// The grid by a rule, or by what lookups say against it or no longer say, whichever errs less.
LightGrid AdaptiveLight::best_grid(const TestPoints& points, NodeRule& rule) const {
  const auto by = [&](const NodeRule& way) {
    LightGrid grid = this->grid(way);
    grid.normal_offset = points.best_offset(grid);
    return grid;
  };
  const NodeRule other{rule.most_insides, !rule.by_lookups};
  LightGrid grid = by(rule), another = by(other);
  if (points.badness(another) >= points.badness(grid)) return grid;
  rule = other;
  return another;
}

Result<Refined> AdaptiveLight::refine(const TestPoints& points, const TestPoints& judge,
                                      const RefinementOptions& options, Progress& progress) {
  NodeRule rule = options.rule;
  const size_t coarse = stream_bytes(grid(rule));
  const size_t addable = options.most_bytes - std::min(coarse, options.most_bytes);
  progress.stage("finer light", static_cast<double>(options.most_bytes), "bytes");
  Refinement end = Refinement::to_budget;
  for (int round = 1;; round++) {
    const LightGrid grid = best_grid(points, rule);
    const float error = judge.error(grid);
    if (error <= options.target_error) {
      end = Refinement::to_target;
      break;
    }
    if (options.must_reach && round > rounds_of_promise && error > most_of_promise * options.target_error) break;
    if (Clock::now() >= options.deadline) {
      end = Refinement::to_deadline;
      break;
    }
    if (round > rounds) break;
    const size_t bytes = stream_bytes(grid), bricks = tree_.bricks().size();
    const size_t allowed = coarse + addable * static_cast<size_t>(round) / rounds;
    progress.advance(static_cast<double>(bytes));
    if (allowed <= bytes) continue;
    const size_t brick_bytes = bricks > 0 ? std::max<size_t>(1, (bytes - coarse) / bricks) : likely_brick_bytes;
    const std::vector<Brick> worst = worst_bricks(points, grid, (allowed - bytes + brick_bytes - 1) / brick_bytes);
    if (worst.empty()) {
      end = Refinement::to_finest;
      break;
    }
    LW_CHECK(divide_until(worst, options, progress));
  }
  keep_within(options, rule);
  return Refined{end, rule};
}

}  // namespace lightwell
