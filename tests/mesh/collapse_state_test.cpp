// SPDX-License-Identifier: Apache-2.0
#include "lightwell/mesh/collapse_state.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "tests/mesh/shapes.h"

namespace lightwell {
namespace {

/// The faces of a mesh under collapse as a list that is searched from end to end.
class PlainFaces {
 public:
  PlainFaces(const QuantizedMesh& mesh, const Points& points) {
    std::set<Face> seen;
    for (const Face& f : mesh.faces) {
      Face p{points.of[f[0]], points.of[f[1]], points.of[f[2]]};
      const bool degenerate = p[0] == p[1] || p[1] == p[2] || p[2] == p[0];
      faces_.push_back(p);
      std::rotate(p.begin(), std::min_element(p.begin(), p.end()), p.end());
      loose_.push_back(degenerate || !seen.insert(p).second);
      vanished_with_.push_back(no_vertex);
    }
  }

  bool loose(size_t face) const { return loose_[face]; }
  bool alive(size_t face) const { return !loose_[face] && vanished_with_[face] == no_vertex; }
  /// The point whose collapse removed a face.
  uint32_t vanished_with(size_t face) const { return vanished_with_[face]; }
  const Face& operator[](size_t face) const { return faces_[face]; }
  size_t size() const { return faces_.size(); }
  size_t count() const {
    size_t alive_faces = 0;
    for (size_t f = 0; f < size(); f++) alive_faces += alive(f);
    return alive_faces;
  }
  std::vector<size_t> at(uint32_t point) const {
    std::vector<size_t> fan;
    for (size_t f = 0; f < size(); f++)
      if (alive(f) && has(f, point)) fan.push_back(f);
    return fan;
  }
  void collapse(uint32_t v, uint32_t u) {
    for (const size_t f : at(v)) {
      if (has(f, u)) vanished_with_[f] = v;
      std::replace(faces_[f].begin(), faces_[f].end(), v, u);
    }
  }

 private:
  bool has(size_t face, uint32_t point) const {
    return std::find(faces_[face].begin(), faces_[face].end(), point) != faces_[face].end();
  }

  std::vector<Face> faces_;
  std::vector<bool> loose_;
  std::vector<uint32_t> vanished_with_;
};

/// A mesh that collapses in random order, each step held against the plain list of faces.
class RandomCollapses {
 public:
  RandomCollapses(const Mesh& mesh, uint64_t seed)
      : mesh_(quantize(mesh, {}).value()),
        points_(mesh_.positions),
        plain_(mesh_, points_),
        state_(mesh_, points_),
        random_(seed, 0),
        live_(points_.count()) {
    std::iota(live_.begin(), live_.end(), 0u);
  }

  void run(int rounds) {
    for (int i = 0; i < rounds; i++) round();
  }
  CollapseOrder release() { return state_.release(std::move(rounds_)); }

  const PlainFaces& plain() const { return plain_; }
  const Points& points() const { return points_; }
  CollapseState& state() { return state_; }

 private:
  void round() {
    state_.begin_round(live_);
    CollapseOrder::Round removed;
    std::vector<uint32_t> order = live_;
    for (size_t i = order.size(); i > 1; i--) std::swap(order[i - 1], order[random_.below(static_cast<uint32_t>(i))]);
    for (const uint32_t v : order)
      if (!state_.locked(v) && random_.uniform() < 0.7f && step(v)) removed.removed.push_back(v);
    std::erase_if(live_, [&](uint32_t v) { return state_.removed(v); });
    for (const uint32_t v : live_) ASSERT_EQ(state_.isolated(v), plain_.at(v).empty()) << v;
    rounds_.push_back(std::move(removed));
  }

  bool step(uint32_t v) {
    const bool alone = state_.isolated(v);
    const float least = state_.least_cost(v);
    EXPECT_GE(least, 0);
    const CollapseState::Choice choice = alone ? any_target(v) : state_.choose(v);
    EXPECT_GE(choice.cost, least) << "the bound holds";
    if (!std::isfinite(choice.cost) || choice.target == no_vertex) return false;
    EXPECT_NE(choice.target, v);
    EXPECT_FALSE(state_.removed(choice.target));
    EXPECT_TRUE(std::isfinite(choice.error) && choice.error >= 0);
    std::set<uint32_t> touched{choice.target};
    for (const size_t f : plain_.at(v)) touched.insert(plain_[f].begin(), plain_[f].end());
    touched.erase(v);

    const auto changed = state_.collapse(v, choice.target);
    EXPECT_EQ(std::set<uint32_t>(changed.begin(), changed.end()), touched)
        << "all points of changed faces, and no other";
    for (const uint32_t x : touched) EXPECT_TRUE(state_.locked(x));
    EXPECT_TRUE(state_.removed(v));
    plain_.collapse(v, choice.target);
    EXPECT_TRUE(alone || plain_.at(choice.target).size() <= max_fan) << "a split can be coded";
    for (const uint32_t x : touched) EXPECT_EQ(state_.isolated(x), plain_.at(x).empty());
    return true;
  }

  /// A point without faces goes anywhere.
  CollapseState::Choice any_target(uint32_t v) {
    const uint32_t u = live_[random_.below(static_cast<uint32_t>(live_.size()))];
    if (u == v || state_.removed(u) || !state_.can_be_split(u)) return {};
    return {u, 0, 0};
  }

  QuantizedMesh mesh_;
  Points points_;
  PlainFaces plain_;
  CollapseState state_;
  Random random_;
  std::vector<uint32_t> live_;
  std::vector<CollapseOrder::Round> rounds_;
};

TEST(CollapseState, LosesTheFacesThatDegenerateAndNoOther) {
  for (const auto& [name, mesh] : nasty_meshes()) {
    SCOPED_TRACE(name);
    RandomCollapses collapses(mesh, 1);
    const size_t before = collapses.plain().count();
    collapses.run(6);
    const PlainFaces& plain = collapses.plain();
    EXPECT_EQ(plain.count() > 0, before > 0) << "the last face never goes";
    const CollapseOrder order = collapses.release();
    ASSERT_EQ(order.vanished.size(), plain.size());
    for (size_t f = 0; f < plain.size(); f++) {
      ASSERT_EQ(order.vanished[f] == CollapseOrder::loose, plain.loose(f)) << f;
      ASSERT_EQ(order.vanished[f] == CollapseOrder::never, plain.alive(f)) << f;
      if (plain.loose(f) || plain.alive(f)) continue;
      ASSERT_EQ(collapses.points().of[order.vanished[f]], plain.vanished_with(f)) << f;
    }
  }
}

TEST(CollapseState, SendsAllVerticesOfAPointToOnesOfItsTarget) {
  for (const auto& [name, mesh] : nasty_meshes()) {
    SCOPED_TRACE(name);
    RandomCollapses collapses(mesh, 2);
    collapses.run(6);
    const Points& points = collapses.points();
    const CollapseOrder order = collapses.release();
    for (uint32_t v = 0; v < order.parent.size(); v++) {
      const uint32_t point = points.of[v];
      ASSERT_EQ(points.of[order.parent[v]], order.target[point]);
      ASSERT_EQ(order.parent[v] == v, order.target[point] == point);
    }
    // Every way ends at a point that stays: the target of a round's collapse outlives the round.
    std::vector<size_t> removed_in(points.count(), order.rounds.size());
    for (size_t i = 0; i < order.rounds.size(); i++)
      for (const uint32_t point : order.rounds[i].removed) removed_in[point] = i;
    for (uint32_t point = 0; point < points.count(); point++) {
      if (order.target[point] == point) continue;
      ASSERT_LT(removed_in[point], removed_in[order.target[point]]);
    }
  }
}

TEST(CollapseState, RoundsUndoneLeaveWhatWasBefore) {
  for (const auto& [name, mesh] : nasty_meshes()) {
    SCOPED_TRACE(name);
    RandomCollapses shorter(mesh, 3), longer(mesh, 3);
    shorter.run(2);
    longer.run(5);
    const CollapseOrder expected = shorter.release();
    CollapseOrder order = longer.release();
    order.keep_rounds(order.rounds.size(), longer.points());
    EXPECT_EQ(order.rounds.size(), 5u) << "nothing is undone";
    order.keep_rounds(2, longer.points());
    EXPECT_EQ(order.target, expected.target);
    EXPECT_EQ(order.parent, expected.parent);
    EXPECT_EQ(order.vanished, expected.vanished);
  }
}

TEST(CollapseState, CostsNothingInsideAPlaneAndMoreAtItsCorners) {
  RandomCollapses flat(sheet(6), 1);
  CollapseState& state = flat.state();
  size_t inside = 0, corners = 0;
  for (uint32_t v = 0; v < flat.points().count(); v++) {
    const size_t fan = flat.plain().at(v).size();
    const CollapseState::Choice choice = state.choose(v);
    if (fan == 6) {
      EXPECT_EQ(choice.error, 0) << "coordinates on the lattice are exact";
    } else if (fan <= 2) {
      EXPECT_GT(choice.error, 0.1f) << "a corner takes a share of its cells of side 1 along";
    }
    inside += fan == 6;
    corners += fan <= 2;
  }
  EXPECT_EQ(inside, 25u) << "of 5 by 5";
  EXPECT_GE(corners, 4u);
}

// Planes through the owners, seen from the last owner after the quadrics have moved along with the points.
TEST(Quadric, IsTheSumOfWeightedSquaredDistancesWhereverItHasMoved) {
  Random random(7, 0);
  const auto symmetric = [&] { return random_point(random) * 2.0f - Vec3f::filled(1); };
  for (int trial = 0; trial < 100; trial++) {
    struct Plane {
      Vec3f owner, normal;
      float weight;
    };
    std::vector<Plane> planes;
    std::vector<Quadric> quadrics;
    std::vector<Vec3f> owners;
    for (int i = 0; i < 4; i++) {
      owners.push_back(symmetric());
      quadrics.emplace_back();
      for (int k = 0; k < 3; k++) {
        planes.push_back({owners.back(), normalized(symmetric()), random.uniform()});
        quadrics.back().add_plane(planes.back().normal, planes.back().weight);
      }
      if (i > 0)
        quadrics[static_cast<size_t>(i)].add(quadrics[static_cast<size_t>(i) - 1], owners.back() - owners.end()[-2]);
    }
    const Vec3f place = symmetric();
    double sum = 0, weight = 0;
    for (const Plane& plane : planes) {
      const double distance = dot((place - plane.owner).cast<double>(), plane.normal.cast<double>());
      sum += plane.weight * distance * distance;
      weight += plane.weight;
    }
    // Single precision: a few dozen roundings of terms of at most weight * (2 sqrt 3)^2.
    EXPECT_NEAR(quadrics.back().at(place - owners.back()), sum, 40 * 0x1p-24 * weight * 12);
    EXPECT_NEAR(quadrics.back().weight(), weight, 40 * 0x1p-24 * weight);
    EXPECT_GE(quadrics.back().at({}), 0);
  }
}

}  // namespace
}  // namespace lightwell
