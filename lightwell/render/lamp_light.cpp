// SPDX-License-Identifier: Apache-2.0
#include "lightwell/render/lamp_light.h"

#include <algorithm>

#include "lightwell/render/permitted_difference.h"
#include "lightwell/texture/transfer.h"
#include "lightwell/trace/enclosure.h"
#include "lightwell/trace/lamp_irradiance.h"
#include "lightwell/trace/lamp_points.h"
#include "lightwell/trace/punctual_light.h"

namespace lightwell {
namespace {

/// The number of points whose halves are compared first.
constexpr int first_compared = 16;

/// How far the surface that a lamp stands for is from a flat lamp's plane, or reaches from a sphere's centre.
float stray_of(const TraceScene& surfaces, const Luminaire& luminaire, const ClientLamp& lamp) {
  float stray = lamp.kind == ClientLamp::Kind::sphere ? lamp.radius : 0;
  for (const uint32_t face : luminaire.faces)
    for (const Vec3f& corner : surfaces.corners(static_cast<uint32_t>(luminaire.index), face)) {
      const Vec3f way = corner - lamp.center;
      stray = std::max(stray, lamp.kind == ClientLamp::Kind::sphere ? length(way) : std::abs(dot(way, lamp.normal)));
    }
  return stray;
}

/// What points of a lamp have added up to.
struct Sums {
  double weight = 0;
  Vec3d open{};       // weight times reflectance, above the surface's plane
  Vec3d reflected{};  // the same times visibility

  Vec3f mean() const { return of(reflected); }
  /// What it would be if nothing were hidden, where something is; else 0.
  Vec3f mean_if_hidden() const {
    Vec3d hidden{};
    for (int c = 0; c < 3; c++)
      if (reflected[c] < open[c]) hidden[c] = open[c];
    return of(hidden);
  }

  friend Sums operator-(const Sums& a, const Sums& b) {
    return {a.weight - b.weight, a.open - b.open, a.reflected - b.reflected};
  }

 private:
  Vec3f of(const Vec3d& sum) const { return weight > 0 ? (sum / weight).cast<float>() : Vec3f{}; }
};

}  // namespace

/// The light of one lamp that one receiver reflects, better with each point.
///
/// What the shading would reflect into the surface is folded up (Shading): light from above the surface's plane counts
/// as light from its mirror image, too, or the same: it arrives at a surface with the mirror image of the normal. Each
/// of the two has an irradiance in closed form and sums of its own.
class LampLight::Estimate {
 public:
  Estimate(const World& world, const Placed& placed, const Receiver& receiver)
      : world_(world), placed_(placed), receiver_(receiver) {
    const Shading& shading = receiver.shading;
    add_side(shading.shading_normal);
    if (shading.shading_normal != shading.normal)
      add_side(shading.shading_normal - shading.normal * (2 * dot(shading.shading_normal, shading.normal)));
  }

  bool dark() const { return side_count_ == 0; }
  bool ended() const { return ended_; }
  void end() { ended_ = true; }

  /// Adds points until there are `count`. Returns the number of rays.
  int add_points(int count, Random& random) {
    if (ended_) return 0;
    for (size_t side = 0; side < side_count_; side++) sides_[side].before = sides_[side].sums;
    int rays = 0;
    if (!placed_.extended()) {
      // One ray tells all.
      Arrival arrival = arrive_punctual(punctual_lamp(placed_.lamp), receiver_.position);
      arrival.clearance = placed_.bulb;
      rays += add(arrival, 1, random);
      ended_ = true;
    }
    for (; !ended_ && count_ < count; count_++) {
      const LampPoint point = lamp_point(placed_.lamp, static_cast<uint32_t>(count_));
      const Vec3f way = point.position - receiver_.position;
      const float squared = dot(way, way);
      if (!(squared > 0)) continue;
      Arrival arrival{.direction = way / std::sqrt(squared), .distance = std::sqrt(squared)};
      const float leaving = -dot(point.normal, arrival.direction);
      const float facing = placed_.lamp.two_sided ? std::abs(leaving) : std::max(leaving, 0.0f);
      if (facing <= 0) continue;
      arrival.clearance = clearance(point, arrival.direction, facing);
      rays += add(arrival, facing / squared, random);
    }
    return rays;
  }

  Vec3f light() const {
    return sum([](const Side& side) { return side.mean(side.sums); });
  }
  /// By the points before the last call of add_points(), and by those since.
  Vec3f light_of_first() const {
    return sum([](const Side& side) { return side.mean(side.before); });
  }
  Vec3f light_of_last() const {
    return sum([](const Side& side) { return side.mean(side.sums - side.before); });
  }
  /// What one point more or less that is seen would change, where not all are; else 0.
  Vec3f light_of_a_point() const {
    return sum([](const Side& side) { return side.sums.mean_if_hidden(); }) / static_cast<float>(count_);
  }
  /// What may be hidden without any point having told so.
  Vec3f light_untold() const {
    return sum([](const Side& side) { return side.sums.weight > 0 ? Vec3f{} : side.open; });
  }

 private:
  struct Side {
    Vec3f normal{};
    Vec3f unshadowed{};  // irradiance
    Vec3f open{};        // about what it reflects of that
    Sums sums{}, before{};

    /// What is reflected of the unshadowed irradiance. Where no point faces the receiver from above its horizon, as few
    /// of a sphere do close to it, it is taken for lit, as on the page.
    Vec3f mean(const Sums& of) const { return of.weight > 0 ? of.mean() : open; }
  };

  void add_side(const Vec3f& normal) {
    const Vec3f unshadowed = unshadowed_irradiance(placed_.lamp, receiver_.position, normal);
    if (max_component(unshadowed) <= 0) return;
    const Shading& shading = receiver_.shading;
    const Vec3f open = shading.bsdf.value_without_facets(dot(shading.shading_normal, shading.out), 1);
    sides_[side_count_++] = {.normal = normal, .unshadowed = unshadowed, .open = open};
  }

  /// How far before a point of the lamp a ray may end, so that the surface which the lamp stands for does not hide it.
  float clearance(const LampPoint& point, const Vec3f& direction, float facing) const {
    if (placed_.lamp.kind != ClientLamp::Kind::sphere) return placed_.stray / facing;
    const Vec3f from_center = point.position - placed_.lamp.center;
    const float b = -dot(from_center, direction), radius = placed_.lamp.radius;
    return std::sqrt(b * b + placed_.stray * placed_.stray - radius * radius) - b;
  }

  /// Adds a point, given the light that it sends but for its colour. Returns the number of rays.
  int add(const Arrival& arrival, float strength, Random& random) {
    const Shading& shading = receiver_.shading;
    const float cos_out = dot(shading.shading_normal, shading.out);
    std::array<Vec3f, 2> reflected{};
    bool reflects = false;
    const bool above = dot(shading.normal, arrival.direction) > 0;
    for (size_t i = 0; i < side_count_; i++) {
      const float cosine = dot(sides_[i].normal, arrival.direction);
      if (cosine <= 0) continue;
      const float weight = strength * cosine;
      sides_[i].sums.weight += static_cast<double>(weight);
      if (!above) continue;
      reflected[i] = shading.bsdf.value_without_facets(cos_out, cosine) * weight;
      reflects = reflects || max_component(reflected[i]) > 0;
    }
    if (!reflects) return 0;
    const Vec3f seen = visibility(world_.surfaces(), receiver_.position, shading.normal, arrival, random);
    for (size_t i = 0; i < side_count_; i++) {
      sides_[i].sums.open += reflected[i].cast<double>();
      sides_[i].sums.reflected += (reflected[i] * seen).cast<double>();
    }
    return 1;
  }

  template <typename Take>
  Vec3f sum(const Take& take) const {
    Vec3f sum{};
    for (size_t i = 0; i < side_count_; i++) sum += sides_[i].unshadowed * take(sides_[i]);
    return sum;
  }

  const World& world_;
  const Placed& placed_;
  const Receiver& receiver_;
  std::array<Side, 2> sides_;
  size_t side_count_ = 0;  // those that the lamp shines on
  int count_ = 0;          // points so far
  bool ended_ = false;
};

LampLight::LampLight(const World& world, const LampSampling& sampling, const LuminaireSet& left_out,
                     const LuminaireFactors& factors)
    : world_(world), sampling_(sampling) {
  const std::vector<Luminaire>& luminaires = world.lights().luminaires();
  for (const ClientLamp& lamp : sampling.lamps) {
    const auto found = std::ranges::find(luminaires, lamp.luminaire, &Luminaire::id);
    const int number = static_cast<int>(found - luminaires.begin());
    if (found == luminaires.end() || left_out.contains(number)) continue;
    luminaires_.insert(number);
    Placed& placed = lamps_.emplace_back(Placed{.lamp = lamp});
    placed.lamp.radiance *= factors.of(number);
    placed.lamp.intensity *= factors.of(number);
    if (placed.extended())
      placed.stray = stray_of(world.surfaces(), *found, lamp);
    else if (lamp.kind != ClientLamp::Kind::sun)
      placed.bulb = bulb_radius(world.surfaces(), punctual_lamp(lamp));
  }
}

namespace {

/// The largest difference of a channel's value encoded for the screen.
float seen_difference(const Display& display, const Vec3f& one, const Vec3f& other) {
  const Vec3f a = display(one), b = display(other);
  float largest = 0;
  for (int c = 0; c < 3; c++) largest = std::max(largest, std::abs(linear_to_srgb(a[c]) - linear_to_srgb(b[c])));
  return largest;
}

}  // namespace

/// What `whole`, the light of all lamps and what else is known, errs by because of one lamp, as the value encoded for
/// the screen. The halves of its points are two estimates; that of all, their mean, errs by half of what they differ.
/// The beginning of the order and what follows to twice as many are each spread evenly over the lamp, while even and
/// odd points would be its two sides. Few points agree by chance, too: n of them tell shares of the lamp to 1/n at
/// best, which shows where all are hidden and it is dark. Where all are seen it is little beside their light, and not
/// asked for. And points that tell nothing always agree.
float LampLight::seen_error(const Display& display, const Estimate& estimate, const Vec3f& whole) {
  const Vec3f others = whole - estimate.light(), grain = estimate.light_of_a_point() / 2.0f;
  return std::max({seen_difference(display, others + estimate.light_of_first(), others + estimate.light_of_last()) / 2,
                   seen_difference(display, whole - grain, whole + grain) / 2,
                   seen_difference(display, whole - estimate.light_untold(), whole)});
}

LampLight::Found LampLight::reflected(const Receiver& receiver, const Vec3f& other, Random& random) const {
  std::vector<Estimate> estimates;
  estimates.reserve(lamps_.size());
  for (const Placed& placed : lamps_)
    if (Estimate estimate(world_, placed, receiver); !estimate.dark()) estimates.push_back(estimate);

  Found found;
  for (int count = first_compared / 2;; count *= 2) {
    count = std::min(count, sampling_.most_points);
    for (Estimate& estimate : estimates) found.rays += estimate.add_points(count, random);
    found.radiance = {};
    for (const Estimate& estimate : estimates) found.radiance += estimate.light();
    if (count == sampling_.most_points) break;
    if (sampling_.shown && count >= first_compared)
      for (Estimate& estimate : estimates)
        if (!estimate.ended() &&
            seen_error(*sampling_.shown, estimate, other + found.radiance) <= permitted_difference(0))
          estimate.end();
    if (std::ranges::all_of(estimates, &Estimate::ended)) break;
  }
  return found;
}

}  // namespace lightwell
