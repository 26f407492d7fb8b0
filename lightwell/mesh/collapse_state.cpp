// SPDX-License-Identifier: Apache-2.0
#include "lightwell/mesh/collapse_state.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace lightwell {
namespace {

constexpr uint32_t none = 0xffffffffu;

// Weights, times squared edge length, of Garland and Heckbert's perpendicular planes at border edges, those of regions
// too, and, here, also at edges where texture or colour tears.
constexpr float border_weight = 3, tear_weight = 1;
// Share of the squared edge length in the cost, so that of equal edges the shorter one goes first.
constexpr float length_weight = 1e-2f;
// Squared error of attributes torn as far as possible, as a share of the squared length over which they smear.
constexpr float tear_share = 1.0f / 16;
// Least cosine between a face's normals before and after a collapse.
constexpr float least_cosine = 0.2f;

// The face rotated so that its smallest point comes first: equal for faces that differ only in their first corner.
Face canonical(const Face& f) {
  const auto smallest = static_cast<size_t>(std::min_element(f.begin(), f.end()) - f.begin());
  return {f[smallest], f[(smallest + 1) % 3], f[(smallest + 2) % 3]};
}

}  // namespace

CollapseState::CollapseState(const QuantizedMesh& mesh, const Points& points)
    : mesh_(mesh),
      points_(points),
      position_(points.count()),
      quadric_(points.count()),
      first_corner_(points.count(), none),
      fan_(points.count()),
      fan_bound_(points.count()),
      locked_in_(points.count()) {
  Vec3i lo = Vec3i::filled(Lattice::limit), hi = -lo;
  for (const Vec3i& p : mesh.positions) {
    lo = min(lo, p);
    hi = max(hi, p);
  }
  const float steps = static_cast<float>(std::max(1, max_component(hi - lo)));
  size_ = steps * mesh.position_lattice.step();
  for (uint32_t v = 0; v < points.count(); v++)
    position_[v] = (mesh.positions[points.first[v]] - lo).cast<float>() / steps;

  order_.target.resize(points.count());
  std::iota(order_.target.begin(), order_.target.end(), 0u);
  order_.parent.resize(mesh.positions.size());
  std::iota(order_.parent.begin(), order_.parent.end(), 0u);
  link_faces(mesh);
  add_quadrics();
}

void CollapseState::link_faces(const QuantizedMesh& mesh) {
  std::vector<std::tuple<Face, uint16_t, uint32_t>> sorted(mesh.faces.size());
  faces_.resize(mesh.faces.size());
  for (uint32_t f = 0; f < faces_.size(); f++) {
    const Face& v = mesh.faces[f];
    faces_[f] = {{points_.of[v[0]], points_.of[v[1]], points_.of[v[2]]}, v, {none, none, none}};
    sorted[f] = {canonical(faces_[f].points), region_of(f), f};
  }
  if (mesh.has_regions_apart()) {
    vertex_region_.resize(mesh.positions.size());
    for (size_t f = 0; f < faces_.size(); f++)
      for (const uint32_t v : mesh.faces[f]) vertex_region_[v] = mesh.regions[f];
  }
  order_.vanished.assign(faces_.size(), CollapseOrder::never);
  std::sort(sorted.begin(), sorted.end());
  for (size_t i = 0; i < sorted.size(); i++) {
    const auto& [p, region, f] = sorted[i];
    const bool degenerate = p[0] == p[1] || p[1] == p[2] || p[2] == p[0];
    const bool repeated = i > 0 && std::get<0>(sorted[i - 1]) == p && std::get<1>(sorted[i - 1]) == region;
    if (degenerate || repeated) order_.vanished[f] = CollapseOrder::loose;
  }
  live_faces_.resize(std::max<size_t>(1, mesh.region_shifts.size()));
  for (uint32_t f = 0; f < faces_.size(); f++) {
    if (order_.vanished[f] == CollapseOrder::loose) continue;
    live_faces_[region_of(f)]++;
    for (uint32_t k = 0; k < 3; k++) {
      const uint32_t v = faces_[f].points[k];
      faces_[f].next[k] = std::exchange(first_corner_[v], 3 * f + k);
      fan_[v]++;
    }
  }
}

void CollapseState::add_quadrics() {
  for (uint32_t f = 0; f < faces_.size(); f++) {
    if (order_.vanished[f] == CollapseOrder::loose) continue;
    const Face& p = faces_[f].points;
    const Vec3f normal = cross(position_[p[1]] - position_[p[0]], position_[p[2]] - position_[p[0]]);
    const float area = 0.5f * length(normal);
    for (const uint32_t v : p) quadric_[v].add_plane(normalized(normal), area);
  }
  for (uint32_t v = 0; v < points_.count(); v++) add_edge_planes(v);
}

// Adds the planes on the border and torn edges of v whose other end has more faces, so that a fan of n faces costs n
// and not n^2.
void CollapseState::add_edge_planes(uint32_t v) {
  gather(v, star_);
  for (const Spoke& spoke : star_)
    for (const uint32_t x : {spoke.a, spoke.b}) {
      if (std::pair(fan_[x], x) < std::pair(fan_[v], v)) continue;
      const float weight = edge_weight(spoke, x);
      if (weight == 0) continue;
      const Vec3f edge = position_[x] - position_[v];
      const Vec3f face = cross(position_[spoke.a] - position_[v], position_[spoke.b] - position_[v]);
      const Vec3f normal = normalized(cross(normalized(edge), normalized(face)));
      for (const uint32_t end : {v, x}) quadric_[end].add_plane(normal, weight * dot(edge, edge));
    }
}

// The weight of the plane on the edge to x, for one of its faces.
float CollapseState::edge_weight(const Spoke& spoke, uint32_t x) const {
  uint32_t sharing = 0;
  const Spoke* opposite = nullptr;
  for (const Spoke& other : star_) {
    if (!other.has(x)) continue;
    sharing++;
    if (other.corner != spoke.corner) opposite = &other;
  }
  if (sharing != 2 || region_of(spoke.corner / 3) != region_of(opposite->corner / 3)) return border_weight;
  const auto vertex_at = [&](const Spoke& s, uint32_t point) {
    const Corners& face = faces_[s.corner / 3];
    for (size_t k = 0; k < 3; k++)
      if (face.points[k] == point) return face.vertices[k];
    return none;
  };
  const uint32_t v = faces_[spoke.corner / 3].points[spoke.corner % 3];
  const bool torn = torn_between(vertex_at(spoke, v), vertex_at(*opposite, v)) ||
                    torn_between(vertex_at(spoke, x), vertex_at(*opposite, x));
  return torn ? tear_weight : 0;
}

bool CollapseState::torn_between(uint32_t vertex, uint32_t other) const {
  if (vertex == other) return false;
  for (const auto& texcoords : mesh_.texcoords)
    if (!texcoords.empty() && texcoords[vertex] != texcoords[other]) return true;
  return !mesh_.colors.empty() && mesh_.colors[vertex] != mesh_.colors[other];
}

// Gathers the faces at v and unlinks those that have vanished meanwhile.
void CollapseState::gather(uint32_t v, std::vector<Spoke>& star) {
  star.clear();
  for (uint32_t* link = &first_corner_[v]; *link != none;) {
    const uint32_t corner = *link, f = corner / 3, k = corner % 3;
    if (order_.vanished[f] != CollapseOrder::never) {
      *link = faces_[f].next[k];
      continue;
    }
    star.push_back({faces_[f].points[(k + 1) % 3], faces_[f].points[(k + 2) % 3], corner});
    link = &faces_[f].next[k];
  }
}

void CollapseState::gather_ring(uint32_t v) {
  ring_.clear();
  for (const Spoke& spoke : star_)
    for (const uint32_t x : {spoke.a, spoke.b}) {
      const auto known = std::find_if(ring_.begin(), ring_.end(), [&](const Neighbour& n) { return n.point == x; });
      if (known != ring_.end()) {
        known->faces++;
        continue;
      }
      const Vec3f t = position_[x] - position_[v];
      ring_.push_back({x, 1, quadric_[v].at(t) + length_weight * quadric_[v].weight() * dot(t, t)});
    }
}

void CollapseState::begin_round(std::span<const uint32_t> live) {
  round_++;
  for (const uint32_t v : live) fan_bound_[v] = fan_[v];
}

float CollapseState::least_cost(uint32_t v) {
  if (isolated(v)) return 0;
  if (fan_[v] > max_fan) return std::numeric_limits<float>::infinity();
  gather(v, star_);
  gather_ring(v);
  return std::min_element(ring_.begin(), ring_.end(), [](auto& a, auto& b) { return a.cost < b.cost; })->cost;
}

CollapseState::Choice CollapseState::choose(uint32_t v) {
  Choice best;
  if (fan_[v] > max_fan) return best;
  gather(v, star_);
  gather_ring(v);
  std::sort(ring_.begin(), ring_.end(),
            [](auto& a, auto& b) { return std::pair(a.cost, a.point) < std::pair(b.cost, b.point); });
  const float longest = longest_edge(v);
  for (const Neighbour& u : ring_) {
    if (u.cost >= best.cost) break;
    const Choice choice = assess(v, u, longest);
    if (choice.cost < best.cost) best = choice;
  }
  return best;
}

float CollapseState::longest_edge(uint32_t v) const {
  float longest = 0;
  for (const Neighbour& n : ring_) longest = std::max(longest, length(position_[n.point] - position_[v]));
  return longest;
}

CollapseState::Choice CollapseState::assess(uint32_t v, const Neighbour& u, float longest) {
  const uint32_t moved = fan_[v] - u.faces;
  if (fan_bound_[u.point] + moved > max_fan || ends_region(u.point)) return {};
  gather(u.point, target_star_);
  const bool sound = moved > 0 && keeps_border(u) && keeps_orientation(v, u.point) && keeps_links(v, u.point);
  const float harm = (sound ? tear_share * match_vertices(v, u.point) : 1) * longest * longest;
  const float weight = quadric_[v].weight();
  const float deviation = weight > 0 ? quadric_[v].at(position_[u.point] - position_[v]) / weight : 0;
  return {u.point, u.cost + harm * std::max(weight, longest * longest), size_ * std::sqrt(deviation + harm)};
}

// Whether no face of some region would be left without those that the gathered star shares with u.
bool CollapseState::ends_region(uint32_t u) const {
  return std::ranges::any_of(star_, [&](const Spoke& spoke) {
    if (!spoke.has(u)) return false;
    const uint16_t region = region_of(spoke.corner / 3);
    if (live_faces_[region] > star_.size()) return false;
    return live_faces_[region] == std::ranges::count_if(star_, [&](const Spoke& other) {
             return other.has(u) && region_of(other.corner / 3) == region;
           });
  });
}

// A point inside a surface may collapse anywhere, one on a border only along it, and one where borders meet not at all.
bool CollapseState::keeps_border(const Neighbour& u) const {
  const auto borders = std::count_if(ring_.begin(), ring_.end(), [](const Neighbour& n) { return n.faces != 2; });
  return borders == 0 || (borders == 2 && u.faces != 2);
}

// The link condition: v and u have no common neighbours other than the far corners of their common faces, and no face
// of u is covered by one of v's (as when a tetrahedron folds flat).
bool CollapseState::keeps_links(uint32_t v, uint32_t u) {
  const auto shared_corner = [&](uint32_t x) {
    return std::any_of(star_.begin(), star_.end(), [&](const Spoke& s) { return s.has(u) && s.has(x); });
  };
  for (const Spoke& spoke : target_star_) {
    if (spoke.has(v)) continue;
    int common = 0;
    for (const uint32_t x : {spoke.a, spoke.b}) {
      if (!in_ring(x)) continue;
      if (!shared_corner(x)) return false;
      common++;
    }
    const auto covers = [&](const Spoke& s) { return s.has(spoke.a) && s.has(spoke.b); };
    if (common == 2 && std::any_of(star_.begin(), star_.end(), covers)) return false;
  }
  return true;
}

bool CollapseState::in_ring(uint32_t x) const {
  return std::any_of(ring_.begin(), ring_.end(), [&](const Neighbour& n) { return n.point == x; });
}

bool CollapseState::keeps_orientation(uint32_t v, uint32_t u) const {
  const auto normal_from = [&](uint32_t corner, const Spoke& s) {
    return cross(position_[s.a] - position_[corner], position_[s.b] - position_[corner]);
  };
  return std::all_of(star_.begin(), star_.end(), [&](const Spoke& spoke) {
    if (spoke.has(u)) return true;
    const Vec3f before = normal_from(v, spoke), after = normal_from(u, spoke);
    const float size = length(before);
    return size == 0 || dot(before, after) > least_cosine * size * length(after);
  });
}

// Finds the mate at u of each vertex of v: the one across the vanishing faces or, where there is none or more than one,
// the most similar. Returns the distance, 0 to 1, between the attributes of the worst pair found by similarity.
float CollapseState::match_vertices(uint32_t v, uint32_t u) {
  const uint32_t first = points_.first[v], count = points_.first[v + 1] - first;
  if (count == 1 && points_.first[u + 1] - points_.first[u] == 1) {
    mates_.assign(1, points_.first[u]);
    return 0;
  }
  mates_.assign(count, none);
  std::vector<bool> ambiguous(count);
  for (const Spoke& spoke : star_) {
    if (!spoke.has(u)) continue;
    const Corners& face = faces_[spoke.corner / 3];
    const size_t k = spoke.corner % 3;
    const uint32_t mate = face.vertices[spoke.a == u ? (k + 1) % 3 : (k + 2) % 3];
    const uint32_t i = face.vertices[k] - first;
    if (mates_[i] != none && mates_[i] != mate) ambiguous[i] = true;
    mates_[i] = mate;
  }
  float worst = 0;
  for (const Spoke& spoke : star_) {
    const uint32_t vertex = faces_[spoke.corner / 3].vertices[spoke.corner % 3], i = vertex - first;
    if (mates_[i] != none && !ambiguous[i]) continue;
    float least = std::numeric_limits<float>::infinity();
    for (uint32_t other = points_.first[u]; other < points_.first[u + 1]; other++) {
      const float distance = attribute_distance(vertex, other);
      if (distance < least) mates_[i] = other;
      least = std::min(least, distance);
    }
    ambiguous[i] = false;
    worst = std::max(worst, least);
  }
  std::replace(mates_.begin(), mates_.end(), none, points_.first[u]);
  return worst;
}

float CollapseState::attribute_distance(uint32_t vertex, uint32_t other) const {
  if (!vertex_region_.empty() && vertex_region_[vertex] != vertex_region_[other]) return 1;
  float distance = 0;
  if (!mesh_.normals.empty())
    distance += 0.5f - 0.5f * dot(normal_of(mesh_.normals[vertex]), normal_of(mesh_.normals[other]));
  for (size_t set = 0; set < 2; set++)
    if (!mesh_.texcoords[set].empty()) {
      const Vec2f apart = (mesh_.texcoords[set][vertex] - mesh_.texcoords[set][other]).cast<float>();
      distance += length(apart) * mesh_.texcoord_lattices[set].step();
    }
  if (!mesh_.colors.empty())
    for (size_t i = 0; i < 4; i++)
      distance += static_cast<float>(std::abs(mesh_.colors[vertex][i] - mesh_.colors[other][i])) / 255;
  return std::min(distance, 1.0f);
}

std::span<const uint32_t> CollapseState::collapse(uint32_t v, uint32_t u) {
  gather(v, star_);
  match_vertices(v, u);
  changed_.assign(1, u);
  for (const Spoke& spoke : star_) {
    const uint32_t f = spoke.corner / 3, k = spoke.corner % 3;
    changed_.insert(changed_.end(), {spoke.a, spoke.b});
    if (spoke.has(u)) {
      order_.vanished[f] = faces_[f].vertices[k];
      live_faces_[region_of(f)]--;
      fan_[spoke.a]--;
      fan_[spoke.b]--;
      continue;
    }
    faces_[f].points[k] = u;
    faces_[f].vertices[k] = mates_[faces_[f].vertices[k] - points_.first[v]];
    faces_[f].next[k] = std::exchange(first_corner_[u], spoke.corner);
    fan_[u]++;
    fan_bound_[u]++;
  }
  for (uint32_t i = 0; i < mates_.size(); i++) order_.parent[points_.first[v] + i] = mates_[i];
  quadric_[u].add(quadric_[v], position_[u] - position_[v]);
  order_.target[v] = u;
  for (const uint32_t x : changed_) locked_in_[x] = round_;
  return changed_;
}

CollapseOrder CollapseState::release(std::vector<CollapseOrder::Round> rounds) {
  order_.rounds = std::move(rounds);
  return std::move(order_);
}

}  // namespace lightwell
