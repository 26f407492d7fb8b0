// SPDX-License-Identifier: Apache-2.0
//
// render_bench: what shadowed irradiance errs by for its rays, by random samples of a lamp and by the order of points
// that the page has, with the ratio of what is seen of them: behind an edge, in closed form, and behind leaves; and how
// well halves of the points tell that error, and how many rays are taken where they end by themselves.
#include <cstdio>
#include <functional>

#include "lightwell/render/direct_light.h"
#include "lightwell/texture/transfer.h"
#include "lightwell/trace/lamp_irradiance.h"
#include "lightwell/trace/lamp_points.h"
#include "tests/render/half_plane.h"

namespace lightwell {
namespace {

/// A receiver of a lamp's light, and the truth.
struct Place {
  const World* world = nullptr;
  const ClientLamp* lamp = nullptr;
  Receiver receiver;
  double irradiance = 0;
};

/// An estimate by about so many rays; `seed` of chance.
using Estimator = std::function<double(const Place& place, int rays, uint64_t seed)>;

/// The irradiance by a point of the lamp, for all of its area, and that which a ray leaves.
struct Arriving {
  double unoccluded = 0, seen = 0;
};

Arriving arriving(const Place& place, const Vec3f& point, Random& random) {
  const Vec3f way = point - place.receiver.position;
  const float squared = dot(way, way);
  const Arrival arrival{.direction = way / std::sqrt(squared), .distance = std::sqrt(squared)};
  const Vec3f& normal = place.receiver.shading.normal;
  const float area = 4 * length(cross(place.lamp->half_u, place.lamp->half_v));
  const float strength = area * dot(normal, arrival.direction) * -dot(place.lamp->normal, arrival.direction) / squared;
  const Vec3f left = visibility(place.world->surfaces(), place.receiver.position, normal, arrival, random);
  return {static_cast<double>(strength), static_cast<double>(strength * left[0])};
}

double random_points(const Place& place, int rays, uint64_t seed) {
  Random random(seed, 0);
  double sum = 0;
  for (int i = 0; i < rays; i++) {
    const float u = 2 * random.uniform() - 1, v = 2 * random.uniform() - 1;
    sum += arriving(place, place.lamp->center + place.lamp->half_u * u + place.lamp->half_v * v, random).seen;
  }
  return sum / rays;
}

/// As `render` takes them without --direct-samples: a ray to the lamp, and one as the surface reflects.
double random_samples(const Place& place, int rays, uint64_t seed) {
  const IntegratorOptions options;
  const DirectLight direct(*place.world, options, {});
  Random random(seed, 0);
  double sum = 0;
  for (int i = 0; i < rays / 2; i++) sum += static_cast<double>(direct.sample(place.receiver, {}, random).radiance[0]);
  return sum / (rays / 2);
}

double order_with_ratio(const Place& place, int rays, uint64_t seed) {
  const LampSampling sampling{.lamps = {*place.lamp}, .most_points = rays, .shown = {}};
  Random random(seed, 0);
  return static_cast<double>(
      LampLight(*place.world, sampling, {}, as_they_are).reflected(place.receiver, {}, random).radiance[0]);
}

/// Root mean square, of the mean irradiance.
double error_of(const Estimator& estimator, const std::vector<Place>& places, int rays) {
  double squares = 0, sum = 0;
  for (size_t i = 0; i < places.size(); i++) {
    const double off = estimator(places[i], rays, i) - places[i].irradiance;
    squares += off * off;
    sum += places[i].irradiance;
  }
  const double count = static_cast<double>(places.size());
  return std::sqrt(squares / count) / (sum / count);
}

constexpr int counts[] = {16, 32, 64, 128, 256};

void compare(const char* name, const std::vector<Place>& places) {
  // Of random points the error is that of one divided by the root of their number: all counts together tell it well.
  double of_one = 0;
  for (const int rays : counts) {
    const double error = error_of(random_points, places, rays);
    of_one += error * error * rays / std::size(counts);
  }
  for (const int rays : counts) {
    const double ordered = error_of(order_with_ratio, places, rays);
    std::printf("| %s | %d | %.2f | %.2f | %.2f | 1/%.1f |\n", name, rays, 100 * error_of(random_samples, places, rays),
                100 * error_of(random_points, places, rays), 100 * ordered, of_one / (ordered * ordered) / rays);
  }
}

/// The root mean square of half the difference of two halves of the points, and of the error that it is to tell.
void compare_halves(const std::vector<Place>& places) {
  std::printf(
      "\n| points | error %% | half the difference of the first and the second half %% | of even and odd ones %% |\n"
      "|---|---|---|---|\n");
  for (const int points : counts) {
    double errors = 0, of_beginning = 0, of_even = 0, sum = 0;
    for (const Place& place : places) {
      Random random(1, 1);
      std::array<Arriving, 2> halves, sides;
      for (int i = 0; i < points; i++) {
        const Arriving found = arriving(place, lamp_point(*place.lamp, static_cast<uint32_t>(i)).position, random);
        for (Arriving* half : {&halves[2 * i >= points], &sides[i % 2]}) {
          half->unoccluded += found.unoccluded;
          half->seen += found.seen;
        }
      }
      const double whole = unshadowed_irradiance(*place.lamp, place.receiver.position, {{0, 1, 0}})[0];
      const auto share = [](const Arriving& half) { return half.seen / half.unoccluded; };
      const auto squared = [](double x) { return x * x; };
      const Arriving all{halves[0].unoccluded + halves[1].unoccluded, halves[0].seen + halves[1].seen};
      errors += squared(whole * share(all) - place.irradiance);
      of_beginning += squared(whole * (share(halves[0]) - share(halves[1])) / 2);
      of_even += squared(whole * (share(sides[0]) - share(sides[1])) / 2);
      sum += place.irradiance;
    }
    const double count = static_cast<double>(places.size());
    const auto percent = [&](double squares) { return 100 * std::sqrt(squares / count) / (sum / count); };
    std::printf("| %d | %.2f | %.2f | %.2f |\n", points, percent(errors), percent(of_beginning), percent(of_even));
  }
}

/// Rays a receiver, and what is left of the error as steps of a screen of 8 bits, where points end by themselves.
void print_ends(const std::vector<Place>& places) {
  std::printf("\n| EV | other radiance | rays, mean | error, steps of 1/255, root mean square |\n|---|---|---|---|\n");
  for (const float exposure : {0.0f, -3.0f})
    for (const float other : {0.0f, 0.2f}) {
      const Display display{.exposure = exposure, .tone = ToneCurve::none};
      double rays = 0, squares = 0;
      for (const Place& place : places) {
        const LampSampling sampling{.lamps = {*place.lamp}, .most_points = 4096, .shown = display};
        Random random(1, 1);
        const LampLight::Found found =
            LampLight(*place.world, sampling, {}, as_they_are).reflected(place.receiver, Vec3f::filled(other), random);
        const auto encoded = [&](float radiance) {
          return static_cast<double>(linear_to_srgb(display(Vec3f::filled(other + radiance))[0]));
        };
        const double off = encoded(found.radiance[0]) - encoded(static_cast<float>(place.irradiance));
        rays += found.rays / static_cast<double>(places.size());
        squares += off * off / static_cast<double>(places.size());
      }
      std::printf("| %.0f | %.1f | %.0f | %.2f |\n", static_cast<double>(exposure), static_cast<double>(other), rays,
                  255 * std::sqrt(squares));
    }
}

/// Edges of 64 directions, each before 16 receivers all over its penumbra.
void add_edges(std::vector<std::unique_ptr<HalfPlane>>& scenes, std::vector<Place>& places) {
  Random random(7, 1);
  for (int i = 0; i < 64; i++) {
    const HalfPlane& scene = *scenes.emplace_back(std::make_unique<HalfPlane>(2 * pi * random.uniform()));
    for (int k = 0; k < 16; k++) {
      const float offset = random.uniform() - 0.5f;
      places.push_back({&scene.world(), &scene.sampling().lamps[0], scene.receiver(offset), scene.irradiance(offset)});
    }
  }
}

/// A regular polygon of 32 corners that faces down.
Mesh disc(const Vec3f& center, float radius) {
  Mesh mesh;
  constexpr uint32_t corners = 32;
  for (uint32_t i = 0; i < corners; i++) {
    const float angle = 2 * pi * static_cast<float>(i) / corners;
    mesh.positions.push_back(center + Vec3f{{radius * std::cos(angle), 0, radius * std::sin(angle)}});
    if (i >= 2) mesh.faces.push_back({0, i - 1, i});
  }
  return mesh;
}

/// A square lamp of 1 m2, 2 m above the floor, and 24 discs between them, by chance.
struct Leaves {
  Scene scene;
  std::unique_ptr<const World> world;
  ClientLamp lamp;

  explicit Leaves(uint64_t seed) {
    Random random(seed, 2);
    add(scene, quad({{-0.5f, 2, -0.5f}}, {{1, 0, 0}}, {{0, 0, 1}}), lambertian(0, 1));
    for (int i = 0; i < 24; i++) {
      const Vec3f center{{random.uniform() - 0.5f, 0.7f + 0.6f * random.uniform(), random.uniform() - 0.5f}};
      add(scene, disc(center, 0.04f + 0.06f * random.uniform()), lambertian(0));
    }
    world = world_of(scene);
    lamp = rectangle_lamp(*world, 0, {{0.5f, 0, 0}}, {{0, 0, 0.5f}}, 1);
  }
};

/// By a lattice of points of the lamp, which errs by a hundredth of what is measured.
double by_lattice(const Place& place) {
  constexpr int side = 256;
  Random random(1, 1);
  double sum = 0;
  for (int x = 0; x < side; x++)
    for (int y = 0; y < side; y++) {
      const auto across = [](int i) { return (2 * static_cast<float>(i) + 1) / side - 1; };
      const Vec3f point = place.lamp->center + place.lamp->half_u * across(x) + place.lamp->half_v * across(y);
      sum += arriving(place, point, random).seen / (side * side);
    }
  return sum;
}

void add_leaves(std::vector<std::unique_ptr<Leaves>>& scenes, std::vector<Place>& places) {
  Random random(7, 3);
  for (uint64_t i = 0; i < 16; i++) {
    const Leaves& scene = *scenes.emplace_back(std::make_unique<Leaves>(i));
    for (int k = 0; k < 16; k++) {
      const Vec3f position{{0.6f * random.uniform() - 0.3f, 0, 0.6f * random.uniform() - 0.3f}};
      places.push_back({scene.world.get(), &scene.lamp, Receiver::irradiance(position, {{0, 1, 0}})});
      places.back().irradiance = by_lattice(places.back());
    }
  }
}

}  // namespace
}  // namespace lightwell

int main() {
  using namespace lightwell;
  std::vector<std::unique_ptr<HalfPlane>> edges;
  std::vector<std::unique_ptr<Leaves>> leaves;
  std::vector<Place> behind_edges, behind_leaves;
  add_edges(edges, behind_edges);
  add_leaves(leaves, behind_leaves);
  std::printf(
      "| behind | rays | random samples of `render`, error %% | random points %% | the order with ratio %% | rays for "
      "the "
      "same error as random points |\n|---|---|---|---|---|---|\n");
  compare("an edge", behind_edges);
  compare("leaves", behind_leaves);
  compare_halves(behind_edges);
  print_ends(behind_edges);
  return 0;
}
