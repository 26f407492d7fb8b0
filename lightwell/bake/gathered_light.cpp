// SPDX-License-Identifier: Apache-2.0
#include "lightwell/bake/gathered_light.h"

#include <bit>

#include "lightwell/bake/fitted_moments.h"
#include "lightwell/bake/node_journal.h"
#include "lightwell/bake/sheets.h"
#include "lightwell/base/fingerprint.h"
#include "lightwell/light/add_radiance.h"

namespace lightwell {
namespace {

/// Samples of the contained luminaires at a place; rays alone find only large ones.
constexpr int luminaire_samples = 64;

/// The noise above which another set of rays is taken, by default.
constexpr float usual_noise = 0.015f;
/// Nodes that see more insides are hardly looked up: one set does.
constexpr float seldom_insides = 0.5f;

/// Of a cell: how far behind a surface a node answers for it.
constexpr float close_by = 0.5f;

}  // namespace

GatheredLight::GatheredLight(const BakeScene& scene, const EstimatorOptions& options)
    : world_(scene.world),
      space_(scene.space),
      cache_(scene.cache),
      contained_(options.contained),
      reflected_(options.reflected),
      effort_(options.effort),
      box_(scene.box),
      seed_(options.seed),
      journal_(options.journal) {
  // A thousandth of what all light would be if the box's walls took it up, in the 18 numbers of size_of().
  constexpr float negligible = 1e-3f;
  const Vec3f s = world_.surfaces().bounds().size();
  const float area = 2 * (s[0] * s[1] + s[1] * s[2] + s[2] * s[0]);
  dark_ = area > 0 ? 18 * negligible * mean_of_channels(world_.lights().power()) / area : 0;
  if (journal_ == nullptr) return;
  // The light of the surfaces tells apart scenes, lamps, materials and seeds.
  inputs_ = cache_.fingerprint(seed_) * 31 + static_cast<uint64_t>(reflected_);
  inputs_ = inputs_ * 31 + std::bit_cast<uint32_t>(effort_);
  for (size_t i = 0; i < world_.lights().luminaires().size(); i++)
    inputs_ = inputs_ * 31 + contained_.contains(static_cast<int>(i));
}

Vec3f viewpoint(const Box3f& box, const Vec3f& node, const Vec3f& cell) {
  constexpr float inset = 0.1f;
  Vec3f position = node;
  for (int a = 0; a < 3; a++) {
    const float margin = inset * cell[a];
    if (std::abs(position[a] - box.lo[a]) < margin) position[a] = box.lo[a] + margin;
    if (std::abs(position[a] - box.hi[a]) < margin) position[a] = box.hi[a] - margin;
  }
  return position;
}

template <typename RayOf, typename Take>
void GatheredLight::gather_rays(int count, float near, Random& random, const RayOf& ray, const Take& take) const {
  constexpr size_t ahead = 4;
  struct Pending {
    Vec3f direction{};
    Gathering gathering;
  };
  std::array<Pending, ahead> pending;
  const auto end = static_cast<size_t>(count);
  for (size_t i = 0; i < end + ahead; i++) {
    Pending& place = pending[i % ahead];
    if (i >= ahead && i - ahead < end) take(place.direction, place.gathering);
    if (i >= end) continue;
    const Ray next = ray(static_cast<int>(i));
    place = {next.direction, gather(world_, next, near, random)};
    if (reflected_) cache_.find_cells(place.gathering);
  }
}

NodeSurroundings GatheredLight::around(const Vec3f& position, Random& random, int rays, const Facings& facings) const {
  NodeSurroundings found;
  const float shift = random.uniform(), turn = random.uniform();
  const float solid_angle = 4 * pi / static_cast<float>(rays);
  int insides = 0, met = 0, backs = 0;
  Moments alternating;  // every other sample counts negative
  float sign = 1;
  const auto add = [&](const Vec3f& direction, const Vec3f& radiance) {
    add_radiance(found.moments, direction, radiance);
    add_radiance(alternating, direction, radiance * sign);
    sign = -sign;
    for (size_t i = 0; i < facings.size() && facings[i].weight > 0; i++)
      found.received[i] += radiance * std::max(dot(facings[i].normal, direction), 0.0f);
  };
  const auto ray = [&](int i) {
    return Ray{position, sphere_direction(static_cast<size_t>(i), static_cast<size_t>(rays), shift, turn)};
  };
  gather_rays(rays, cache_.near(), random, ray, [&](const Vec3f& direction, const Gathering& gathering) {
    found.rays += static_cast<uint32_t>(gathering.rays);
    insides += gathering.meets_surface ? space_.from_inside(gathering.first) : space_.closed();
    met += gathering.meets_surface;
    backs += gathering.meets_surface && !gathering.first.front;
    const Vec3f radiance = reflected(gathering) + emitted(position, direction, gathering, 1 / solid_angle);
    add(direction, radiance * solid_angle);
  });
  found.insides = static_cast<float>(insides) / static_cast<float>(rays);
  found.behind = met > 0 ? static_cast<float>(backs) / static_cast<float>(met) : 0;
  found.rays += sample_luminaires(position, {}, random, [&](const Arrival& arrival) {
    const float weight =
        arrival.extended ? power_heuristic(luminaire_samples * arrival.density, 1 / solid_angle) : 1.0f;
    add(arrival.direction, arrival.radiance * (weight / (luminaire_samples * arrival.density)));
  });
  found.noise = size_of(alternating) / std::max(size_of(found.moments), std::numeric_limits<float>::min());
  return found;
}

NodeSurroundings GatheredLight::without_much_noise(const Vec3f& position, const Facings& facings, int most_sets,
                                                   Random& random) const {
  NodeSurroundings sum = around(position, random, rays_a_node, facings);
  int sets = 1;
  const bool matters = sum.insides < seldom_insides && size_of(sum.moments) > dark_;
  float noise = sum.noise;
  const float most_noise = usual_noise / std::sqrt(effort_);
  for (; matters && sets < most_sets && noise > most_noise; sets++) {
    const NodeSurroundings more = around(position, random, rays_a_node, facings);
    sum.moments += more.moments;
    sum.insides += more.insides;
    sum.noise += more.noise;
    sum.rays += more.rays;
    for (size_t i = 0; i < sum.received.size(); i++) sum.received[i] += more.received[i];
    noise = sum.noise / std::pow(static_cast<float>(sets + 1), 1.5f);
  }
  const float share = 1 / static_cast<float>(sets);
  sum.moments = sum.moments * share;
  for (Vec3f& received : sum.received) received *= share;
  sum.insides *= share;
  sum.noise = noise;
  return sum;
}

NodeSurroundings GatheredLight::at_node(const Vec3f& node, const Vec3f& cell, const Facings& facings,
                                        int most_sets) const {
  const auto* bytes = reinterpret_cast<const uint8_t*>(facings.data());
  const uint64_t key = NodeJournal::key(fingerprint({bytes, sizeof(facings)}, inputs_), node, cell);
  if (const auto known = journal_ != nullptr ? journal_->find(key) : std::nullopt) return *known;
  Random random(seed_, NodeJournal::key(0, node, cell));
  const NodeSurroundings found = gather_node(node, cell, facings, most_sets, random);
  if (journal_ != nullptr) journal_->add(key, found);
  return found;
}

NodeSurroundings GatheredLight::gather_node(const Vec3f& node, const Vec3f& cell, const Facings& facings, int most_sets,
                                            Random& random) const {
  const Vec3f position = viewpoint(box_, node, cell);
  const int affordable = std::max(1, static_cast<int>(static_cast<float>(most_sets) * effort_));
  NodeSurroundings found = without_much_noise(position, facings, affordable, random);
  found.moments = fitted(found.moments, facings, found.received);
  for (int axis = 0; axis < 3; axis++) {
    // What lies behind the outermost surfaces is seen by none unless a sky lights it.
    if (position[axis] != node[axis] && world_.lights().environment().black()) continue;
    if (is_on_sheet(world_.surfaces(), space_, node, cell, axis, random)) found.insides = 1;
  }
  for (int d = 0; d < 6; d++) {
    Vec3f direction{};
    direction[d / 2] = d % 2 == 0 ? 1.0f : -1.0f;
    const auto beyond = facing_surface(position, direction, close_by * cell[d / 2], random);
    if (!beyond) continue;
    found.moments.m[static_cast<size_t>(d)] = received(*beyond, direction, 2 * rays_a_node, random).irradiance;
    found.rays += 2 * rays_a_node;
  }
  return found;
}

std::optional<Vec3f> GatheredLight::facing_surface(const Vec3f& position, const Vec3f& direction, float reach,
                                                   Random& random) const {
  constexpr int most_surfaces = 4;
  constexpr float least_cosine = 0.7f;
  const TraceScene& surfaces = world_.surfaces();
  std::optional<Vec3f> last;
  Ray ray{.origin = position, .direction = direction, .far = reach};
  Hit hit;
  for (int i = 0; i < most_surfaces && ray.far > 0 && surfaces.intersect(ray, random, hit); i++) {
    if (hit.front || surfaces.material(hit.instance).double_sided) break;
    if (dot(hit.normal, direction) > least_cosine) last = hit.position;
    ray.origin = surfaces.leave(hit.position, direction);
    ray.far = reach - dot(ray.origin - position, direction);
  }
  return last;
}

Received GatheredLight::received(const Vec3f& position, const Vec3f& normal, int rays, Random& random,
                                 float near) const {
  Vec3f sum{};
  int insides = 0;
  const Frame frame(normal);
  const float shift = random.uniform(), turn = random.uniform();
  const float n = static_cast<float>(rays);
  const Vec3f origin = world_.surfaces().leave(position, normal);
  const auto ray = [&](int i) {
    const Vec3f up = cosine_direction(static_cast<size_t>(i), static_cast<size_t>(rays), shift, turn);
    return Ray{origin, frame.to_world(up)};
  };
  gather_rays(rays, near * cache_.near(), random, ray, [&](const Vec3f& direction, const Gathering& gathering) {
    insides += gathering.meets_surface ? space_.from_inside(gathering.first) : space_.closed();
    const float density = n * std::max(dot(normal, direction), 0.0f) / pi;
    sum += (reflected(gathering) + emitted(position, direction, gathering, density)) * (pi / n);
  });
  sample_luminaires(position, normal, random, [&](const Arrival& arrival) {
    const float cosine = dot(normal, arrival.direction);
    if (cosine <= 0) return;
    const float weight =
        arrival.extended ? power_heuristic(luminaire_samples * arrival.density, n * cosine / pi) : 1.0f;
    sum += arrival.radiance * (cosine * weight / (luminaire_samples * arrival.density));
  });
  return {sum, static_cast<float>(insides) / n};
}

Vec3f GatheredLight::emitted(const Vec3f& position, const Vec3f& direction, const Gathering& gathering,
                             float density) const {
  if (!contained_.contains(gathering.luminaire)) return {};
  const Lights& lights = world_.lights();
  const float of_samples =
      gathering.meets_surface ? lights.density(position, gathering.first) : lights.environment_density(direction);
  return gathering.emitted * power_heuristic(density, luminaire_samples * of_samples);
}

/// Calls add(arrival) for the samples whose light arrives; gives the number of rays.
template <typename Add>
uint32_t GatheredLight::sample_luminaires(const Vec3f& position, const Vec3f& normal, Random& random,
                                          const Add& add) const {
  if (contained_ == LuminaireSet()) return 0;
  uint32_t rays = 0;
  for (int i = 0; i < luminaire_samples; i++) {
    Arrival arrival = world_.lights().sample(position, random);
    if (!contained_.contains(arrival.luminaire) || max_component(arrival.radiance) <= 0) continue;
    rays++;
    arrival.radiance *= visibility(world_.surfaces(), position, normal, arrival, random);
    add(arrival);
  }
  return rays;
}

}  // namespace lightwell
